#pragma once
// Steps in a phase of the forces that may be shorter than a step: after an event, and in a part of a step that events cut.
//
// A step s is compared with two of s/2. It is accepted if both agree, with a method of order p, in maximum norms, to
//
//   |v_2 - v_1| <= r^p tolerance (|v_2 - v_0| + |v_0|/1000),   |q_2 - q_1| <= s times the same,
//   tolerance = max(1e-4, 10^(-1 - 3p/4)),   r = 1 in a run
//
// and otherwise taken again with s 0.9 (error/tolerance)^(-1/p). So a contact of a mass m with the stiffness k, which lasts
// pi sqrt(m/k), has about eight steps, whatever the step of the run is. The check ends once two steps of at least h/2 were
// accepted, or 8 h after the event: a longer phase is taken in steps of the run, as other motions are. The tolerance is a
// hundredth of the accepted error of a motion, 1 % of its extent; |v_0|/1000 keeps it above 0 where no force acts.
//
// A step of the run ends the check after 8192 comparisons: as many as steps of h/4096 in it, each refused once. The rest of it
// is taken in whole parts, and the phase is unresolved.
//
// Runs that estimate the error of this one (estimate.hpp) have another r, so that their steps differ inside of phases, too.
// They may also divide every step, of phases and of parts, into equal ones.

#include <cmath>
#include <liecheck/scene/integrators/method.hpp>

namespace liecheck::scene {

/// Steps that were shortened within phases.
struct PhaseSteps {
  long count = 0;
  double shortest = 0;  ///< length of the shortest one [s], or 0
  std::optional<double>
      unresolved;  ///< first time at which steps of h/4096 differ by more than 1e-6 of v, or too many are compared [s]
  long tried = 0;  ///< steps that were compared with two of half the length
};

template <class Sys>
class PhaseCheck {
 public:
  using S = typename Sys::Scalar;
  /// A run that compares more than `most` steps fails.
  PhaseCheck(const State<Sys>& state, const MethodInfo& method, double ratio, int divide, long most)
      : twice_(state),
        order_(method.order),
        divide_(divide),
        most_(most),
        tolerance_(std::max(1e-4, std::pow(10., -1 - 0.75 * method.order)) * std::pow(ratio, method.order)),
        enabled_(method.order > 1 && !method.adaptive) {}

  const PhaseSteps& made() const { return made_; }
  int divide() const { return divide_; }
  /// True while steps are to be checked.
  bool due() const { return left_ > 0; }
  /// A step of the run begins.
  void beginStep() { compared_ = 0; }
  /// A phase begins in a run with steps of h.
  void begin(const S& h) {
    if (!enabled_ || compared_ >= most_in_a_step) return;
    if (!due()) wish_ = h;
    left_ = 2, age_ = S(0);
  }
  /// The length that the check wants next.
  const S& next() const { return wish_; }
  /// `length`, or if the check is due an equal part of `rest` that it does not find too long.
  S shorten(const S& length, const S& rest) const {
    using std::ceil;
    if (!due()) return length;
    const S most = std::min(length, wish_);
    return most < rest ? S(rest / S(ceil(S(rest / most)))) : rest;
  }

  /// Whether `once`, a step of s from `from` (null if it failed), agrees with two of s/2, which halves(s/2, end) takes.
  template <class Halves>
  bool agrees(const Sys& system, const State<Sys>* once, const State<Sys>& from, const S& s, const S& whole,
              Halves halves) {
    using std::max, std::min, std::pow;
    if (++made_.tried > most_) throw StepFailed("phases of the forces take too many steps");
    if (++compared_ >= most_in_a_step) {
      if (!made_.unresolved) made_.unresolved = double(from.t);
      left_ = 0;
      if (once) return true;
    }
    S error = std::numeric_limits<S>::infinity(), apart = error;
    if (once && halves(S(s / S(2)), twice_)) {
      const auto size = [](const auto& x) { return S(x.cwiseAbs().maxCoeff()); };
      const S v = size(from.v),
              allowed = S(tolerance_) * S(size(typename Sys::Tangent(twice_.v - from.v)) + v / S(1000));
      const S rounding = S(64) * eps<S>();
      const auto in = [](const S& x, const S& unit) {
        return x == S(0) ? S(0) : S(x / unit);
      };  // 0 of a body at rest
      const S d_v = size(typename Sys::Tangent(twice_.v - once->v));
      const S e_v = in(d_v, S(allowed + rounding * v)),
              e_q = in(size(system.difference(once->q, twice_.q)), S(s * allowed + rounding * S(1 + s * v)));
      if (finite<S>(e_v) && finite<S>(e_q)) error = max(e_v, e_q), apart = d_v / S(v + eps<S>());
    }
    S factor = error > S(0) ? S(S(9) / S(10) * S(pow(error, S(S(-1) / S(order_))))) : S(4);
    factor = min(S(4), max(S(S(1) / S(10)), factor));
    const bool agree = !(error > S(1));
    if (!agree && s > whole / S(4096)) {
      wish_ = s * min(factor, S(S(7) / S(10)));
      return false;
    }
    if (!agree && !made_.unresolved && !(apart <= S(1) / S(1000000))) made_.unresolved = double(from.t);
    if (wish_ < whole) {
      ++made_.count;
      made_.shortest = made_.count == 1 ? double(s) : std::min(made_.shortest, double(s));
      wish_ = min(whole, S(s * max(factor, S(1))));
    }
    age_ += s;
    if (!(s < whole / S(2))) --left_;
    if (age_ > S(8) * whole) left_ = 0;
    return true;
  }

 private:
  static constexpr long most_in_a_step = 8192;

  State<Sys> twice_;
  int order_, divide_;
  long most_;
  double tolerance_;
  bool enabled_;
  int left_ = 0;
  long compared_ = 0;  ///< in this step of the run
  S age_ = S(0), wish_ = S(0);
  PhaseSteps made_;
};

}  // namespace liecheck::scene
