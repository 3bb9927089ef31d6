#pragma once
// Simulation loop: advances a state with one method and stops if the motion diverges.

#include <liecheck/scene/event_steps.hpp>

namespace liecheck::scene {

/// Duration, number of steps, and steps between samples.
struct Span {
  double duration = 0;  ///< [s]
  long steps = 1;       ///< of duration / steps each; an adaptive method subdivides them
  long every = 1;       ///< steps between samples; the start and the end are sampled too
  long first = 0;       ///< steps made by an earlier part of the run, which began at time 0
  double coarse = 1;    ///< r of phase_check.hpp
  int divide = 1;       ///< equal parts of every step (phase_check.hpp)
  long compared = std::numeric_limits<long>::max();  ///< most steps that phases may compare (phase_check.hpp)
};

struct Outcome {
  long steps = 0;  ///< completed steps
  double t = 0;    ///< time after these steps [s]
  bool diverged = false, stopped = false;
  std::string why;             ///< the reason if it diverged
  long events = 0;             ///< changes of branches that were located
  std::optional<double> zeno;  ///< time of the first step with too many of them [s]
  PhaseSteps phases;  ///< steps that were shortened since a phase of the forces is shorter than a step
};

/// watch(state, step) returns false to stop. It throws StepFailed to refuse the state; the step is then not
/// counted, but `state` keeps the refused values. If the method fails, `state` is as before the step. The
/// time after step n is n (duration / steps), not a sum of n rounded steps.
/// A step ends at each event at which a force begins, ends or bends (event_steps.hpp).
/// If first > 0, the state is that after `first` steps, watch has seen it, and the method has begun.
/// Precondition: steps >= 1, every >= 1, 0 <= first <= steps, duration finite and > 0.
template <class Sys, class M, class Watch>
Outcome simulate(Sys& system, M& method, State<Sys>& state, const Span& span, Watch&& watch) {
  using S = typename Sys::Scalar;
  const S t0 = span.first > 0 ? S(0) : state.t, h = S(span.duration) / S(span.steps);
  EventSteps<Sys> events(system, state, method.what(), h, span.coarse, span.divide, span.compared);
  const auto ended = [&](long steps, bool stopped, const char* why = nullptr) {
    return Outcome{steps,          double(t0 + S(steps) * h), why != nullptr, stopped,
                   why ? why : "", events.located(),          events.zeno(),  events.phases()};
  };
  const bool timed = !events.none();
  long made = span.first;
  try {
    if (made == 0) {
      method.begin(system, state);
      if (!watch(std::as_const(state), 0L)) return ended(0, true);
    }
    long next = std::min(made - made % span.every + span.every, span.steps);
    while (made < span.steps) {
      try {
        if (timed) [[unlikely]]
          events.step(system, method, state, S(t0 + S(made + 1) * h), h);
        else
          method.step(system, state, h);
      } catch (const Interrupted&) {
        return ended(made, true);
      } catch (const std::runtime_error& e) {  // StepFailed
        return ended(made, false, e.what());
      } catch (const std::domain_error& e) {  // SingularInertia
        return ended(made, false, e.what());
      }
      state.t = t0 + S(made + 1) * h;
      if (made + 1 < next) {
        ++made;
        continue;
      }
      const bool go_on = watch(std::as_const(state), made + 1);  // if it throws, the step is not counted
      ++made;
      next = std::min(next + span.every, span.steps);
      if (!go_on) return ended(made, made < span.steps);
    }
  } catch (const Interrupted&) {
    return ended(made, true);
  } catch (const StepFailed& e) {  // of watch
    return ended(made, false, e.what());
  }
  return ended(made, false);
}

}  // namespace liecheck::scene
