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

  /// X_AC = X_AB X_BC.
  SE3 operator*(const SE3& o) const { return SE3(product<S>(R_, o.R_), act(o.p_)); }
  SE3 inverse() const {
    return SE3(
        rows<S>(R_(0, 0), R_(1, 0), R_(2, 0), R_(0, 1), R_(1, 1), R_(2, 1), R_(0, 2), R_(1, 2), R_(2, 2)),
        transposed_product<S>(R_, each<S>([this](int i) { return -p_[i]; })));
  }
  /// X_AB^-1 X_AC = (R_AB^T R_AC, R_AB^T (p_AC - p_AB)).
  SE3 actInv(const SE3& o) const {
    return SE3(Matrix3<S>(R_.transpose() * o.R_), Vector3<S>(R_.transpose() * (o.p_ - p_)));
  }

  /// x_A = R x_B + p.
  [[gnu::always_inline]] Vector3<S> act(const Vector3<S>& x_B) const {
    const Vector3<S> x = product<S>(R_, x_B);
    return each<S>([&](int i) { return x[i] + p_[i]; });
  }
  Vector3<S> actInv(const Vector3<S>& x_A) const { return R_.transpose() * (x_A - p_); }

  Motion<S> act(const Motion<S>& V_B) const {
    const Vector3<S> omega = product<S>(R_, V_B.angular()), u = product<S>(R_, V_B.linear());
    const auto linear = [&](int i, int j, int k) __attribute__((always_inline)) {
      return mul_add(p_[j], omega[k], mul_add(S(-p_[k]), omega[j], u[i]));
    };
    return {Vector3<S>(linear(0, 1, 2), linear(1, 2, 0), linear(2, 0, 1)), omega};
  }
  Motion<S> actInv(const Motion<S>& V_A) const {
    const Vector3<S> u = V_A.linear() - cross<S>(p_, V_A.angular());
    return {Vector3<S>(R_.transpose() * u), Vector3<S>(R_.transpose() * V_A.angular())};
  }
  Force<S> act(const Force<S>& F_B) const {
    const Vector3<S> f = R_ * F_B.linear();
    return {f, Vector3<S>(R_ * F_B.angular()) + cross<S>(p_, f)};
  }
  Force<S> actInv(const Force<S>& F_A) const {
    const Vector3<S> n = F_A.angular() - cross<S>(p_, F_A.linear());
    return {Vector3<S>(R_.transpose() * F_A.linear()), Vector3<S>(R_.transpose() * n)};
  }
  Inertia<S> act(const Inertia<S>& I_B) const {
    return Inertia<S>(I_B.mass(), act(I_B.lever()), congruence(R_, I_B.inertia()));
  }
  Inertia<S> actInv(const Inertia<S>& I_A) const {
    return Inertia<S>(I_A.mass(), actInv(I_A.lever()), congruence(R_.transpose(), I_A.inertia()));
  }

  /// X, 6 x 6, with V_A = X V_B: [R, [p] R; 0, R].
  [[gnu::always_inline]] Matrix6<S> toActionMatrix() const {
    Matrix6<S> X;
    column(X, 0, 3, 0), column(X, 0, 3, 1), column(X, 0, 3, 2);
    return X;
  }
  /// X^-T, 6 x 6, with F_A = X^-T F_B: [R, 0; [p] R, R].
  [[gnu::always_inline]] Matrix6<S> toDualActionMatrix() const {
    Matrix6<S> X;
    column(X, 3, 0, 0), column(X, 3, 0, 1), column(X, 3, 0, 2);
    return X;
  }

  template <Scalar T>
  SE3<T> cast() const {
    return SE3<T>(Matrix3<T>(R_.template cast<T>()), Vector3<T>(p_.template cast<T>()));
  }

 private:
  /// Writes columns j and 3 + j of X: R to the diagonal blocks, [p] R to (row, column), 0 to the fourth.
  [[gnu::always_inline]] void column(Matrix6<S>& X, int row, int column, int j) const {
    const S &x = R_(0, j), &y = R_(1, j), &z = R_(2, j);
    const Vector3<S> l = cross<S>(p_, Vector3<S>(x, y, z));
    X(0, j) = X(3, 3 + j) = x, X(1, j) = X(4, 3 + j) = y, X(2, j) = X(5, 3 + j) = z;
    X(row, column + j) = l[0], X(row + 1, column + j) = l[1], X(row + 2, column + j) = l[2];
    X(column, row + j) = X(column + 1, row + j) = X(column + 2, row + j) = S(0);
  }
  /// R I R^T, symmetric to the last bit.
  static Matrix3<S> congruence(const Matrix3<S>& R, const Matrix3<S>& I) {
    const Matrix3<S> RI = R * I;
    Matrix3<S> result;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) result(i, j) = result(j, i) = RI.row(i).dot(R.row(j));
    return result;
  }

  Matrix3<S> R_;
  Vector3<S> p_;
};

}  // namespace liecheck
