#pragma once
// Precision::tight: the same formula in twice the digits, its result rounded once.

#include <liecheck/scalar/double_double.hpp>
#include <liecheck/spatial/se3.hpp>

namespace liecheck::tight_detail {

template <Scalar T, class S, int R, int C>
Eigen::Matrix<T, R, C> cast(const Eigen::Matrix<S, R, C>& m) {
  return m.template cast<T>();
}
template <Scalar T, Scalar S>
Motion<T> cast(const Motion<S>& V) {
  return {cast<T>(V.linear()), cast<T>(V.angular())};
}
template <Scalar T, Scalar S>
SO3<T> cast(const SO3<S>& Q) {
  return SO3<T>(cast<T>(Q.to_vector()));
}
template <Scalar T, Scalar S>
SE3<T> cast(const SE3<S>& X) {
  return X.template cast<T>();
}

template <class S, int R, int C>
bool finite(const Eigen::Matrix<S, R, C>& m) {
  for (int i = 0; i < m.size(); ++i)
    if (!liecheck::finite<S>(m.data()[i])) return false;
  return true;
}
template <Scalar S>
bool finite(const Motion<S>& V) {
  return finite(V.linear()) && finite(V.angular());
}
template <Scalar S>
bool finite(const SO3<S>& Q) {
  return finite(Q.to_vector());
}
template <Scalar S>
bool finite(const SE3<S>& X) {
  return finite(X.rotation()) && finite(X.translation());
}

/// f(arguments...) with the arguments in twice the digits of S, or otherwise() where a product overflows in them a few
/// binades before the result does.
template <Scalar S, class F, class G, class... A>
auto rounded(F f, G otherwise, const A&... arguments) {
  const auto result = cast<S>(f(cast<DoubleDouble<S>>(arguments)...));
  return finite(result) ? result : otherwise();
}

}  // namespace liecheck::tight_detail
