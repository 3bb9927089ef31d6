/* Preloaded into a program, changes its arithmetic as the variable LIECHECK_ARITHMETIC says. */
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
#ifdef __SSE__
  if (strcmp(how, "flush") == 0) _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
}
