#pragma once
// Simulation loop: advances a state with one method and stops if the motion diverges.

#include <liecheck/scene/integrators/method.hpp>
#include <liecheck/scene/pieces.hpp>

namespace liecheck::scene {

/// Duration, number of steps, and steps between samples.
struct Span {
  double duration = 0;  ///< [s]
  long steps = 1;       ///< of duration / steps each; an adaptive method subdivides them
  long every = 1;       ///< steps between samples; the start and the end are sampled too
};

/// Steps that end at the times at which forces are known to jump or bend. The order of a method then holds
/// across them, since no step contains one. An event within 8 eps |t| of the end of a step counts as that end.
template <class Sys>
class EventSteps {
 public:
  using S = typename Sys::Scalar;
  EventSteps(Pieces<S>& pieces, const S& t0) : pieces_(pieces) { skip(t0); }
  ~EventSteps() { pieces_.release(); }
  EventSteps(const EventSteps&) = delete;
  EventSteps& operator=(const EventSteps&) = delete;

  bool none() const { return pieces_.times().empty(); }

  /// Advances state from state.t to `end` = state.t + h, and leaves state.t. If the method throws, state is as
  /// before.
  template <class M>
  [[gnu::noinline, gnu::cold]] void step(Sys& system, M& method, State<Sys>& state, const S& end,
                                         const S& h) {
    const auto& times = pieces_.times();
    const bool whole = next_ == times.size() || !(times[next_] < S(end - slack(end)));
    if (whole) {
      pieces_.hold(S((state.t + end) / S(2)));
      method.step(system, state, h);
    } else {
      parts(system, method, state, end);
    }
    pieces_.release();
    skip(end);
  }

 private:
  static S slack(const S& t) { return S(8) * eps<S>() * absolute<S>(t); }
  void skip(const S& t) {
    while (next_ < pieces_.times().size() && !(pieces_.times()[next_] > S(t + slack(t)))) ++next_;
  }
  template <class M>
  void parts(Sys& system, M& method, State<Sys>& state, const S& end) {
    const State<Sys> before = state;
    try {
      for (S to = end; state.t < end; state.t = to) {
        to = end;
        if (next_ < pieces_.times().size() && pieces_.times()[next_] < S(end - slack(end)))
          to = pieces_.times()[next_];
        pieces_.hold(S((state.t + to) / S(2)));
        method.step(system, state, S(to - state.t));
        skip(to);
      }
    } catch (...) {
      state = before;
      throw;
    }
    state.t = before.t;
  }

  Pieces<S>& pieces_;
  std::size_t next_ = 0;  ///< the first event after the state
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
/// A step ends at each time at which a force is known to jump or bend (EventSteps).
/// Precondition: steps >= 1, every >= 1, duration finite and > 0.
template <class Sys, class M, class Watch>
Outcome simulate(Sys& system, M& method, State<Sys>& state, const Span& span, Watch&& watch) {
  using S = typename Sys::Scalar;
  const S t0 = state.t, h = S(span.duration) / S(span.steps);
  const auto ended = [&](long steps, bool stopped, const char* why = nullptr) {
    return Outcome{steps, double(t0 + S(steps) * h), why != nullptr, stopped, why ? why : ""};
  };
  EventSteps<Sys> events(system.pieces(), t0);
  const bool timed = !events.none();
  method.begin(system, state);
  long made = 0;
  try {
    if (!watch(std::as_const(state), 0L)) return ended(0, true);
    long next = std::min(span.every, span.steps);
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
