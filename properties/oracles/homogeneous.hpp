#pragma once
// Homogeneous matrices without their last row, which is 0 0 0 1 for a pose and zero for its derivatives.

#include <oracles/quaternion.hpp>

namespace liecheck::oracles {

template <class T>
using Mat34 = Mat<3, 4, T>;

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
template <class T>
Mat3<T> rotation_of(const Mat34<T>& X) {
  return {{X(0, 0), X(0, 1), X(0, 2), X(1, 0), X(1, 1), X(1, 2), X(2, 0), X(2, 1), X(2, 2)}};
}
template <class T>
Vec3<T> origin_of(const Mat34<T>& X) {
  return {{X(0, 3), X(1, 3), X(2, 3)}};
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
