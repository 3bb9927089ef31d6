#pragma once
// Switching functions: their signs select the branch of a force that begins, ends or bends where the state
// decides (contact, joint limits, clamped torques). A branch applies where its function g is above 0.
//
// Between two events simulate() holds the branches, so that every stage of a step sees a smooth force and a
// method keeps its order; an event is where a held function changes its sign (event_steps.hpp). Without hold(),
// the sign at each evaluation decides. (Hairer, Norsett & Wanner 1993, II.6; Mannshardt 1978.)

#include <algorithm>
#include <array>
#include <cmath>
#include <liecheck/spatial/types.hpp>
#include <optional>
#include <vector>

namespace liecheck::scene {

template <Scalar S>
class Switches {
  struct Held {
    S value;  ///< at the last evaluation
    S sign;   ///< 1 where the branch applies, and -1 otherwise
  };

 public:
  /// Call before the effects of one evaluation; they then ask in the same order each time.
  void restart() { at_ = 0; }
  /// True if the branch of the next function applies, whose value is g.
  bool on(const S& g) { return next(1)(0, g); }

  /// The next functions of an evaluation.
  class Next {
   public:
    /// True if the branch of the k-th of them applies, whose value is g.
    [[gnu::always_inline]] bool operator()(std::size_t k, const S& g) const {
      if (held_) [[likely]] {
        Held& f = held_[k];
        f.value = g;
        const bool on = f.sign > S(0);
        if (on ? g < S(0) : g > S(0)) [[unlikely]]
          all_->crossed_ = true;
        return on;
      }
      if (all_) all_->held_.push_back({g, S(1)});
      return g > S(0);
    }

   private:
    friend Switches;
    Switches* all_ = nullptr;  ///< null if nothing is to be stored
    Held* held_ = nullptr;
  };
  Next next(std::size_t count) {
    Next functions;
    if (is_held_)
      functions.held_ = held_.data() + at_, functions.all_ = this, at_ += count;
    else if (learning_)
      functions.all_ = this;
    return functions;
  }

  /// The functions of the next evaluation decide their branches themselves, and are stored.
  void learn() { is_held_ = false, learning_ = true, held_.clear(); }
  /// From now on, the branches are those of the last evaluation, which was learnt.
  void hold() {
    for (Held& f : held_) f.sign = f.value > S(0) ? S(1) : S(-1);
    learning_ = false, is_held_ = !held_.empty();
  }
  /// From now on, the branches are those of the last hold().
  void keep() { is_held_ = !held_.empty(); }
  /// From now on, the sign at each evaluation decides.
  void release() { is_held_ = learning_ = false; }

  /// True if a function of the last learnt evaluation is 0: its value does not tell the branch.
  bool ambiguous() const {
    return std::ranges::any_of(held_, [](const Held& f) { return f.value == S(0); });
  }
  bool none() const { return held_.empty(); }
  /// The least distance from a change of sign at the last evaluation: min over k of g_k, or -g_k if the branch is
  /// off. Negative after an event. The functions have units of their own; only the sign counts.
  S margin() const {
    S least = std::numeric_limits<S>::max();
    for (const Held& f : held_) {
      const S g = f.sign * f.value;
      if (!(g >= least)) least = g;  // also if g is not a number
    }
    return least;
  }
  /// Changes the branches whose functions have changed their signs at the last evaluation.
  void change() {
    for (Held& f : held_)
      if (f.sign > S(0) ? !(f.value > S(0)) : f.value > S(0)) f.sign = -f.sign;
  }

  /// Remembers the values of the last evaluation as those at the time t, beside the ones before.
  void remember(double t) {
    if (known_ > 0 && t == times_[1]) return;
    if (known_ > 0 && (t < times_[1] || last_.size() != held_.size())) known_ = 0;
    known_ = std::min(known_ + 1, 2);
    times_[0] = times_[1], times_[1] = t;
    last_.resize(held_.size());
    for (std::size_t k = 0; k < held_.size(); ++k) {
      const double value = double(held_[k].value);
      last_[k] = {value - last_[k][1], value};
    }
  }
  /// Remembers the values of the last evaluation, at the time t, unless a function may have changed its sign twice since
  /// the ones before: the extremum of the parabola through its last three values lies beyond 0, or nearly so. Then it
  /// returns the first such time, and forgets all; otherwise infinity.
  double missed(double t) {
    if (known_ < 2 || last_.size() != held_.size() || !(t > times_[1])) {
      remember(t);
      return std::numeric_limits<double>::infinity();
    }
    double first = std::numeric_limits<double>::infinity();
    const double d = t - times_[1], ratio = d / (times_[1] - times_[0]);
    const Held* held = held_.data();
    for (std::array<double, 2>& last : last_) {
      const double value = double(held->value), rise = value - last[1], before = last[0] * ratio;
      last[0] = rise;
      if (std::abs(last[1]) < 4 * (std::abs(rise) + std::abs(before))) [[unlikely]]
        if (const auto x = beyond(double(held->sign) * last[1], double(held->sign) * rise,
                                  double(held->sign) * before, ratio))
          first = std::min(first, times_[1] + *x * d);
      last[1] = value, ++held;
    }
    times_[0] = times_[1], times_[1] = t;
    if (first < std::numeric_limits<double>::infinity()) known_ = 0;
    return first;
  }
  /// The remembered values, for a run that is saved and continued.
  std::vector<double> history() const {
    std::vector<double> all{double(known_), times_[0], times_[1]};
    for (const auto& values : last_) all.insert(all.end(), values.begin(), values.end());
    return all;
  }
  void recall(const std::vector<double>& all) {
    if (all.size() < 3) return;
    known_ = int(all[0]), times_[0] = all[1], times_[1] = all[2];
    last_.resize((all.size() - 3) / 2);
    for (std::size_t k = 0; k < last_.size(); ++k) last_[k] = {all[3 + 2 * k], all[4 + 2 * k]};
  }
  /// Whether what a step takes from the steps before it is in the state, in this history and in the memory of the method.
  bool settled() const { return settled_; }
  void settle(bool settled) { settled_ = settled; }

  /// True if a function had the other sign in an evaluation since forget().
  bool crossed() const { return crossed_; }
  /// Methods call it before the evaluations that enter the result, such as the last iteration of an implicit one.
  void forget() { crossed_ = false; }

 private:
  std::vector<Held> held_;
  /// The share x in (0, 1) of a step at which g + slope x + bend x^2, which rose by `rise` in it and at the rate of `before`
  /// in the step before, is least, if that is below g/10.
  static std::optional<double> beyond(double g, double rise, double before, double ratio) {
    const double bend = (rise - before) * ratio / (1 + ratio), slope = rise - bend;
    if (!(bend > 0)) return {};
    const double x = -slope / (2 * bend);
    if (x > 0.02 && x < 0.98 && -slope * x / 2 > 0.9 * g) return x;
    return {};
  }

  std::vector<std::array<double, 2>>
      last_;  ///< what each rose by between the two times, and its value at the later one
  double times_[2] = {0, 0};
  int known_ = 0;
  bool settled_ = true;
  std::size_t at_ = 0;  ///< the next function
  bool is_held_ = false, learning_ = false, crossed_ = false;
};

}  // namespace liecheck::scene
