#pragma once
// Pieces: the times at which the forces of a scene are known to jump or bend. simulate() ends a step at each
// of them, and every stage of a step sees the forces of the piece in which the step lies.

#include <algorithm>
#include <liecheck/spatial/types.hpp>
#include <optional>
#include <vector>

namespace liecheck::scene {

template <Scalar S>
class Pieces {
 public:
  void add(const std::vector<S>& times) {
    for (const S& t : times)
      if (finite<S>(t)) times_.push_back(t);
    std::sort(times_.begin(), times_.end());
    times_.erase(std::unique(times_.begin(), times_.end()), times_.end());
  }
  const std::vector<S>& times() const { return times_; }  ///< increasing [s]

  /// From now on, the piece is the one that holds `inside`, whatever the time of an evaluation is.
  void hold(const S& inside) { held_ = inside; }
  /// From now on, the piece is the one that begins at or before the time of an evaluation.
  void release() { held_.reset(); }
  /// A time inside the piece for an evaluation at t.
  const S& at(const S& t) const { return held_ ? *held_ : t; }

 private:
  std::vector<S> times_;
  std::optional<S> held_;
};

}  // namespace liecheck::scene
