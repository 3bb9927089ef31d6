#pragma once
// Representations of a rotation at 100 digits, each confirmed by a second formula. A quaternion stands for Q/|Q|.
//
//   value                                        second formula
//   Q0 Q1                                        the product of two matrices
//   Gibbs      v/w                               Cayley's (R - I)(R + I)^-1
//   from it    (g, 1)/|(g, 1)|                   Cayley's (I + [g])(I - [g])^-1
//   Rodrigues  v/(|Q| + w), w >= 0               tan(theta/4) n by oracles/log.hpp
//   from it    (2 s, 1 - |s|^2)/(1 + |s|^2)      exp of 4 atan(|s|) n by oracles/exp.hpp
//   Gram and Schmidt's columns                   A L^-T with Cholesky's L of A^T A
//
// Error: below 1e-41. In ball arithmetic, the radius bounds it. Source: Shuster 1993.

#include <oracles/ball_oracles.hpp>

namespace liecheck::oracles {

/// The unit quaternion of the rotation nearest to R.
Resolved<Quaternion<>> quaternion_from_matrix(const Mat3<>& R);
Resolved<Quaternion<>> unit_product(const Quaternion<>& Q0, const Quaternion<>& Q1);
Resolved<Vec3<>> gibbs(const Quaternion<>& Q);
Resolved<Quaternion<>> from_gibbs(const Vec3<>& g);
/// At w = 0 either sign is right; this is that of v.
Resolved<Vec3<>> modified_rodrigues(const Quaternion<>& Q);
Resolved<Quaternion<>> from_modified_rodrigues(const Vec3<>& s);
/// The rotation of the columns that Gram and Schmidt's process makes of those of A, in the order x, y, z.
Resolved<Quaternion<>> gram_schmidt(const Mat3<>& A);

namespace representation_formulas {

template <class T>
Vec3<T> divided(const Vec3<T>& v, const T& by) {
  return {{v[0] / by, v[1] / by, v[2] / by}};
}
template <class T>
Vec3<T> modified_rodrigues(const Quaternion<T>& Q) {
  const T n = norm(Q);
  return divided(head3(Q), Q[3] < T(0) ? T(Q[3] - n) : T(Q[3] + n));
}
template <class T>
Quaternion<T> from_modified_rodrigues(const Vec3<T>& s) {
  const T square = squared_norm(s);
  return normalized(Quaternion<T>{{T(2) * s[0], T(2) * s[1], T(2) * s[2], T(1) - square}});
}

}  // namespace representation_formulas

template <BallNumber T>
Resolved<Quaternion<T>> quaternion_from_matrix(const Mat3<T>& R) {
  return {nearest_quaternion(R), true};
}
template <BallNumber T>
Resolved<Quaternion<T>> unit_product(const Quaternion<T>& Q0, const Quaternion<T>& Q1) {
  return {normalized(quaternion_product(Q0, Q1)), true};
}
template <BallNumber T>
Resolved<Vec3<T>> gibbs(const Quaternion<T>& Q) {
  return {representation_formulas::divided(head3(Q), Q[3]), true};
}
template <BallNumber T>
Resolved<Quaternion<T>> from_gibbs(const Vec3<T>& g) {
  return {normalized(Quaternion<T>{{g[0], g[1], g[2], T(1)}}), true};
}
template <BallNumber T>
Resolved<Vec3<T>> modified_rodrigues(const Quaternion<T>& Q) {
  return {representation_formulas::modified_rodrigues(Q), true};
}
template <BallNumber T>
Resolved<Quaternion<T>> from_modified_rodrigues(const Vec3<T>& s) {
  return {representation_formulas::from_modified_rodrigues(s), true};
}

}  // namespace liecheck::oracles
