#pragma once
// The rounding mode and the treatment of subnormals of this thread, which a library may change by mistake.

#include <cfenv>

namespace liecheck::properties {

/// What the environment was when the object was made. The flags of exceptions that occurred do not count.
class FloatEnvironment {
 public:
  FloatEnvironment() : rounding_(std::fegetround()), control_(control()) {}
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;
  ~FloatEnvironment() { restore(); }

  bool changed() const { return std::fegetround() != rounding_ || control() != control_; }
  /// Sets the environment back, and returns whether it had changed.
  bool restore() const {
    if (!changed()) return false;
    std::fesetround(rounding_);
#ifdef __SSE2__
    __builtin_ia32_ldmxcsr(control_ | (__builtin_ia32_stmxcsr() & occurred));
#endif
    return true;
  }

 private:
  static constexpr unsigned occurred = 0x3f;
  static unsigned control() {
#ifdef __SSE2__
    return __builtin_ia32_stmxcsr() & ~occurred;
#else
    return 0;
#endif
  }
  int rounding_;
  unsigned control_;
};

}  // namespace liecheck::properties
