#pragma once
// Method: an integrator that advances a whole configuration on the group. integrators/registry.hpp lists all.

#include <functional>
#include <liecheck/scene/accumulate.hpp>
#include <liecheck/scene/system.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace liecheck::scene {

/// The properties of a method. Order p means that the errors |difference(q, exact)| are O(h^p).
struct MethodInfo {
  const char* name;
  int order;
  int evaluations = 0;  ///< of the acceleration, per step; 0 if not fixed
  const char *equation, *source;
  bool increments = false;          ///< each stage computes J_r^-1 of its increment
  bool adaptive = false;            ///< chooses its steps by a tolerance
  int estimate_order = 0;           ///< of adaptive methods: the estimate of a step is O(h^estimate_order)
  bool preserves_energy = false;    ///< the energy error oscillates without drift
  bool preserves_momentum = false;  ///< the spatial momentum of a free body is constant up to rounding
  bool lone_body_only = false;
};

/// True for methods whose errors come down to those of rounding, by their order or by a tolerance, so that sums without
/// compensation would show.
inline bool compensates(const MethodInfo& method) { return method.order >= 6 || method.adaptive; }

/// A step that failed. what() is the reason, without the time.
class StepFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A step that was stopped on request.
class Interrupted : public StepFailed {
 public:
  Interrupted() : StepFailed("interrupted") {}
};

/// Checks increments before they are added to a state. Throws StepFailed unless the size of their sum is at most the
/// root of the largest number (1e154 in double), where energies overflow: a sum with an infinite element is not.
template <class A, class B>
[[gnu::always_inline]] inline void checkFinite(const A& delta, const B& dv) {
  using S = typename A::Scalar;
  using std::sqrt;
  static const S most = std::is_same_v<S, double> ? S(0x1p511) : S(sqrt(std::numeric_limits<S>::max()));
  if (!(absolute<S>(S(delta.sum() + dv.sum())) <= most)) [[unlikely]]
    throw StepFailed("a number is no longer finite");
}

/// Counted by adaptive and implicit methods only.
struct MethodCounts {
  long steps = 0, rejected = 0, iterations = 0;
  MethodCounts operator+(const MethodCounts& o) const {
    return {steps + o.steps, rejected + o.rejected, iterations + o.iterations};
  }
};

/// Call begin before the first step, and whenever other code has set the state. begin may allocate; step does
/// not. step advances q and v by exactly h [s], but not t. If step throws, the state is unchanged.
template <class Sys>
class Method {
 public:
  virtual ~Method() = default;
  virtual const MethodInfo& what() const = 0;
  virtual void begin(Sys& system, const State<Sys>& state) = 0;
  virtual void step(Sys& system, State<Sys>& state, const typename Sys::Scalar& h) = 0;
  virtual MethodCounts counts() const { return {}; }
  /// What a step takes from the steps before it, besides the state; none if that cannot be told. A method that recalls
  /// it after begin() continues with the same bits.
  using Memory = std::vector<typename Sys::Scalar>;
  virtual std::optional<Memory> memory() const { return Memory(); }
  virtual void recall(const Memory&) {}
  /// The length of the last step, at most h: an adaptive method ends it where a held branch changes (switches.hpp).
  virtual typename Sys::Scalar reached() const { return std::numeric_limits<typename Sys::Scalar>::max(); }
};

/// The options of the method that a scene names.
struct MethodOptions {
  /// For adaptive methods: largest error of a step [m, rad, m/s, rad/s], absolute + relative to |v|.
  double tolerance = 1e-9;
  /// Adaptive methods call stop every 256 internal steps; if it returns true, the step is interrupted.
  std::function<bool()> stop = {};
  /// Whether increments are summed with compensation (accumulate.hpp). Without a value, compensates() decides.
  std::optional<bool> compensated = {};
};

}  // namespace liecheck::scene
