#pragma once
// The operations on batches of poses: the formula for one column, and which columns need no branch of it.

#include <liecheck/batch/poses.hpp>
#include <liecheck/multibody/se3_configuration.hpp>
#include <tuple>

namespace liecheck::batch::detail {

template <class T>
using Vector12 = Eigen::Matrix<T, 12, 1>;
template <class T>
using Vector36 = Eigen::Matrix<T, 36, 1>;

/// The lanes in which the squared norm of v[first .. first + 2] is in [least, most]; not NaN.
template <class P, class V>
[[gnu::always_inline]] inline auto within(const V& v, int first, Lane<P> least, Lane<P> most) {
  const P x = v[first] * v[first] + (v[first + 1] * v[first + 1] + v[first + 2] * v[first + 2]);
  return (x.v >= least) & (x.v <= most);
}
/// |Q|^2 - 1 of the quaternion Q = v[first .. first + 3].
template <class P, class V>
[[gnu::always_inline]] inline P normExcess(const V& v, int first) {
  return (v[first] * v[first] + v[first + 1] * v[first + 1]) +
         (v[first + 2] * v[first + 2] + v[first + 3] * v[first + 3]) - P(1);
}
/// The lanes in which the squared norm of the quaternion v[first .. first + 3] is 1 up to 16 eps.
template <class P, class V>
[[gnu::always_inline]] inline auto unit(const V& v, int first) {
  const P x = normExcess<P>(v, first);
  const Lane<P> most = eps<Lane<P>>() * 16;
  return (x.v >= -most) & (x.v <= most);
}
/// The lanes in which a first-order normalisation of the quaternion v[first .. first + 3] suffices.
template <class P, class V>
[[gnu::always_inline]] inline auto nearUnit(const V& v, int first) {
  const P x = normExcess<P>(v, first);
  return x.v * x.v < eps<Lane<P>>() / 4;
}
/// The lanes in which |phi| <= pi for phi = v[first .. first + 2].
template <class P, class V>
[[gnu::always_inline]] inline auto belowPi(const V& v, int first) {
  return within<P>(v, first, Lane<P>(0), stumpff_detail::series_limit<Lane<P>>());
}
/// The lanes in which |v|^2 of v[first .. first + 2] needs no branch.
template <class P, class V>
[[gnu::always_inline]] inline auto moderate(const V& v, int first) {
  using S = Lane<P>;
  return within<P>(v, first, S(0), std::numeric_limits<S>::max() * eps<S>() * eps<S>());
}

/// R [3 x 3] of the first nine numbers, row by row, and p [m] of the last three.
template <class T>
[[gnu::always_inline]] inline SE3<T> pose(const Vector12<T>& X) {
  return SE3<T>(rows<T>(X[0], X[1], X[2], X[3], X[4], X[5], X[6], X[7], X[8]),
                Vector3<T>(X[9], X[10], X[11]));
}
template <class T>
[[gnu::always_inline]] inline Vector12<T> numbers(const SE3<T>& X) {
  Vector12<T> v;
#pragma GCC unroll 12
  for (int i = 0; i < 12; ++i) v[i] = i < 9 ? X.rotation()(i / 3, i % 3) : X.translation()[i - 9];
  return v;
}
template <class T>
[[gnu::always_inline]] inline Vector36<T> numbers(const Matrix6<T>& J) {
  Vector36<T> v;
#pragma GCC unroll 36
  for (int i = 0; i < 36; ++i) v[i] = J(i / 6, i % 6);
  return v;
}

// Each operation has the rows of its arguments and of its result, formula(arguments...) for one column or a
// pack of columns and, if the formula has branches, usual(result, arguments...): the lanes of a pack that
// take none. The other lanes are computed one by one.
struct Integrate {
  static constexpr int arguments[] = {7, 6}, rows = 7;
  template <class T>
  [[gnu::always_inline]] static Vector7<T> formula(const Vector7<T>& q, const Vector6<T>& delta) {
    return integrateSE3<T>(q, delta);
  }
  template <class P>
  [[gnu::always_inline]] static auto usual(const Vector7<P>&, const Vector7<P>& q, const Vector6<P>& delta) {
    return belowPi<P>(delta, 3) & moderate<P>(delta, 0) & nearUnit<P>(q, 3);
  }
};
struct Difference {
  static constexpr int arguments[] = {7, 7}, rows = 6;
  template <class T>
  [[gnu::always_inline]] static Vector6<T> formula(const Vector7<T>& q0, const Vector7<T>& q1) {
    return differenceSE3<T>(q0, q1);
  }
  template <class P>
  [[gnu::always_inline]] static auto usual(const Vector6<P>& delta, const Vector7<P>& q0,
                                           const Vector7<P>& q1) {
    using S = Lane<P>;
    return within<P>(delta, 3, eps<S>() * eps<S>(), S(9.86)) & moderate<P>(delta, 0) & unit<P>(q0, 3) &
           unit<P>(q1, 3);
  }
};
struct Exp6 {
  static constexpr int arguments[] = {6}, rows = 7;
  template <class T>
  [[gnu::always_inline]] static Vector7<T> formula(const Vector6<T>& xi) {
    return quaternion::exp6<T>(Motion<T>(xi));
  }
  template <class P>
  [[gnu::always_inline]] static auto usual(const Vector7<P>&, const Vector6<P>& xi) {
    return belowPi<P>(xi, 3);
  }
};
struct Log6 {
  static constexpr int arguments[] = {7}, rows = 6;
  template <class T>
  [[gnu::always_inline]] static Vector6<T> formula(const Vector7<T>& q) {
    return quaternion::log6<T>(q).to_vector();
  }
  template <class P>
  [[gnu::always_inline]] static auto usual(const Vector6<P>&, const Vector7<P>& q) {
    return unit<P>(q, 3);
  }
};
struct Exp6Matrix {
  static constexpr int arguments[] = {6}, rows = 12;
  template <class T>
  [[gnu::always_inline]] static Vector12<T> formula(const Vector6<T>& xi) {
    return numbers<T>(exp6<T>(Motion<T>(xi)));
  }
  template <class P>
  [[gnu::always_inline]] static auto usual(const Vector12<P>&, const Vector6<P>& xi) {
    return belowPi<P>(xi, 3);
  }
};
struct Compose {
  static constexpr int arguments[] = {12, 12}, rows = 12;
  template <class T>
  [[gnu::always_inline]] static Vector12<T> formula(const Vector12<T>& X, const Vector12<T>& Y) {
    return numbers<T>(pose<T>(X) * pose<T>(Y));
  }
};
struct ActMatrix {
  static constexpr int arguments[] = {12, 3}, rows = 3;
  template <class T>
  [[gnu::always_inline]] static Vector3<T> formula(const Vector12<T>& X, const Vector3<T>& x) {
    return pose<T>(X).act(x);
  }
};
struct Act {
  static constexpr int arguments[] = {7, 3}, rows = 3;
  template <class T>
  [[gnu::always_inline]] static Vector3<T> formula(const Vector7<T>& q, const Vector3<T>& x) {
    const Vector3<T> r = SO3<T>(Vector4<T>(q[3], q[4], q[5], q[6])).act(x);
    return Vector3<T>(q[0] + r[0], q[1] + r[1], q[2] + r[2]);
  }
  template <class P>
  [[gnu::always_inline]] static auto usual(const Vector3<P>&, const Vector7<P>& q, const Vector3<P>& x) {
    return moderate<P>(x, 0) & nearUnit<P>(q, 3);
  }
};
struct RightJacobian {
  static constexpr int arguments[] = {6}, rows = 36;
  template <class T>
  [[gnu::always_inline]] static Vector36<T> formula(const Vector6<T>& xi) {
    return numbers<T>(Jexp6<T>(Motion<T>(xi)));
  }
  template <class P>
  [[gnu::always_inline]] static auto usual(const Vector36<P>&, const Vector6<P>& xi) {
    return belowPi<P>(xi, 3);
  }
};
struct RightJacobianInverse {
  static constexpr int arguments[] = {6}, rows = 36;
  template <class T>
  [[gnu::always_inline]] static Vector36<T> formula(const Vector6<T>& xi) {
    return numbers<T>(rightJacobianInverse<T>(Motion<T>(xi)));
  }
  template <class P>
  [[gnu::always_inline]] static auto usual(const Vector36<P>&, const Vector6<P>& xi) {
    return belowPi<P>(xi, 3);
  }
};
struct LogJacobian {
  static constexpr int arguments[] = {7}, rows = 36;
  template <class T>
  [[gnu::always_inline]] static Vector36<T> formula(const Vector7<T>& q) {
    return numbers<T>(rightJacobianInverse<T>(quaternion::log6<T>(q)));
  }
  template <class P>
  [[gnu::always_inline]] static auto usual(const Vector36<P>&, const Vector7<P>& q) {
    return unit<P>(q, 3);
  }
};

/// In the order of the enumeration Operation.
using Operations = std::tuple<Exp6, Log6, Integrate, Difference, Act, Exp6Matrix, Compose, ActMatrix,
                              RightJacobian, RightJacobianInverse, LogJacobian>;

}  // namespace liecheck::batch::detail
