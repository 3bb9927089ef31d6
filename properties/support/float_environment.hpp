#pragma once
// The rounding mode and the treatment of subnormals of this thread: the oracles need the usual ones, a library may
// change them by mistake, and the command `environments` calls a library in others.

#include <cfenv>
#include <string>

namespace liecheck::properties {

/// A rounding mode, and whether subnormal arguments count as zero and subnormal results become zero.
struct FloatMode {
  int rounding = FE_TONEAREST;
  bool flush = false;

  bool is_usual() const { return rounding == FE_TONEAREST && !flush; }
};

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
  /// Changes the environment of this thread.
  static void set(const FloatMode& mode) {
    std::fesetround(mode.rounding);
#ifdef __SSE2__
    const unsigned now = __builtin_ia32_stmxcsr() & ~flushes;
    __builtin_ia32_ldmxcsr(mode.flush ? now | flushes : now);
#endif
  }
  /// Whether set() can flush subnormals here.
  static constexpr bool can_flush() {
#ifdef __SSE2__
    return true;
#else
    return false;
#endif
  }

 private:
  static constexpr unsigned occurred = 0x3f;
  static constexpr unsigned flushes = 0x8040;  ///< of subnormal results, and of subnormal arguments
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

/// The mode in which checked calls of subjects run (subjects/call_log.hpp). Written before threads start.
inline FloatMode mode_of_calls;

/// What is unusual in the arithmetic of this thread, as the arithmetic itself shows, in words; or "".
std::string unusual_arithmetic();

/// Throws std::runtime_error if the arithmetic of this thread is unusual: what the oracles say would be wrong.
void require_usual_arithmetic();

}  // namespace liecheck::properties
