/* Preloaded into a program, changes its arithmetic as the variable LIECHECK_ARITHMETIC says. */
#define _GNU_SOURCE
#include <fenv.h>
#include <stdlib.h>
#include <string.h>

#ifdef __SSE__
#include <xmmintrin.h>
#endif

__attribute__((constructor)) static void change(void) {
  const char* const how = getenv("LIECHECK_ARITHMETIC");
  if (!how) return;
  if (strcmp(how, "up") == 0) fesetround(FE_UPWARD);
  if (strcmp(how, "zero") == 0) fesetround(FE_TOWARDZERO);
  if (strcmp(how, "trap") == 0) feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
#ifdef __x86_64__
  if (strncmp(how, "x87", 3) == 0) {
    unsigned short control;
    __asm__ volatile("fnstcw %0" : "=m"(control));
    control &= (unsigned short)~0x300;                   /* 24 bits */
    if (strcmp(how, "x87_53") == 0) control |= 0x200;
    __asm__ volatile("fldcw %0" : : "m"(control));
  }
#endif
#ifdef __SSE__
  if (strcmp(how, "flush") == 0) _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
}
