#include <support/float_environment.hpp>

#include <atomic>
#include <cstdio>
#include <limits>
#include <stdexcept>

namespace liecheck::properties {

namespace {

/// Numbers that the compiler does not know.
volatile long double long_one = 1, long_tiny = std::numeric_limits<long double>::epsilon(),
                     double_tiny = std::numeric_limits<double>::epsilon();
volatile double one = 1, tiny = std::numeric_limits<double>::epsilon() / 4,
                smallest = std::numeric_limits<double>::denorm_min(),
                small = std::numeric_limits<double>::min();

}  // namespace

std::string unusual_arithmetic() {
#ifdef __GLIBC__
  if (fegetexcept() != 0) return "traps floating-point exceptions";
#endif
  if (long_one + double_tiny == 1) return "rounds long double to fewer bits than double";
  const bool up = one + tiny != 1, minus_up = -one + -tiny != -1, minus_down = one - tiny != 1;
  std::string what;
  if (up && minus_up)
    what = "rounds away from zero";
  else if (up)
    what = "rounds up";
  else if (minus_up)
    what = "rounds down";
  else if (minus_down)
    what = "rounds to zero";
  const bool results = small / 2 == 0, arguments = smallest * (one / tiny) == 0;
  const char* const flushes = results && arguments ? "takes subnormal numbers for zero"
                              : results            ? "replaces subnormal results by zero"
                              : arguments          ? "takes subnormal arguments for zero"
                                                   : "";
  if (!what.empty() && *flushes) what += " and ";
  return what + flushes;
}

void require_usual_arithmetic() {
  const std::string what = unusual_arithmetic();
  if (!what.empty())
    throw std::runtime_error(
        "the arithmetic of this process " + what +
        ": nothing is judged, because the exact results would be wrong. A library that was compiled with "
        "-ffast-math, "
        "or a setting of the process, may have changed it; 'liecheck environments' calls a subject in such "
        "environments");
  static std::atomic_flag warned;
  if (long_one + long_tiny == 1 && !warned.test_and_set())
    std::fputs(
        "warning: this process rounds long double as double, as valgrind does: some cases have other digits than "
        "elsewhere\n",
        stderr);
}

}  // namespace liecheck::properties
