#pragma once
// Method: a step over a whole configuration, on the group. One file each; the list is integrators/registry.hpp.

#include <functional>
#include <liecheck/scene/accumulate.hpp>
#include <liecheck/scene/system.hpp>
#include <stdexcept>
#include <string>

namespace liecheck::scene {

/// What a method promises. Errors of q are |difference(q, exact)|; order p: they fall like h^p.
struct MethodInfo {
  const char* name;
  int order;
  int evaluations;          ///< of the acceleration, a step; 0: as many as it takes
  bool adaptive;            ///< chooses its own steps, by a tolerance
  bool preserves_energy;    ///< in the mean: its error has no slope
  bool preserves_momentum;  ///< spatial momentum of a free body as a vector, up to rounding
  bool lone_body_only;
  const char* equation;
  const char* source;
  bool increments = false;  ///< it computes J_r^-1 of each stage's increment
};

/// A step that could not be made: what() says why, without the time.
class StepFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A step that somebody stopped: no fault of the motion.
class Interrupted : public StepFailed {
 public:
  Interrupted() : StepFailed("interrupted") {}
};

/// Before a state takes increments of q and v: throws StepFailed unless the sum of their squares is finite, so that what
/// diverges is stopped with the last good state, a factor 1e154 before double has no larger numbers.
template <class A, class B>
[[gnu::always_inline]] inline void checkFinite(const A& delta, const B& dv) {
  using S = typename A::Scalar;
  const S sum = delta.squaredNorm() + dv.squaredNorm();
  if (!(sum <= std::numeric_limits<S>::max())) throw StepFailed("a number is no longer finite");
}

/// What the adaptive ones and the implicit ones did.
struct MethodCounts {
  long steps = 0, rejected = 0, iterations = 0;
};

/// begin: once, before the first step and whenever the state was set from outside (this may allocate, step may not).
/// step: the state moves by exactly h [s], t is left alone; throws StepFailed (or what the system throws) and then leaves
/// the state as it was, which stays finite: checkFinite comes first.
template <class Sys>
class Method {
 public:
  virtual ~Method() = default;
  virtual const MethodInfo& what() const = 0;
  virtual void begin(Sys& system, const State<Sys>& state) = 0;
  virtual void step(Sys& system, State<Sys>& state, const typename Sys::Scalar& h) = 0;
  virtual MethodCounts counts() const { return {}; }
};

/// Of the method that a scene asks for.
struct MethodOptions {
  /// Of adaptive ones: error of a step [m, rad, m/s, rad/s], absolute + relative to |v|.
  double tolerance = 1e-9;
  /// Asked by those now and then inside a step, which may hold any number of their own: stop?
  std::function<bool()> stop = {};
};

}  // namespace liecheck::scene
