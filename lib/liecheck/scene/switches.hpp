#pragma once
// Switching functions: their signs select the branch of a force that begins, ends or bends where the state
// decides (contact, joint limits, clamped torques). A branch applies where its function g is above 0.
//
// Between two events simulate() holds the branches, so that every stage of a step sees a smooth force and a
// method keeps its order; an event is where a held function changes its sign (event_steps.hpp). Without hold(),
// the sign at each evaluation decides. (Hairer, Norsett & Wanner 1993, II.6; Mannshardt 1978.)

#include <liecheck/spatial/types.hpp>
#include <vector>

namespace liecheck::scene {

template <Scalar S>
class Switches {
 public:
  /// Call before the effects of one evaluation; they then ask in the same order each time.
  void restart() { at_ = 0; }
  /// True if the branch of the next function applies, whose value is g.
  bool on(const S& g) {
    if (!held_) [[likely]] {
      if (learning_) values_.push_back(g);
      return g > S(0);
    }
    const std::size_t k = at_++;
    values_[k] = g;
    if (branches_[k] ? g < S(0) : g > S(0)) crossed_ = true;
    return branches_[k];
  }

  /// The functions of the next evaluation decide their branches themselves, and are stored.
  void learn() { held_ = false, learning_ = true, values_.clear(); }
  /// From now on, the branches are those of the last evaluation, which was learnt.
  void hold() {
    branches_.clear();
    for (const S& g : values_) branches_.push_back(g > S(0));
    learning_ = false, held_ = !branches_.empty();
  }
  /// From now on, the branches are those of the last hold().
  void keep() { held_ = !branches_.empty(); }
  /// From now on, the sign at each evaluation decides.
  void release() { held_ = learning_ = false; }

  bool none() const { return values_.empty(); }
  /// The least distance from a change of sign at the last evaluation: min over k of g_k, or -g_k if the branch is
  /// off. Negative after an event. The functions have units of their own; only the sign counts.
  S margin() const {
    S least = std::numeric_limits<S>::max();
    for (std::size_t k = 0; k < values_.size(); ++k) {
      const S g = branches_[k] ? values_[k] : S(-values_[k]);
      if (!(g >= least)) least = g;  // also if g is not a number
    }
    return least;
  }
  /// Changes the branches whose functions have changed their signs at the last evaluation.
  void change() {
    for (std::size_t k = 0; k < values_.size(); ++k)
      if (branches_[k] ? !(values_[k] > S(0)) : values_[k] > S(0)) branches_[k] = !branches_[k];
  }

  /// True if a function had the other sign in an evaluation since forget().
  bool crossed() const { return crossed_; }
  /// Methods call it before the evaluations that enter the result, such as the last iteration of an implicit one.
  void forget() { crossed_ = false; }

 private:
  std::vector<S> values_;       ///< of the last evaluation
  std::vector<char> branches_;  ///< true where the branch applies
  std::size_t at_ = 0;          ///< the next function
  bool held_ = false, learning_ = false, crossed_ = false;
};

}  // namespace liecheck::scene
