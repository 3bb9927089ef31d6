#pragma once
// Vectors and matrices, and small products that are written entry by entry. The README explains the notation.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <liecheck/scalar/scalar.hpp>
#include <limits>

namespace liecheck {

template <class S>
using Vector3 = Eigen::Matrix<S, 3, 1>;
template <class S>
using Vector4 = Eigen::Matrix<S, 4, 1>;
template <class S>
using Vector6 = Eigen::Matrix<S, 6, 1>;
template <class S>
using Vector7 = Eigen::Matrix<S, 7, 1>;
template <class S>
using VectorX = Eigen::Matrix<S, Eigen::Dynamic, 1>;
template <class S>
using Matrix3 = Eigen::Matrix<S, 3, 3>;
template <class S>
using Matrix6 = Eigen::Matrix<S, 6, 6>;
template <class S>
using MatrixX = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

/// Sets m to NaN in debug builds, so that the use of an unset value is visible. Release builds do nothing.
template <class Derived>
void mark_uninitialised([[maybe_unused]] Eigen::MatrixBase<Derived>& m) {
#ifndef NDEBUG
  m.setConstant(std::numeric_limits<typename Derived::Scalar>::quiet_NaN());
#endif
}

/// A matrix from its entries, row by row.
template <class S>
[[gnu::always_inline]] inline Matrix3<S> rows(const S& xx, const S& xy, const S& xz, const S& yx, const S& yy,
                                              const S& yz, const S& zx, const S& zy, const S& zz) {
  Matrix3<S> m;
  m(0, 0) = xx, m(1, 0) = yx, m(2, 0) = zx;
  m(0, 1) = xy, m(1, 1) = yy, m(2, 1) = zy;
  m(0, 2) = xz, m(1, 2) = yz, m(2, 2) = zz;
  return m;
}

/// (f(0), f(1), f(2)), entry by entry: a wide load right after narrow stores would stall.
template <class S, class F>
[[gnu::always_inline]] inline Vector3<S> each(F f) {
  return Vector3<S>(f(0), f(1), f(2));
}

/// [v]: the matrix with [v] w = v x w. Shape 3 x 3.
template <class S>
[[gnu::always_inline]] inline Matrix3<S> skew(const Vector3<S>& v) {
  return rows<S>(S(0), -v.z(), v.y(), v.z(), S(0), -v.x(), -v.y(), v.x(), S(0));
}

/// a . b. Error 1.5 eps |a||b|.
template <class S>
[[gnu::always_inline]] inline S dot(const Vector3<S>& a, const Vector3<S>& b) {
  return mul_add(a.x(), b.x(), mul_add(a.y(), b.y(), S(a.z() * b.z())));
}

/// |a_0| + |a_1| + |a_2|, an upper bound of |a|.
template <class S>
[[gnu::always_inline]] inline S norm1(const Vector3<S>& a) {
  return absolute<S>(a[0]) + absolute<S>(a[1]) + absolute<S>(a[2]);
}

/// M v and M^T v, entry by entry.
template <class S>
[[gnu::always_inline]] inline Vector3<S> product(const Matrix3<S>& M, const Vector3<S>& v) {
  return each<S>([&](int i) { return mul_add(M(i, 0), v[0], mul_add(M(i, 1), v[1], S(M(i, 2) * v[2]))); });
}
template <class S>
[[gnu::always_inline]] inline Vector3<S> transposed_product(const Matrix3<S>& M, const Vector3<S>& v) {
  return each<S>([&](int i) { return mul_add(M(0, i), v[0], mul_add(M(1, i), v[1], S(M(2, i) * v[2]))); });
}

/// A^T.
template <class S>
[[gnu::always_inline]] inline Matrix3<S> transposed(const Matrix3<S>& A) {
  return rows<S>(A(0, 0), A(1, 0), A(2, 0), A(0, 1), A(1, 1), A(2, 1), A(0, 2), A(1, 2), A(2, 2));
}

/// A B and A^T B, entry by entry.
template <class S>
[[gnu::always_inline]] inline Matrix3<S> product(const Matrix3<S>& A, const Matrix3<S>& B) {
  const auto entry = [&](int i, int j) __attribute__((always_inline)) {
    return mul_add(A(i, 0), B(0, j), mul_add(A(i, 1), B(1, j), S(A(i, 2) * B(2, j))));
  };
  return rows<S>(entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 0), entry(1, 1), entry(1, 2), entry(2, 0),
                 entry(2, 1), entry(2, 2));
}
template <class S>
[[gnu::always_inline]] inline Matrix3<S> transposed_product(const Matrix3<S>& A, const Matrix3<S>& B) {
  const auto entry = [&](int i, int j) __attribute__((always_inline)) {
    return mul_add(A(0, i), B(0, j), mul_add(A(1, i), B(1, j), S(A(2, i) * B(2, j))));
  };
  return rows<S>(entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 0), entry(1, 1), entry(1, 2), entry(2, 0),
                 entry(2, 1), entry(2, 2));
}

/// a x b. With FMA each component is a fused difference of products. Error 1.5 eps |a||b|.
template <class S>
[[gnu::always_inline]] inline Vector3<S> cross(const Vector3<S>& a, const Vector3<S>& b) {
  return Vector3<S>(mul_add(a[1], b[2], S(-(a[2] * b[1]))), mul_add(a[2], b[0], S(-(a[0] * b[2]))),
                    mul_add(a[0], b[1], S(-(a[1] * b[0]))));
}

/// v + a x b. Error 2 eps (|v| + |a||b|).
template <class S>
[[gnu::always_inline]] inline Vector3<S> add_cross(const Vector3<S>& v, const Vector3<S>& a,
                                                   const Vector3<S>& b) {
  const auto entry = [&](int i, int j, int k) __attribute__((always_inline)) {
    return mul_add(a[j], b[k], mul_add(S(-a[k]), b[j], v[i]));
  };
  return Vector3<S>(entry(0, 1, 2), entry(1, 2, 0), entry(2, 0, 1));
}

}  // namespace liecheck
