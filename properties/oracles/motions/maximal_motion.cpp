#include <oracles/motions/maximal_motion.hpp>
#include <stdexcept>

namespace liecheck::oracles {
namespace {

constexpr int most_columns = 14, usual_columns = 10;

}  // namespace

template <class T>
MaximalMotion<T>::MaximalMotion(MaximalTree<T> tree, const std::vector<T>& q, const std::vector<T>& v,
                                const T& tolerance, const std::atomic<bool>* stop)
    : tree_(std::move(tree)), y_(tree_.state(q, v)), tolerance_(tolerance), stop_(stop) {}

/// The state after h. False if the columns do not agree. Notes in branches_.crossed whether a function
/// changes its sign within the finest column.
template <class T>
bool MaximalMotion<T>::step(const T& h, Numbers<T>& end) {
  if (stop_ && *stop_) throw std::runtime_error("stopped");
  std::vector<Numbers<T>> row;
  const Numbers<T> slope = rate(t_, y_);
  const T allowed = tolerance_ * (T(1) + y_.cwiseAbs().maxCoeff());
  for (int j = 0; j < most_columns; ++j) {
    const int n = 2 * (j + 1);
    const T part = h / T(n);
    Numbers<T> before = y_, now = y_ + part * slope;
    branches_.crossed = false;
    for (int i = 1; i < n; ++i) {
      Numbers<T> next = before + T(2) * part * rate(T(t_ + T(i) * part), now);
      before.swap(now), now.swap(next);
    }
    T error = std::numeric_limits<T>::max();
    for (int k = 1; k <= j; ++k) {
      const T ratio = T(j + 1) / T(j + 1 - k);
      Numbers<T>& last = row[std::size_t(k - 1)];
      const Numbers<T> change = (now - last) / (ratio * ratio - T(1));
      last = now, now += change;
      error = change.cwiseAbs().maxCoeff();
    }
    row.push_back(now);
    if (error <= allowed) {
      columns_ = j + 1, end = now;
      return true;
    }
  }
  return false;
}

/// The length of the step to the first change of sign before `high`, to `sharp`. It lies beyond the change.
template <class T>
T MaximalMotion<T>::locate(T high, T at_high) {
  using std::sqrt;
  const T sharp = T(sqrt(tolerance_)) / T(16);
  T low(0), at_low = std::max(margin(t_, y_), T(0));
  Numbers<T> end;
  for (int k = 0, side = 0; high - low > sharp; ++k) {
    T middle = k % 3 == 2 ? T((low + high) / T(2)) : T(low + (high - low) * (at_low / (at_low - at_high)));
    middle = std::clamp<T>(middle, low + sharp / T(2), high - sharp / T(2));
    const T value = step(middle, end) ? margin(T(t_ + middle), end) : T(-1);
    if (value > 0) {
      if (side > 0) at_high /= T(2);
      low = middle, at_low = value, side = 1;
    } else {
      if (side < 0) at_low /= T(2);
      high = middle, at_high = value, side = -1;
    }
  }
  return high;
}

/// Advances within a piece, in which no law has an event in time.
template <class T>
void MaximalMotion<T>::piece(const T& end) {
  inside_ = (t_ + end) / T(2);
  const T whole = end - t_, least = whole * T(std::numeric_limits<T>::epsilon()) * T(1024);
  if (!(length_ > 0)) length_ = whole;
  Numbers<T> next;
  while (t_ < end) {
    if (!branches_.held) rate(t_, y_), branches_.held = true;
    T h = std::min<T>(length_, end - t_);
    const bool shortest = h < whole * T(1e-6);
    if (!step(h, next) || (branches_.crossed && !shortest && !(margin(T(t_ + h), next) < 0))) {
      length_ = h / T(2);
      if (length_ < least) throw std::domain_error("maximal_motion: the motion is too stiff, or not finite");
      continue;
    }
    const int columns = columns_;
    const T reached = margin(T(t_ + h), next);
    if (reached < 0) {
      h = locate(h, reached);
      if (!step(h, next)) throw std::domain_error("maximal_motion: a step across an event fails");
      margin(T(t_ + h), next);
      branches_.change(), ++events_;
    } else if (columns <= usual_columns && h == length_) {
      length_ = h * (columns < usual_columns - 2 ? T(2) : T(1.2));
    }
    y_ = next;
    t_ = h < end - t_ ? T(t_ + h) : end;
    std::vector<T> q, v;
    tree_.coordinates(y_, q, v);  // follows angles beyond pi
  }
}

template <class T>
void MaximalMotion<T>::to(const T& end) {
  for (const T& time : tree_.times())
    if (t_ < time && time < end) piece(time);
  if (t_ < end) piece(end);
}

template class MaximalMotion<boost::multiprecision::float128>;
template class MaximalMotion<long double>;

}  // namespace liecheck::oracles
