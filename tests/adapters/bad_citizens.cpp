// A shared library whose functions behave badly in one of many ways, which LIECHECK_BAD names. Each input with
// |phi_x| between 0.5 and 1 makes it do so, or every input in the way `always`; for the others, its exp3_quaternion is right.
// Once the file exists that LIECHECK_HANGS names, each of these inputs adds a character to it and never returns.

#include <unistd.h>

#include <adapters/liecheck_adapter.h>
#include <cfenv>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>

namespace {

const std::string& way() {
  static const std::string text = std::getenv("LIECHECK_BAD") ? std::getenv("LIECHECK_BAD") : "";
  return text;
}

volatile int never = 0;
volatile double shared_x = 0;  // of all threads
double last_x = 0, previous_x = 0;

/// Tries to cut off the shared memory that the program reads.
void cut_memory() {
  for (int k = 3; k < 256; ++k) {
    char name[64] = "";
    const auto link = "/proc/self/fd/" + std::to_string(k);
    if (readlink(link.c_str(), name, sizeof name - 1) > 0 && std::strstr(name, "memfd:liecheck") &&
        ftruncate(k, 0) == 0)
      std::abort();
  }
}

/// What happens before the result of an input is computed.
void misbehave(double* phi, double* Q, unsigned char* status) {
  if (const char* const hangs = std::getenv("LIECHECK_HANGS"); hangs && access(hangs, F_OK) == 0) {
    std::ofstream(hangs, std::ios::app) << '.' << std::flush;
    for (;;) pause();
  }
  if (way() == "segfault") std::raise(SIGSEGV);
  if (way() == "abort") std::abort();
  if (way() == "loop" || way() == "always")
    while (!never) {
    }
  if (way() == "exit") std::exit(0);
  if (way() == "cut") cut_memory();
  if (way() == "memory") {
    char* volatile const bytes =
        static_cast<char*>(std::malloc(std::size_t(10) << 30));  // else clang takes none
    std::memset(bytes, 1, std::size_t(10) << 30);
    never = bytes[1000];
  }
  if (way() == "rounding") std::fesetround(FE_UPWARD);
#ifdef __SSE2__
  if (way() == "flush") __builtin_ia32_ldmxcsr(__builtin_ia32_stmxcsr() | 0x8040);
#endif
  if (way() == "input") phi[1] = std::numeric_limits<double>::quiet_NaN();
  if (way() == "stdio") std::printf("phi_x = %g\n", phi[0]);
  if (way() == "cout") std::cout << "phi_x = " << phi[0] << std::endl;
  if (way() == "write" && write(1, "phi\n", 4) != 4) std::abort();
  if (way() == "throw") throw std::runtime_error("not a rotation");
  if (way() == "slow") usleep(100000);
  if (way() == "status") *status = 77;
  if (way() == "refuse") *status = liecheck_refused;
  if (way() == "order" && previous_x > phi[0]) Q[0] = std::nextafter(Q[0], 2.0);
  if (way() == "nan") Q[3] = std::numeric_limits<double>::quiet_NaN();
}

void exp3_quaternion(size_t n, const void* inputs, void* results, unsigned char* status) {
  static long calls = 0;
  for (size_t i = 0; i < n; ++i) {
    double* const phi = static_cast<double*>(const_cast<void*>(inputs)) + 3 * i;
    double* const Q = static_cast<double*>(results) + 4 * i;
    const double x = phi[0], y = phi[1], z = phi[2], theta = std::hypot(x, y, z);
    const double s = theta > 1e-8 ? std::sin(theta / 2) / theta : 0.5;
    const bool bad = way() == "always" || (std::fabs(x) >= 0.5 && std::fabs(x) <= 1);
    Q[0] = s * x, Q[1] = s * y, Q[2] = s * z;
    if (!(bad && way() == "unwritten")) Q[3] = std::cos(theta / 2);
    if (way() == "threads") {
      shared_x = Q[0];
      usleep(20);
      Q[0] = shared_x;
    }
    if (x != last_x) previous_x = last_x, last_x = x;
    if (bad) misbehave(phi, Q, &status[i]);
    if (++calls % 1000 == 0 && way() == "stateful") Q[0] += 1e-3;
  }
}

liecheck_function find(const char* operation, const char* scalar) {
  return std::string(operation) == "exp3_quaternion" && std::string(scalar) == "double" ? exp3_quaternion
                                                                                        : nullptr;
}

}  // namespace

extern "C" const liecheck_adapter* liecheck_get_adapter() {
  static liecheck_adapter adapter{};
  adapter.interface_version = way() == "version" ? 7U : 1U;
  adapter.name = "bad", adapter.version = "1", adapter.thread_safe = way() == "threads", adapter.find = find;
  return &adapter;
}
