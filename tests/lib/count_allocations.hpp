#pragma once
// Counts the allocations of a thread. Include it in one file of a program.

#include <cstddef>

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && defined(__GLIBC__)
// Eigen allocates by malloc, not by operator new, so malloc is what must be counted.
static thread_local long allocations = 0;
extern "C" void* __libc_malloc(std::size_t);
extern "C" void* malloc(std::size_t n) {
  ++allocations;
  return __libc_malloc(n);
}
#define LIECHECK_COUNTS_ALLOCATIONS
#endif
