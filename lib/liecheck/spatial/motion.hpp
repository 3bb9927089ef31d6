#pragma once
// Motion: a spatial velocity V_AB_E = (u, omega), linear part first, at a reference point, in a frame's axes
// [m/s, rad/s]. The same class holds a twist increment [m, rad].

#include <liecheck/spatial/types.hpp>

namespace liecheck {

/// The two parts of a Motion or a Force V, and its operations as a vector of 6 numbers.
template <class V, Scalar S>
class SpatialVector {
 public:
  /// Uninitialised: NaN in debug.
  SpatialVector() {
    mark_uninitialised(linear_);
    mark_uninitialised(angular_);
  }
  SpatialVector(const Vector3<S>& linear, const Vector3<S>& angular) : linear_(linear), angular_(angular) {}
  /// From numbers that were just computed; copying vectors of them would stall (see each).
  [[gnu::always_inline]] SpatialVector(const S& x, const S& y, const S& z, const S& omega_x, const S& omega_y,
                                       const S& omega_z)
      : linear_(x, y, z), angular_(omega_x, omega_y, omega_z) {}
  explicit SpatialVector(const Vector6<S>& v)
      : linear_(v.template head<3>()), angular_(v.template tail<3>()) {}

  static V Zero() { return V(Vector3<S>::Zero(), Vector3<S>::Zero()); }

  const Vector3<S>& linear() const { return linear_; }
  const Vector3<S>& angular() const { return angular_; }
  /// (linear, angular), shape 6.
  [[gnu::always_inline]] Vector6<S> to_vector() const {
    Vector6<S> v;
    for (int i = 0; i < 3; ++i) v[i] = linear_[i], v[3 + i] = angular_[i];
    return v;
  }

  V operator+(const V& o) const { return {linear_ + o.linear(), angular_ + o.angular()}; }
  V operator-(const V& o) const { return {linear_ - o.linear(), angular_ - o.angular()}; }
  V operator-() const { return {-linear_, -angular_}; }
  V operator*(const S& s) const { return {linear_ * s, angular_ * s}; }

 private:
  Vector3<S> linear_, angular_;
};

template <Scalar S>
class Force;

template <Scalar S>
class Motion : public SpatialVector<Motion<S>, S> {
  using Base = SpatialVector<Motion<S>, S>;

 public:
  using Base::Base, Base::linear, Base::angular;

  /// ad_V W = (omega_V x u_W + u_V x omega_W, omega_V x omega_W). Featherstone (2008), eq. 2.31.
  [[gnu::always_inline]] Motion cross(const Motion& W) const {
    const Vector3<S> a = liecheck::cross<S>(angular(), W.linear()),
                     b = liecheck::cross<S>(linear(), W.angular()),
                     c = liecheck::cross<S>(angular(), W.angular());
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2], c[0], c[1], c[2]};
  }
  /// ad_V* F = -ad_V^T F = (omega x f, omega x n + u x f). Featherstone (2008), eq. 2.32.
  Force<S> cross(const Force<S>& F) const;

  /// ad_V, 6 x 6, with ad_V W = cross(W): [[omega], [u]; 0, [omega]]. The entries are those of u [m/s] and omega
  /// [rad/s], exactly, and their negatives; V and W are in the same axes with the same reference point.
  Matrix6<S> toActionMatrix() const { return blocks(0, 3); }
  /// ad_V* = -ad_V^T, 6 x 6, with ad_V* F = cross(F): [[omega], 0; [u], [omega]], exactly.
  Matrix6<S> toDualActionMatrix() const { return blocks(3, 0); }

  /// Power F^T V [W]: the same in every frame.
  S dot(const Force<S>& F) const;

 private:
  /// [omega] in both diagonal blocks, [u] in the block at (row, column).
  [[gnu::always_inline]] Matrix6<S> blocks(int row, int column) const {
    Matrix6<S> ad = Matrix6<S>::Zero();
    const auto put = [&ad](int i, int j, const Vector3<S>& v) __attribute__((always_inline)) {
      ad(i, j + 1) = -v[2], ad(i, j + 2) = v[1], ad(i + 1, j) = v[2];
      ad(i + 1, j + 2) = -v[0], ad(i + 2, j) = -v[1], ad(i + 2, j + 1) = v[0];
    };
    put(0, 0, angular()), put(3, 3, angular()), put(row, column, linear());
    return ad;
  }
};

}  // namespace liecheck
