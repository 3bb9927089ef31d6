#pragma once
// Homogeneous matrices without their last row, which is 0 0 0 1 for a pose and zero for its derivatives.

#include <oracles/quaternion.hpp>

namespace liecheck::oracles {

template <class T>
using Mat34 = Mat<3, 4, T>;
template <class T>
using Mat44 = Mat<4, 4, T>;

namespace homogeneous {

/// A B, where the last row of B is (0, 0, 0, last).
template <class T>
Mat34<T> product(const Mat34<T>& A, const Mat34<T>& B, int last) {
  Mat34<T> r;
  T t;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) {
      set_product(r(i, j), A(i, 0), B(0, j));
      for (int k = 1; k < 3; ++k) {
        set_product(t, A(i, k), B(k, j));
        r(i, j) += t;
      }
      if (last && j == 3) r(i, j) += A(i, 3);
    }
  return r;
}
template <class T>
Mat34<T> matrix(const Mat3<T>& R, const Vec3<T>& p) {
  Mat34<T> X;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) X(i, j) = R(i, j);
    X(i, 3) = p[i];
  }
  return X;
}
/// The matrix [[w]x u] of a twist (u, w).
template <class T>
Mat34<T> generator(const Vec6<T>& s) {
  return matrix(hat(tail3(s)), head3(s));
}
/// Whether x is known to be zero.
template <class T>
bool is_zero(const T& x) {
  if constexpr (BallNumber<T>)
    return x.exactly_zero();
  else
    return x == 0;
}
/// X [s], where [s] is the matrix of a twist.
template <class T>
Mat34<T> times_generator(const Mat34<T>& X, const Vec6<T>& s) {
  const auto none = [&](int first) {
    return is_zero(s[first]) && is_zero(s[first + 1]) && is_zero(s[first + 2]);
  };
  const bool slides = !none(0), turns = !none(3);
  Mat34<T> r = zeros<3, 4, T>();
  for (int i = 0; i < 3; ++i) {
    const Vec3<T> row{{X(i, 0), X(i, 1), X(i, 2)}};
    if (slides) r(i, 3) = dot(row, head3(s));
    if (!turns) continue;
    const Vec3<T> turned = cross(row, tail3(s));
    for (int j = 0; j < 3; ++j) r(i, j) = turned[j];
  }
  return r;
}
template <class T>
Mat3<T> rotation_of(const Mat34<T>& X) {
  return {{X(0, 0), X(0, 1), X(0, 2), X(1, 0), X(1, 1), X(1, 2), X(2, 0), X(2, 1), X(2, 2)}};
}
template <class T>
Vec3<T> origin_of(const Mat34<T>& X) {
  return {{X(0, 3), X(1, 3), X(2, 3)}};
}
/// A J, where the last row of A is (0, 0, 0, last).
template <class T>
Mat44<T> times(const Mat34<T>& A, const Mat44<T>& J, int last) {
  Mat44<T> r = zeros<4, 4, T>();
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 3; ++i) {
      r(i, j) = A(i, 3) * J(3, j);
      for (int k = 0; k < 3; ++k) r(i, j) += A(i, k) * J(k, j);
    }
    if (last) r(3, j) = J(3, j);
  }
  return r;
}
/// v / ||v||, by division.
template <int N, class T>
Vec<N, T> unit(Vec<N, T> v) {
  const T n = norm(v);
  for (T& x : v.x) x /= n;
  return v;
}
template <class T>
Mat3<T> unit_rotation(const Quaternion<T>& Q) {
  return rotation_matrix(unit(Q));
}
/// The rotation about n by the angle of cosine c and sine s: c I + s [n] + (1 - c) n n^T.
template <class T>
Mat3<T> rotation_about(const Vec3<T>& n, const T& c, const T& s) {
  Mat3<T> R = s * hat(n);
  const T versine = T(1) - c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) R(i, j) += versine * n[i] * n[j] + (i == j ? c : T(0));
  return R;
}

}  // namespace homogeneous
}  // namespace liecheck::oracles
