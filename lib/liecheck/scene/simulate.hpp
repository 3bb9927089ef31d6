#pragma once
// A run: steps of one method, watched at every nth, stopped where it diverges.

#include <liecheck/scene/integrators/method.hpp>

namespace liecheck::scene {

/// How long, in how many steps, and how often it is watched.
struct Span {
  double duration = 0;  ///< [s]
  long steps = 1;       ///< of duration / steps each; of an adaptive method, between which it chooses its own
  long every = 1;       ///< watched after each so many, at the start and at the end
};

struct Outcome {
  long steps = 0;  ///< that were made
  double t = 0;    ///< of the last state [s]
  bool diverged = false, stopped = false;
  std::string why;  ///< it diverged
};

/// Are q and v finite? x - x is 0 for what is, and NaN else.
template <class Sys>
bool finite(const State<Sys>& state) {
  using S = typename Sys::Scalar;
  S sum(0);
  for (int i = 0; i < state.q.size(); ++i) sum += state.q[i] - state.q[i];
  for (int i = 0; i < state.v.size(); ++i) sum += state.v[i] - state.v[i];
  return sum == S(0);
}

/// watch(state, step) -> bool: go on? A state that is not finite is not watched: the last one that was is left in state,
/// and Outcome says at which step and why. t of step n is n (duration / steps) in S, rounded once.
/// Precondition: span.steps >= 1, every >= 1, duration finite and > 0.
template <class Sys, class M, class Watch>
Outcome simulate(Sys& system, M& method, State<Sys>& state, const Span& span, Watch&& watch) {
  using S = typename Sys::Scalar;
  const S t0 = state.t, h = S(span.duration) / S(span.steps);
  Outcome outcome;
  outcome.t = double(t0);
  method.begin(system, state);
  if (!watch(std::as_const(state), 0L)) {
    outcome.stopped = true;
    return outcome;
  }
  State<Sys> before = state;
  for (long n = 1, next = std::min(span.every, span.steps); n <= span.steps; ++n) {
    before = state;
    try {
      method.step(system, state, h);
    } catch (const std::runtime_error& e) {  // StepFailed; SingularInertia is a domain_error
      outcome.why = e.what();
    } catch (const std::domain_error& e) {
      outcome.why = e.what();
    }
    if (outcome.why.empty() && !finite(state)) outcome.why = "a number is no longer finite";
    if (!outcome.why.empty()) {
      state = before;
      outcome.diverged = true;
      return outcome;
    }
    state.t = t0 + S(n) * h;
    outcome.steps = n;
    outcome.t = double(state.t);
    if (n < next) continue;
    next = std::min(n + span.every, span.steps);
    if (!watch(std::as_const(state), n)) {
      outcome.stopped = n < span.steps;
      return outcome;
    }
  }
  return outcome;
}

}  // namespace liecheck::scene
