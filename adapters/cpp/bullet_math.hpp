#pragma once
// Poses of Bullet's LinearMath and of tf2, whose LinearMath is an older copy of it: the same functions with
// other names. Matrices have rows; quaternions are x, y, z, w.

#include "numbers.hpp"

template <class Library>
struct BulletMath {
  using S = typename Library::Scalar;
  using Vector = typename Library::Vector;
  using Quaternion = typename Library::Quaternion;
  using Matrix = typename Library::Matrix;
  using Transform = typename Library::Transform;

  static Vector vector(const S* x) { return {x[0], x[1], x[2]}; }
  static Quaternion quaternion(const S* Q) { return {Q[0], Q[1], Q[2], Q[3]}; }
  static Matrix matrix(const S* R) { return {R[0], R[1], R[2], R[3], R[4], R[5], R[6], R[7], R[8]}; }
  static Transform pose(const S* X) { return Transform(matrix(X), vector(X + 9)); }
  static void put(const Vector& x, S* to) {
    for (int i = 0; i < 3; ++i) to[i] = x[i];
  }
  static void put(const Quaternion& Q, S* to) { to[0] = Q.x(), to[1] = Q.y(), to[2] = Q.z(), to[3] = Q.w(); }
  static void put(const Matrix& R, S* to) {
    for (int i = 0; i < 3; ++i) put(R[i], to + 3 * i);
  }
  static void put(const Transform& X, S* to) { put(X.getBasis(), to), put(X.getOrigin(), to + 9); }

  /// setRotation divides by the axis's length.
  static Quaternion exp(In<S, 3> phi) { return Quaternion(vector(axis_of<S>(phi).data()), angle_of<S>(phi)); }

  static void exp3_quaternion(In<S, 3> phi, Out<S, 4> Q) { put(exp(phi), &Q[0]); }
  static void exp3_matrix(In<S, 3> phi, Out<S, 9> R) { put(Matrix(exp(phi)), &R[0]); }
  static void compose(In<S, 24> x, Out<S, 12> y) { put(pose(&x[0]) * pose(&x[12]), &y[0]); }
  static void inverse(In<S, 12> x, Out<S, 12> y) { put(pose(&x[0]).inverse(), &y[0]); }
  static void act_point(In<S, 15> x, Out<S, 3> y) { put(pose(&x[0]) * vector(&x[12]), &y[0]); }
  static void rotate_point(In<S, 7> x, Out<S, 3> y) {
    put(quatRotate(quaternion(&x[0]), vector(&x[4])), &y[0]);
  }
  static void normalize(In<S, 4> Q, Out<S, 4> y) { put(quaternion(&Q[0]).normalize(), &y[0]); }

  static void relative_angle(In<S, 8> x, Out<S, 1> y) {
    y[0] = quaternion(&x[0]).angleShortestPath(quaternion(&x[4]));
  }
  static void slerp(In<S, 9> x, Out<S, 4> y) { put(quaternion(&x[0]).slerp(quaternion(&x[4]), x[8]), &y[0]); }
  static void rotation_between(In<S, 6> x, Out<S, 4> y) {
    put(shortestArcQuat(vector(&x[0]), vector(&x[3])), &y[0]);
  }
  static void quaternion_from_matrix(In<S, 9> R, Out<S, 4> Q) {
    Quaternion q;
    matrix(&R[0]).getRotation(q);
    put(q, &Q[0]);
  }
  static void matrix_from_quaternion(In<S, 4> Q, Out<S, 9> R) { put(Matrix(quaternion(&Q[0])), &R[0]); }
  static void quaternion_product(In<S, 8> x, Out<S, 4> y) {
    put(quaternion(&x[0]) * quaternion(&x[4]), &y[0]);
  }
  static void quaternion_inverse(In<S, 4> Q, Out<S, 4> y) { put(quaternion(&Q[0]).inverse(), &y[0]); }
  static void axis_angle_from_quaternion(In<S, 4> Q, Out<S, 4> y) {
    const Quaternion q = quaternion(&Q[0]);
    put(q.getAxis(), &y[0]);
    y[3] = q.getAngle();
  }
  static void quaternion_from_axis_angle(In<S, 4> x, Out<S, 4> y) {
    put(Quaternion(vector(&x[0]), x[3]), &y[0]);
  }
  static void angle_between(In<S, 6> x, Out<S, 1> y) { y[0] = vector(&x[0]).angle(vector(&x[3])); }
  static void euler_to_quaternion(In<S, 4> x, Out<S, 4> y) {
    const auto [roll, pitch, yaw] = roll_pitch_yaw<S>(x);
    put(Library::quaternion_of(roll, pitch, yaw), &y[0]);
  }
  static void euler_to_matrix(In<S, 4> x, Out<S, 9> y) {
    const auto [roll, pitch, yaw] = roll_pitch_yaw<S>(x);
    put(Library::matrix_of(roll, pitch, yaw), &y[0]);
  }
  static void euler_from_matrix(In<S, 10> x, Out<S, 3> y) {
    S roll, pitch, yaw;
    Library::angles_of(matrix(&x[1]), roll, pitch, yaw);
    put_roll_pitch_yaw<S>(x[0], roll, pitch, yaw, y);
  }
};
