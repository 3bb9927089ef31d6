#pragma once
// Switching functions: their signs select the branch of a force that begins, ends or bends where the state
// decides (contact, joint limits, clamped torques). A branch applies where its function g is above 0.
//
// Between two events simulate() holds the branches, so that every stage of a step sees a smooth force and a
// method keeps its order; an event is where a held function changes its sign (event_steps.hpp). Without hold(),
// the sign at each evaluation decides. (Hairer, Norsett & Wanner 1993, II.6; Mannshardt 1978.)

#include <algorithm>
#include <liecheck/spatial/types.hpp>
#include <vector>

namespace liecheck::scene {

template <Scalar S>
class Switches {
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
    typename Switches::Held* held_ = nullptr;
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

  /// True if a function had the other sign in an evaluation since forget().
  bool crossed() const { return crossed_; }
  /// Methods call it before the evaluations that enter the result, such as the last iteration of an implicit one.
  void forget() { crossed_ = false; }

 private:
  struct Held {
    S value;  ///< at the last evaluation
    S sign;   ///< 1 where the branch applies, and -1 otherwise
  };
  std::vector<Held> held_;
  std::size_t at_ = 0;  ///< the next function
  bool is_held_ = false, learning_ = false, crossed_ = false;
};

}  // namespace liecheck::scene
