#pragma once
// Simulation loop: advances a state with one method and stops if the motion diverges.

#include <liecheck/scene/integrators/method.hpp>

namespace liecheck::scene {

/// Duration, number of steps, and steps between samples.
struct Span {
  double duration = 0;  ///< [s]
  long steps = 1;       ///< of duration / steps each; an adaptive method subdivides them
  long every = 1;       ///< steps between samples; the start and the end are sampled too
};

struct Outcome {
  long steps = 0;  ///< completed steps
  double t = 0;    ///< time after these steps [s]
  bool diverged = false, stopped = false;
  std::string why;  ///< the reason if it diverged
};

/// watch(state, step) returns false to stop. It throws StepFailed to refuse the state; the step is then not
/// counted, but `state` keeps the refused values. If the method fails, `state` is as before the step. The
/// time after step n is n (duration / steps), not a sum of n rounded steps.
/// Precondition: steps >= 1, every >= 1, duration finite and > 0.
template <class Sys, class M, class Watch>
Outcome simulate(Sys& system, M& method, State<Sys>& state, const Span& span, Watch&& watch) {
  using S = typename Sys::Scalar;
  const S t0 = state.t, h = S(span.duration) / S(span.steps);
  Outcome outcome;
  const auto ended = [&](bool stopped, const char* why = nullptr) {
    outcome.t = double(t0 + S(outcome.steps) * h);
    outcome.stopped = stopped;
    if (why) outcome.diverged = true, outcome.why = why;
    return outcome;
  };
  method.begin(system, state);
  try {
    if (!watch(std::as_const(state), 0L)) return ended(true);
    long next = std::min(span.every, span.steps);
    while (outcome.steps < span.steps) {
      try {
        method.step(system, state, h);
      } catch (const Interrupted&) {
        return ended(true);
      } catch (const std::runtime_error& e) {  // StepFailed
        return ended(false, e.what());
      } catch (const std::domain_error& e) {  // SingularInertia
        return ended(false, e.what());
      }
      const long made = outcome.steps + 1;
      state.t = t0 + S(made) * h;
      const bool go_on = made < next || watch(std::as_const(state), made);
      outcome.steps = made;
      if (made < next) continue;
      next = std::min(next + span.every, span.steps);
      if (!go_on) return ended(made < span.steps);
    }
  } catch (const Interrupted&) {
    return ended(true);
  } catch (const StepFailed& e) {  // of watch
    return ended(false, e.what());
  }
  return ended(false);
}

}  // namespace liecheck::scene
