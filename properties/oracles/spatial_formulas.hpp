#pragma once
// The formulas of spatial.hpp component by component, for any number type of the oracles.

#include <oracles/quaternion.hpp>

namespace liecheck::oracles {

template <class T>
struct PoseOf {
  Mat3<T> R;
  Vec3<T> p;
};
using Pose = PoseOf<Real>;

/// A rigid body's mass, centre of mass and inertia about the centre of mass.
template <class T>
struct BodyOf {
  T mass;
  Vec3<T> c;
  Mat3<T> I_C;
};
using Body = BodyOf<Real>;

/// The symmetric matrix of xx, xy, yy, xz, yz, zz.
template <class T>
Mat3<T> symmetric(const Vec6<T>& u) {
  return {{u[0], u[1], u[3], u[1], u[2], u[4], u[3], u[4], u[5]}};
}

namespace formulas {

template <class T>
Vec6<T> act_motion(const PoseOf<T>& X, const Vec6<T>& V) {
  const Vec3<T> w = X.R * tail3(V);
  return stack(X.R * head3(V) + cross(X.p, w), w);
}
template <class T>
Vec6<T> act_inverse_motion(const PoseOf<T>& X, const Vec6<T>& V) {
  const Mat3<T> Rt = transpose(X.R);
  return stack(Rt * (head3(V) - cross(X.p, tail3(V))), Rt * tail3(V));
}
template <class T>
Vec6<T> act_force(const PoseOf<T>& X, const Vec6<T>& F) {
  const Vec3<T> f = X.R * head3(F);
  return stack(f, X.R * tail3(F) + cross(X.p, f));
}
template <class T>
Vec6<T> act_inverse_force(const PoseOf<T>& X, const Vec6<T>& F) {
  const Mat3<T> Rt = transpose(X.R);
  return stack(Rt * head3(F), Rt * (tail3(F) - cross(X.p, head3(F))));
}
template <class T>
Vec6<T> cross_motion(const Vec6<T>& V, const Vec6<T>& W) {
  const Vec3<T> u = head3(V), w = tail3(V);
  return stack(cross(w, head3(W)) + cross(u, tail3(W)), cross(w, tail3(W)));
}
template <class T>
Vec6<T> cross_force(const Vec6<T>& V, const Vec6<T>& F) {
  const Vec3<T> u = head3(V), w = tail3(V);
  return stack(cross(w, head3(F)), cross(w, tail3(F)) + cross(u, head3(F)));
}
template <class T>
BodyOf<T> act_inertia(const PoseOf<T>& X, const BodyOf<T>& I) {
  return {I.mass, X.R * I.c + X.p, X.R * I.I_C * transpose(X.R)};
}
template <class T>
BodyOf<T> act_inverse_inertia(const PoseOf<T>& X, const BodyOf<T>& I) {
  const Mat3<T> Rt = transpose(X.R);
  return {I.mass, Rt * (I.c - X.p), Rt * I.I_C * X.R};
}
/// [c]^2 = -(||c||^2 I - c c^T)
template <class T>
Mat6<T> inertia_matrix(const BodyOf<T>& I) {
  const Mat3<T> C = hat(I.c);
  return assemble(I.mass * identity<3, T>(), T(-I.mass) * C, I.mass * C, I.I_C - I.mass * (C * C));
}
template <class T>
Vec6<T> momentum(const BodyOf<T>& I, const Vec6<T>& V) {
  const Vec3<T> linear = I.mass * (head3(V) + cross(tail3(V), I.c));
  return stack(linear, I.I_C * tail3(V) + cross(I.c, linear));
}
template <class T>
T kinetic_energy(const BodyOf<T>& I, const Vec6<T>& V) {
  const Vec3<T> w = tail3(V);
  return (I.mass * squared_norm(head3(V) + cross(w, I.c)) + dot(w, I.I_C * w)) / 2;
}
template <class T>
T power(const Vec6<T>& F, const Vec6<T>& V) {
  T sum(0);
  for (int i = 0; i < 6; ++i) sum += F[i] * V[i];
  return sum;
}

}  // namespace formulas
}  // namespace liecheck::oracles
