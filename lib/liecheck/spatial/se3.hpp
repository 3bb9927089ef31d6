#pragma once
// SE(3): a pose X_AB = (R_AB, p_AB_A): x_A = R_AB x_B + p_AB.
//
//   motions   V_A = X V_B          u_A = R u_B + p x (R omega_B),   omega_A = R omega_B
//   forces    F_A = X^-T F_B       f_A = R f_B,                     n_A = R n_B + p x (R f_B)
//   inertias  I_A = X^-T I_B X^-1  m,  c_A = R c_B + p,             I_C,A = R I_C,B R^T
//
// The cross term is in the linear part of motions and in the moment of forces, so F^T V is invariant.

#include <liecheck/spatial/force.hpp>
#include <liecheck/spatial/inertia.hpp>
#include <liecheck/spatial/motion.hpp>
#include <liecheck/spatial/so3.hpp>

namespace liecheck {

template <Scalar S>
class SE3 {
 public:
  /// Uninitialised: NaN in debug.
  SE3() {
    mark_uninitialised(R_);
    mark_uninitialised(p_);
  }
  /// R_AB [3 x 3], p_AB_A [3, m].
  SE3(const Matrix3<S>& R_AB, const Vector3<S>& p_AB) : R_(R_AB), p_(p_AB) {}
  SE3(const SO3<S>& Q_AB, const Vector3<S>& p_AB) : R_(Q_AB.matrix()), p_(p_AB) {}

  static SE3 Identity() { return SE3(Matrix3<S>(Matrix3<S>::Identity()), Vector3<S>::Zero()); }

  const Matrix3<S>& rotation() const { return R_; }
  const Vector3<S>& translation() const { return p_; }

  // The operations below are inlined. A call would write the result number by number, and copying it in wide
  // registers right after that would stall (failed store forwarding).

  /// X_AC = X_AB X_BC.
  [[gnu::always_inline]] SE3 operator*(const SE3& o) const { return SE3(product<S>(R_, o.R_), act(o.p_)); }
  [[gnu::always_inline]] SE3 inverse() const {
    return SE3(transposed<S>(R_), transposed_product<S>(R_, each<S>([this](int i) { return -p_[i]; })));
  }
  /// X_AB^-1 X_AC = (R_AB^T R_AC, R_AB^T (p_AC - p_AB)).
  [[gnu::always_inline]] SE3 actInv(const SE3& o) const {
    return SE3(transposed_product<S>(R_, o.R_), actInv(o.p_));
  }

  /// x_A = R x_B + p.
  [[gnu::always_inline]] Vector3<S> act(const Vector3<S>& x_B) const {
    const Vector3<S> x = product<S>(R_, x_B);
    return each<S>([&](int i) { return x[i] + p_[i]; });
  }
  [[gnu::always_inline]] Vector3<S> actInv(const Vector3<S>& x_A) const {
    return transposed_product<S>(R_, each<S>([&](int i) { return x_A[i] - p_[i]; }));
  }

  [[gnu::always_inline]] Motion<S> act(const Motion<S>& V_B) const {
    const Vector3<S> omega = product<S>(R_, V_B.angular());
    return joined<Motion<S>>(add_cross<S>(product<S>(R_, V_B.linear()), p_, omega), omega);
  }
  [[gnu::always_inline]] Motion<S> actInv(const Motion<S>& V_A) const {
    return joined<Motion<S>>(transposed_product<S>(R_, add_cross<S>(V_A.linear(), V_A.angular(), p_)),
                             transposed_product<S>(R_, V_A.angular()));
  }
  [[gnu::always_inline]] Force<S> act(const Force<S>& F_B) const {
    const Vector3<S> f = product<S>(R_, F_B.linear());
    return joined<Force<S>>(f, add_cross<S>(product<S>(R_, F_B.angular()), p_, f));
  }
  [[gnu::always_inline]] Force<S> actInv(const Force<S>& F_A) const {
    return joined<Force<S>>(transposed_product<S>(R_, F_A.linear()),
                            transposed_product<S>(R_, add_cross<S>(F_A.angular(), F_A.linear(), p_)));
  }
  [[gnu::always_inline]] Inertia<S> act(const Inertia<S>& I_B) const {
    return Inertia<S>(I_B.mass(), act(I_B.lever()), Symmetric3<S>::rotated(R_, I_B.inertia()).matrix());
  }
  [[gnu::always_inline]] Inertia<S> actInv(const Inertia<S>& I_A) const {
    return Inertia<S>(I_A.mass(), actInv(I_A.lever()),
                      Symmetric3<S>::rotated(transposed<S>(R_), I_A.inertia()).matrix());
  }

  /// X, 6 x 6, with V_A = X V_B: [R, [p] R; 0, R].
  [[gnu::always_inline]] Matrix6<S> toActionMatrix() const {
    Matrix6<S> X;
    diagonal(X), X.template bottomLeftCorner<3, 3>().setZero();
    for (int j = 0; j < 3; ++j) put(X, 0, 3 + j, cross<S>(p_, Vector3<S>(R_(0, j), R_(1, j), R_(2, j))));
    return X;
  }
  /// X^-T, 6 x 6, with F_A = X^-T F_B: [R, 0; [p] R, R].
  [[gnu::always_inline]] Matrix6<S> toDualActionMatrix() const {
    Matrix6<S> X;
    diagonal(X), X.template topRightCorner<3, 3>().setZero();
    for (int j = 0; j < 3; ++j) put(X, 3, j, cross<S>(p_, Vector3<S>(R_(0, j), R_(1, j), R_(2, j))));
    return X;
  }

  template <Scalar T>
  SE3<T> cast() const {
    return SE3<T>(Matrix3<T>(R_.template cast<T>()), Vector3<T>(p_.template cast<T>()));
  }

 private:
  /// R to the diagonal blocks, as copies.
  [[gnu::always_inline]] void diagonal(Matrix6<S>& X) const {
    X.template topLeftCorner<3, 3>() = R_, X.template bottomRightCorner<3, 3>() = R_;
  }
  [[gnu::always_inline]] static void put(Matrix6<S>& X, int i, int j, const Vector3<S>& l) {
    X(i, j) = l[0], X(i + 1, j) = l[1], X(i + 2, j) = l[2];
  }
  template <class V>
  [[gnu::always_inline]] static V joined(const Vector3<S>& linear, const Vector3<S>& angular) {
    return V(linear[0], linear[1], linear[2], angular[0], angular[1], angular[2]);
  }

  Matrix3<S> R_;
  Vector3<S> p_;
};

}  // namespace liecheck
