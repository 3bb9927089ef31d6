#pragma once
// Integrates a tree in maximal coordinates: Gragg's modified midpoint rule, extrapolated in h^2 until two
// columns agree (Hairer, Norsett & Wanner 1993, II.9). No step contains an event: a step ends at the times of
// the laws, and where a function of a branch changes its sign. Forces are continuous there, so that an error
// of the event's time enters the motion with its square.

#include <atomic>
#include <oracles/motions/maximal_tree.hpp>

namespace liecheck::oracles {

template <class T>
class MaximalMotion {
 public:
  /// A step's error is at most `tolerance` (1 + largest number of the state). Once `stop` is set, to() throws
  /// std::runtime_error.
  MaximalMotion(MaximalTree<T> tree, const std::vector<T>& q, const std::vector<T>& v, const T& tolerance,
                const std::atomic<bool>* stop = nullptr);

  /// Advances to `end`, at or after the time reached so far. Throws std::domain_error if steps get too short.
  void to(const T& end);
  void coordinates(std::vector<T>& q, std::vector<T>& v) { tree_.coordinates(y_, q, v); }
  long evaluations() const { return evaluations_; }
  long events() const { return events_; }

 private:
  Numbers<T> rate(const T& t, const Numbers<T>& y) {
    ++evaluations_;
    return tree_.rate(t, inside_, y, branches_);
  }
  bool step(const T& h, Numbers<T>& end);
  void piece(const T& end);
  T locate(T high, T at_high);
  T margin(const T& t, const Numbers<T>& y) {
    rate(t, y);
    return branches_.margin();
  }

  MaximalTree<T> tree_;
  Branches<T> branches_;
  Numbers<T> y_;
  T t_ = T(0), inside_ = T(0), length_ = T(0), tolerance_;
  int columns_ = 0;  ///< of the last step
  long evaluations_ = 0, events_ = 0;
  const std::atomic<bool>* stop_;
};

extern template class MaximalMotion<boost::multiprecision::float128>;
extern template class MaximalMotion<long double>;

}  // namespace liecheck::oracles
