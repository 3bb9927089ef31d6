#pragma once
// Evaluates a formula in S. For tight precision it is evaluated in double words and rounded once.

#include <liecheck/scalar/double_word.hpp>
#include <liecheck/scalar/precision.hpp>
#include <liecheck/spatial/se3.hpp>

namespace liecheck {

namespace evaluate_detail {

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

}  // namespace evaluate_detail

/// formula(Arithmetic<S, P>(), arguments...) for fast and standard precision. In tight precision the
/// arguments become double words, the formula is evaluated with precision WIDE, and the result is rounded
/// once. If products of double words overflow, the formula is evaluated in S.
template <Scalar S, Precision P, Precision WIDE = Precision::fast, class F, class... A>
[[gnu::always_inline]] inline auto evaluate(F formula, const A&... arguments) {
  if constexpr (P == Precision::tight) {
    const auto result = evaluate_detail::cast<S>(
        formula(Arithmetic<DoubleWord<S>, WIDE>(), evaluate_detail::cast<DoubleWord<S>>(arguments)...));
    return evaluate_detail::finite(result) ? result
                                           : formula(Arithmetic<S, Precision::standard>(), arguments...);
  } else {
    return formula(Arithmetic<S, P>(), arguments...);
  }
}

}  // namespace liecheck
