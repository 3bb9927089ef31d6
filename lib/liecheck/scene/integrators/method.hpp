#pragma once
// Method: a step over a whole configuration, on the group. One file each; the list is integrators/registry.hpp.

#include <functional>
#include <liecheck/scene/accumulate.hpp>
#include <liecheck/scene/system.hpp>
#include <stdexcept>
#include <string>

namespace liecheck::scene {

/// The properties of a method. Errors of q are |difference(q, exact)|; order p: they are O(h^p).
struct MethodInfo {
  const char* name;
  int order;
  int evaluations;          ///< of the acceleration, per step; 0: not fixed
  bool adaptive;            ///< chooses its own steps, by a tolerance
  bool preserves_energy;    ///< its error oscillates without drift
  bool preserves_momentum;  ///< spatial momentum of a free body as a vector, up to rounding
  bool lone_body_only;
  const char* equation;
  const char* source;
  bool increments = false;  ///< each stage computes J_r^-1 of its increment
};

/// A step that failed: what() is the reason, without the time.
class StepFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A step that was stopped on request.
class Interrupted : public StepFailed {
 public:
  Interrupted() : StepFailed("interrupted") {}
};

/// Checks increments before they are added to a state: throws StepFailed unless the sum of their squares is finite, so that
/// a motion that diverges stops with its last finite state, near 1e154 in double.
template <class A, class B>
[[gnu::always_inline]] inline void checkFinite(const A& delta, const B& dv) {
  using S = typename A::Scalar;
  const S sum = delta.squaredNorm() + dv.squaredNorm();
  if (!(sum <= std::numeric_limits<S>::max())) throw StepFailed("a number is no longer finite");
}

/// Counts of adaptive and implicit methods.
struct MethodCounts {
  long steps = 0, rejected = 0, iterations = 0;
};

/// begin: call before the first step and whenever the state was set from outside; it may allocate, step does not.
/// step: advances q and v by exactly h [s], not t. It throws StepFailed, or what the system throws, and then leaves the
/// state unchanged.
template <class Sys>
class Method {
 public:
  virtual ~Method() = default;
  virtual const MethodInfo& what() const = 0;
  virtual void begin(Sys& system, const State<Sys>& state) = 0;
  virtual void step(Sys& system, State<Sys>& state, const typename Sys::Scalar& h) = 0;
  virtual MethodCounts counts() const { return {}; }
};

/// The options of the method that a scene names.
struct MethodOptions {
  /// Of adaptive methods: error of a step [m, rad, m/s, rad/s], absolute + relative to |v|.
  double tolerance = 1e-9;
  /// Adaptive methods call it every 256 steps of their own; true interrupts the step.
  std::function<bool()> stop = {};
};

}  // namespace liecheck::scene
