#pragma once
// Steps that end at events, so that the order of a method holds across them: no step contains an event.
//
// - Times at which forces are known to jump or bend (pieces.hpp). An event within 8 eps |t| of the end of a step
//   counts as that end.
// - Changes of sign of switching functions (switches.hpp). A step that ends beyond one is taken again with a
//   shorter length, which the secant method with bisection (Illinois; Dowell & Jarratt 1971) finds to 4 eps of
//   the time, or sqrt(eps)/16 of the step if that is more. The state then lies beyond the change by that much, and the
//   branch changes. A force is continuous where its branch changes, so that a change that is late by d moves the
//   velocity by O(d^2); a state that is nearer to the change could cross it again by the rounding errors of positions. If only a
//   stage lies beyond one, or the step fails, the step is halved, at most four times; an adaptive method, whose
//   steps may contain many events, halves it at most twenty times.
//
// A part that still strays is taken with free branches, as if there were no events. So is the rest of a step
// after 32 events in it, or 10,000 in one of an adaptive method (Zeno behaviour); zeno() tells the time.
//
// - Phases that are shorter than a step. After an event, and in a part of a step that events cut, the forces may change
//   within less than a step: a stiff contact that begins and ends in it. A step s is therefore compared there with two of
//   s/2, and taken shorter until they agree (phase_check.hpp), until two whole steps agree.
// - Events that no step sees, since a function has changed its sign twice within it (a grazing contact): the step ends at
//   the extremum of the parabola through the function's last three values if that lies beyond the change of sign.

#include <cmath>
#include <limits>
#include <liecheck/scene/phase_check.hpp>

namespace liecheck::scene {

template <class Sys>
class EventSteps {
 public:
  using S = typename Sys::Scalar;
  /// With a method of order 1, steps end only at the events that are known beforehand, and the branches are those at each
  /// evaluation: it keeps its order so, since a force is continuous where its branch changes.
  EventSteps(Sys& system, const State<Sys>& state, const MethodInfo& method, const S& h, double coarse = 1,
             int divide = 1, long most = std::numeric_limits<long>::max())
      : pieces_(system.pieces()),
        switches_(system.switches()),
        before_(state),
        trial_(state),
        beyond_(state),
        check_(state, method, coarse, divide, most) {
    skip(state.t);
    learn(system, state);
    switching_ = method.order > 1 && !switches_.none();
    if (switching_) switches_.remember(double(state.t));
    if (switching_ && (state.t == S(0) || !switches_.settled())) check_.begin(h);  // it may begin within a phase
    switches_.release();
    learnt_ = false;
  }
  ~EventSteps() { pieces_.release(), switches_.release(); }
  EventSteps(const EventSteps&) = delete;
  EventSteps& operator=(const EventSteps&) = delete;

  bool none() const { return pieces_.times().empty() && !switching_ && check_.divide() == 1; }
  const PhaseSteps& phases() const { return check_.made(); }
  long located() const { return located_; }                    ///< changes of branches
  const std::optional<double>& zeno() const { return zeno_; }  ///< time of the first step with too many [s]

  /// Advances state from state.t to `end` = state.t + h, and leaves state.t. If the method throws, state is as
  /// before.
  template <class M>
  [[gnu::noinline, gnu::cold]] void step(Sys& system, M& method, State<Sys>& state, const S& end,
                                         const S& h) {
    const auto& times = pieces_.times();
    const bool whole = next_ == times.size() || !(times[next_] < S(end - slack(end)));
    if (whole && !switching_ && !check_.due() && check_.divide() == 1) {
      pieces_.hold(S((state.t + end) / S(2)));
      method.step(system, state, h);
    } else {
      parts(system, method, state, end, h);
    }
    pieces_.release(), switches_.release();
    switches_.settle(!check_.due());
    skip(end);
  }

 private:
  /// The length to which an event in a step of h is located.
  static S resolution(const S& t, const S& h) {
    using std::sqrt;
    return std::max(S(S(4) * eps<S>() * (absolute<S>(t) + h)), S(h * S(sqrt(eps<S>())) / S(16)));
  }
  static S slack(const S& t) { return S(8) * eps<S>() * absolute<S>(t); }
  void skip(const S& t) {
    while (next_ < pieces_.times().size() && !(pieces_.times()[next_] > S(t + slack(t)))) ++next_;
  }
  template <class M>
  void parts(Sys& system, M& method, State<Sys>& state, const S& end, const S& h) {
    const S start = state.t;
    begun_ = false, check_.beginStep();
    try {
      if (next_ == pieces_.times().size()) {  // the whole step
        pieces_.hold(S((start + end) / S(2)));
        cross(system, method, state, end, h, h);
      }
      for (S to = end; state.t < end; state.t = to) {
        to = end;
        if (next_ < pieces_.times().size() && pieces_.times()[next_] < S(end - slack(end)))
          to = pieces_.times()[next_];
        pieces_.hold(S((state.t + to) / S(2)));
        const bool whole = to == end && state.t == start;
        if (!whole) check_.begin(h);
        cross(system, method, state, to, whole ? h : S(to - state.t), h);
        skip(to);
      }
    } catch (...) {
      if (begun_) state = before_;
      throw;
    }
    state.t = start;
  }
  /// Notes the state before the first of several parts of a step.
  void begin(const State<Sys>& state) {
    if (!std::exchange(begun_, true)) before_ = state;
  }

  /// The branches at a state, by the signs of the functions.
  void learn(Sys& system, const State<Sys>& state) {
    switches_.learn();
    system.load(state.t, state.q, state.v);
    switches_.hold();
  }
  /// True if a function has the other sign at a state.
  bool crosses(Sys& system, const State<Sys>& state) {
    switches_.forget();
    system.load(state.t, state.q, state.v);
    return switches_.crossed();
  }
  /// The margin of the functions at a state.
  S margin(Sys& system, const State<Sys>& state) {
    system.load(state.t, state.q, state.v);
    return switches_.margin();
  }
  /// Takes a step of h from `from` to `result`, of the length made_, or `check_.divide()` equal ones. False if it fails,
  /// and `failed_` then says why.
  template <class M>
  bool attempt(Sys& system, M& method, const State<Sys>& from, const S& h, State<Sys>& result, bool again) {
    if (again) method.begin(system, from);
    result = from;
    switches_.forget();
    const int parts = check_.divide();
    try {
      for (int k = 1; k < parts; ++k) method.step(system, result, S(h / S(parts))), result.t += h / S(parts);
      method.step(system, result, parts > 1 ? S(h / S(parts)) : h);
    } catch (const Interrupted&) {
      throw;
    } catch (const std::runtime_error&) {  // StepFailed
      failed_ = std::current_exception();
      return false;
    } catch (const std::domain_error&) {  // SingularInertia
      failed_ = std::current_exception();
      return false;
    }
    made_ = std::min(h, method.reached());
    result.t = from.t + made_;
    return true;
  }

  /// Advances state to the time `to` = state.t + h across the events of the state. A step of the run has the length whole.
  template <class M>
  void cross(Sys& system, M& method, State<Sys>& state, const S& to, const S& h, const S& whole) {
    if (switching_) learnt_ ? switches_.keep() : learn(system, state);
    learnt_ = true;
    const S least = S(4) * eps<S>() * (absolute<S>(to) + h);
    const bool adaptive = method.what().adaptive;
    const int halvings = adaptive ? 20 : 4, most = adaptive ? 10000 : 32;
    S rest = h, length = h;
    bool again = false;   // the method has seen a later state
    bool loaded = false;  // the last load() was that of `state`
    for (int found = 0, halved = 0, splits = 0; rest > least;) {
      length = check_.shorten(length, rest);
      const bool made = attempt(system, method, state, length, trial_, again);
      const bool strayed = switching_ && made && switches_.crossed();
      if (made) length = made_;
      if (check_.due()) {
        again = true;
        if (!agrees(system, method, made, state, length, whole)) {
          length = check_.next();
          continue;
        }
      }
      if (made && switching_ && crosses(system, trial_)) {
        rest -= locate(system, method, state, length, switches_.margin());
        switches_.change(), ++located_, ++found;
        begin(state), state = beyond_, loaded = false, length = rest, halved = 0, again = true;
        switches_.remember(double(state.t)), check_.begin(whole);
        if (found < most) continue;
        if (!zeno_) zeno_ = double(state.t);
        if (rest > least) freely(system, method, state, rest, whole), again = false;
        break;
      }
      if ((!made || strayed) && halved < halvings) {
        length = length / S(2), ++halved, again = true;
        continue;
      }
      if (!made) std::rethrow_exception(failed_);
      if (strayed || length < h) begin(state);
      if (strayed) {
        freely(system, method, state, length, whole);
      } else {
        // The functions have the values at trial_.
        if (switching_ && !adaptive)
          if (const double peak = switches_.missed(double(trial_.t)); std::isfinite(peak) && splits++ < 4) {
            length = S(peak) - state.t, again = true;
            continue;
          }
        state = std::move(trial_);  // which keeps vectors of the same sizes
      }
      loaded = !strayed && switching_;
      rest -= length, length = adaptive ? rest : std::min(length, rest), halved = 0;
      if (check_.due())
        length = check_.next();
      else
        again = false;
    }
    if (again) method.begin(system, state);
    state.t = to;
    if (loaded && (next_ == pieces_.times().size() || S(to + slack(to)) < pieces_.times()[next_]))
      system.keep(to, state.q, state.v);
  }
  /// Takes a step of h, or as many as the check wants, with the branches that each evaluation chooses.
  template <class M>
  void freely(Sys& system, M& method, State<Sys>& state, const S& h, const S& whole) {
    switches_.release();
    check_.begin(whole);
    const S least = S(4) * eps<S>() * (absolute<S>(state.t) + h);
    for (S rest = h; rest > least;) {
      const S length = check_.shorten(rest, rest);
      const bool made = attempt(system, method, state, length, trial_, true);
      if (check_.due() && !agrees(system, method, made, state, length, whole)) continue;
      if (!made) std::rethrow_exception(failed_);
      rest -= length, state = trial_;
    }
    method.begin(system, state);
    learn(system, state);
  }
  /// Whether the check accepts trial_, a step of h from `state`.
  template <class M>
  bool agrees(Sys& system, M& method, bool made, const State<Sys>& state, const S& h, const S& whole) {
    return check_.agrees(system, made ? &trial_ : nullptr, state, h, whole,
                         [&](const S& half, State<Sys>& end) {
                           if (!attempt(system, method, state, half, end, true)) return false;
                           beyond_ = end;
                           return attempt(system, method, beyond_, half, end, false);
                         });
  }

  /// The length of the step from `state` to the first change of sign in (0, high], where margin(high) < 0. Sets
  /// beyond_ to the state there, and the values of the functions to those of that state.
  template <class M>
  S locate(Sys& system, M& method, const State<Sys>& state, S high, S at_high) {
    S low(0), at_low = margin(system, state);
    beyond_ = trial_;
    if (!(at_low > S(0))) at_low = S(0);
    const S least = resolution(state.t, high);
    const S whole = high;
    S before = high;  // the length of the bracket three iterations ago
    int side = 0;
    for (int k = 0; high - low > least && k < 200; ++k) {
      S middle = low + (high - low) * (at_low / (at_low - at_high));
      const S guard = least / S(2);
      if (k % 3 == 2) {
        if (!(high - low < before / S(8))) middle = (low + high) / S(2), side = 0;
        before = high - low;
      }
      if (!(middle > low + guard)) middle = low + guard;
      if (!(middle < high - guard)) middle = high - guard;
      if (!attempt(system, method, state, middle, trial_, true)) std::rethrow_exception(failed_);
      const S value = margin(system, trial_);
      if (made_ < middle) {  // a branch changes before
        high = made_, beyond_ = trial_, side = 0;
        at_high = value < S(0) ? value : S(-at_low);
      } else if (value > S(0)) {
        if (side == 1) at_high = at_high / S(2);
        low = middle, at_low = value, side = 1;
      } else {
        if (side == -1) at_low = at_low / S(2);
        high = middle, at_high = value, side = -1, beyond_ = trial_;
      }
    }
    const S past = low + S(2) * least;
    if (past > high && past < whole && attempt(system, method, state, past, trial_, true) &&
        margin(system, trial_) < S(0))
      high = made_, beyond_ = trial_;
    margin(system, beyond_);
    return high;
  }

  Pieces<S>& pieces_;
  Switches<S>& switches_;
  State<Sys> before_, trial_, beyond_;
  PhaseCheck<Sys> check_;
  std::size_t next_ = 0;  ///< the first event in time after the state
  S made_ = S(0);
  bool switching_ = false, learnt_ = false, begun_ = false;
  long located_ = 0;
  std::optional<double> zeno_;
  std::exception_ptr failed_;
};

}  // namespace liecheck::scene
