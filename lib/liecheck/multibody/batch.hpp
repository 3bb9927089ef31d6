#pragma once
// exp, log, integrate, difference and act of many poses at once, by SIMD instructions. Poses are stored as a
// structure of arrays: each column is one pose, and each row holds one number of all poses.
//
// Every function has a counterpart for one pose, whose error bounds hold for each column. The counterpart
// itself computes the columns that need a branch (|phi| > pi, close poses, |phi| within 1e-3 of pi,
// quaternions off unit, results that are not finite), and the last columns that fill no register.

#include <liecheck/multibody/se3_configuration.hpp>
#include <liecheck/scalar/simd.hpp>

namespace liecheck::batch {

/// ROWS numbers of each of m poses [ROWS x m].
template <class S, int ROWS>
using Rows = Eigen::Array<S, ROWS, Eigen::Dynamic, Eigen::RowMajor>;

namespace detail {

template <class T, class S, int ROWS>
[[gnu::always_inline]] inline Eigen::Matrix<T, ROWS, 1> load(const Rows<S, ROWS>& rows, Eigen::Index column) {
  Eigen::Matrix<T, ROWS, 1> v;
  for (int r = 0; r < ROWS; ++r)
    if constexpr (side_by_side<T>)
      v[r] = T::load(&rows(r, column));
    else
      v[r] = rows(r, column);
  return v;
}

/// Applies f to every column. usual_path(result, arguments...) returns which lanes needed no branch.
template <int ROWS, class S, class F, class UsualPath, int... IN>
Rows<S, ROWS> map(F f, UsualPath usual_path, const Rows<S, IN>&... arguments) {
  using P = Simd<S, register_bytes / int(sizeof(S))>;
  constexpr Eigen::Index width = P::size;
  const Eigen::Index n = std::get<0>(std::forward_as_tuple(arguments...)).cols();
  Rows<S, ROWS> all(ROWS, n);
  const auto alone = [&](Eigen::Index i) {
    const Eigen::Matrix<S, ROWS, 1> one = f(load<S>(arguments, i)...);
    all.col(i) = one.array();
  };
  Eigen::Index i = 0;
  for (; i + width <= n; i += width) {
    const auto usual = [&](const auto&... loaded) __attribute__((always_inline)) {
      const Eigen::Matrix<P, ROWS, 1> r = f(loaded...);
      for (int k = 0; k < ROWS; ++k) r[k].store(&all(k, i));
      return usual_path(r, loaded...);
    }
    (load<P>(arguments, i)...);
    bool all_usual = true;
    for (Eigen::Index lane = 0; lane < width; ++lane) all_usual &= usual[lane] != 0;
    if (all_usual) continue;
    for (Eigen::Index lane = 0; lane < width; ++lane)
      if (usual[lane] == 0) alone(i + lane);
  }
  for (; i < n; ++i) alone(i);
  return all;
}

/// The lanes in which the squared norm of v[first .. first + 2] is in [least, most]; false for NaN.
template <class P, class V>
[[gnu::always_inline]] inline auto within(const V& v, int first, Lane<P> least, Lane<P> most) {
  const P x = v[first] * v[first] + (v[first + 1] * v[first + 1] + v[first + 2] * v[first + 2]);
  return (x.v >= least) & (x.v <= most);
}
/// |Q|^2 - 1 of the quaternion Q = v[first .. first + 3].
template <class P, class V>
[[gnu::always_inline]] inline P norm_excess(const V& v, int first) {
  return (v[first] * v[first] + v[first + 1] * v[first + 1]) +
         (v[first + 2] * v[first + 2] + v[first + 3] * v[first + 3]) - P(1);
}
/// The lanes in which the squared norm of the quaternion v[first .. first + 3] is 1 up to 16 eps.
template <class P, class V>
[[gnu::always_inline]] inline auto unit(const V& v, int first) {
  const P x = norm_excess<P>(v, first);
  const Lane<P> most = eps<Lane<P>>() * 16;
  return (x.v >= -most) & (x.v <= most);
}
/// The lanes in which a first-order normalisation of the quaternion v[first .. first + 3] suffices.
template <class P, class V>
[[gnu::always_inline]] inline auto near_unit(const V& v, int first) {
  const P x = norm_excess<P>(v, first);
  return x.v * x.v < eps<Lane<P>>() / 4;
}
template <class S>
constexpr S huge = std::numeric_limits<S>::max() * eps<S>() * eps<S>();  ///< no branch up to this |v|^2

}  // namespace detail

/// integrateSE3 of each column: q [7 x m; m], delta [6 x m; m, rad]. Result [7 x m].
template <std::floating_point S>
Rows<S, 7> integrate(const Rows<S, 7>& q, const Rows<S, 6>& delta) {
  const auto f = [](const auto& a, const auto& b) { return integrateSE3(a, b); };
  const auto usual_path = []<class P>(const Vector7<P>&, const Vector7<P>& a, const Vector6<P>& b) {
    return detail::within<P>(b, 3, 0, stumpff_detail::series_limit<S>()) &
           detail::within<P>(b, 0, 0, detail::huge<S>) & detail::near_unit<P>(a, 3);
  };
  return detail::map<7, S>(f, usual_path, q, delta);
}

/// differenceSE3 of each column: q0, q1 [7 x m; m]. Result [6 x m; m, rad].
template <std::floating_point S>
Rows<S, 6> difference(const Rows<S, 7>& q0, const Rows<S, 7>& q1) {
  const auto f = [](const auto& a, const auto& b) { return differenceSE3(a, b); };
  const auto usual_path = []<class P>(const Vector6<P>& r, const Vector7<P>& a, const Vector7<P>& b) {
    return detail::within<P>(r, 3, S(10000) * eps<S>(), S(9.86)) &
           detail::within<P>(r, 0, 0, detail::huge<S>) & detail::unit<P>(a, 3) & detail::unit<P>(b, 3);
  };
  return detail::map<6, S>(f, usual_path, q0, q1);
}

/// quaternion::exp6 of each column: xi [6 x m; m, rad]. Result [7 x m; m].
template <std::floating_point S>
Rows<S, 7> exp6(const Rows<S, 6>& xi) {
  const auto f = []<class T>(const Vector6<T>& a) { return quaternion::exp6<T>(Motion<T>(a)); };
  const auto usual_path = []<class P>(const Vector7<P>&, const Vector6<P>& a) {
    return detail::within<P>(a, 3, 0, stumpff_detail::series_limit<S>());
  };
  return detail::map<7, S>(f, usual_path, xi);
}

/// quaternion::log6 of each column: q [7 x m; m]. Result [6 x m; m, rad].
template <std::floating_point S>
Rows<S, 6> log6(const Rows<S, 7>& q) {
  const auto f = []<class T>(const Vector7<T>& a) { return quaternion::log6<T>(a).to_vector(); };
  const auto usual_path = []<class P>(const Vector6<P>&, const Vector7<P>& a) {
    return detail::unit<P>(a, 3);
  };
  return detail::map<6, S>(f, usual_path, q);
}

/// R(Q) x + p of each column: q = [p; x y z w] [7 x m; m], x [3 x m; m]. Result [3 x m; m].
template <std::floating_point S>
Rows<S, 3> act(const Rows<S, 7>& q, const Rows<S, 3>& x) {
  const auto f = []<class T>(const Vector7<T>& a, const Vector3<T>& b) {
    const Vector3<T> r = SO3<T>(Vector4<T>(a[3], a[4], a[5], a[6])).act(b);
    return Vector3<T>(a[0] + r[0], a[1] + r[1], a[2] + r[2]);
  };
  const auto usual_path = []<class P>(const Vector3<P>&, const Vector7<P>& a, const Vector3<P>& b) {
    return detail::within<P>(b, 0, 0, detail::huge<S>) & detail::near_unit<P>(a, 3);
  };
  return detail::map<3, S>(f, usual_path, q, x);
}

}  // namespace liecheck::batch
