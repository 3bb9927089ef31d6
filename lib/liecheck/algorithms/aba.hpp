#pragma once
// Forward dynamics by the articulated-body algorithm: Featherstone (2008), table 7.1. All quantities are in
// world axes at each joint's origin, so the transform to the parent is a translation by r.
//
//   U = I^A S, D = S^T U + armature, u = tau - S^T p^A
//   I^a = I^A - U D^-1 U^T,  I^A_p += X* I^a X^-1,  p^A_p += X* (p^A + I^a c + U D^-1 u),  c = v x S qd
//   qdd = D^-1 (u - U^T (X a_p + c)),      a = X a_p + c + S qdd
//
// Means of |error of qdd| / |qdd| over 40 states of each robot, against long double [1e-16]:
//
//                           solo12   humanoid   panda   double pendulum
//   world axes (this file)    7.6       8.0       4.1        3.1
//   joint axes                5.2       5.3       2.7        2.2
//
// The error comes in similar parts from the velocities, the articulated inertias, the forces and the last pass,
// and grows with the condition number of M. In joint axes the exact zeros and ones of S round nothing. They are
// not used all the same: a search for the worst trees (liecheck hunt) finds 8.3 kappa in the law tree_aba,
// whose limit is 8, and 1.5e5 kappa in float in rnea_of_aba. World axes stay within the limits.

#include <liecheck/algorithms/crba.hpp>
#include <liecheck/algorithms/rnea.hpp>

namespace liecheck {

namespace algorithms_detail {

/// Adds I^A = [A, B; B^T, D] to sum, with its reference point moved by -r: B' = B - A [r],
/// D' = D + [r] B' + ([r] B)^T.
template <Scalar S>
void addShifted(Matrix6<S>& sum, const Matrix6<S>& I, const Vector3<S>& r) {
  const Matrix3<S> A = I.template topLeftCorner<3, 3>(), B = I.template topRightCorner<3, 3>();
  Matrix3<S> moved, r_moved, r_B;
  for (int i = 0; i < 3; ++i) {  // column i of A [r], A symmetric
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    moved.col(i) = B.col(i) - (r[k] * A.col(j) - r[j] * A.col(k));
    r_moved.col(i) = cross<S>(r, moved.col(i));
    r_B.col(i) = cross<S>(r, B.col(i));
  }
  sum.template topLeftCorner<3, 3>() += A;
  sum.template topRightCorner<3, 3>() += moved;
  sum.template bottomLeftCorner<3, 3>() += moved.transpose();
  sum.template bottomRightCorner<3, 3>() += I.template bottomRightCorner<3, 3>() + r_moved + r_B.transpose();
}

/// s^T Ic s of a column s of joint i, Ic: inertia of all bodies that it carries. Overwrites work.gravitated.
template <Scalar S>
[[gnu::noinline]] S carriedInertia(const Model<S>& model, Data<S>& data, std::size_t i, const Vector6<S>& s) {
  auto& V = data.work.gravitated;
  S sum(0);
  for (std::size_t j = i; j < model.joints.size(); ++j) {
    const std::size_t p = std::size_t(model.parents[j]);
    V[j] = j == i ? Motion<S>(s) : p < i ? Motion<S>::Zero() : shifted(V[p], data.work.r[j]);
    const Motion<S> own = SE3<S>(data.oMi[j].rotation(), Vector3<S>::Zero()).actInv(V[j]);
    sum += own.dot(model.inertias[j] * own);
  }
  return sum;
}

/// Whether the pivot of D_kk is above its rounding error, eps (64 s^T Ic s + 4 |s|^2 B), s the column of joint i:
/// B = trace + sum m l^2 bounds the inertias that I^A is summed from (InertiaBound). I^A itself is no measure of
/// this error: the joints behind may have left nothing but rounding errors of it. Of 180,000 singular states the
/// largest pivot was .9 of this error, with distances in place of l. s^T Ic s is at most 2 |s|^2 B, so a pivot
/// above 256 eps |s|^2 B passes whatever Ic is, as most do.
template <Scalar S>
bool aboveRounding(const Model<S>& model, Data<S>& data, std::size_t i, const S& pivot, const Vector6<S>& s) {
  const auto& carried = data.work.carried[i];  // numbers, because squaredNorm takes 3 % of aba's time
  const S t = s[0] * s[0] + s[1] * s[1] + s[2] * s[2], w = s[3] * s[3] + s[4] * s[4] + s[5] * s[5];
  const S all = t * carried.mass + w * S(carried.trace + carried.square);
  return pivot > S(256) * eps<S>() * all ||
         pivot > eps<S>() * S(S(64) * carriedInertia(model, data, i, s) + S(4) * all);
}

/// Replaces D [n x n] of joint i by its Cholesky factor, D = L L^T, or by 1 / D if n = 1. Throws
/// SingularInertia unless each pivot is above the rounding error of D_kk.
template <Scalar S>
void factorizeJointInertia(const Model<S>& model, Data<S>& data, std::size_t i, int n) {
  using std::sqrt;
  Matrix6<S>& L = data.work.D_factor[i];
  for (int k = 0; k < n; ++k) {
    if (!aboveRounding<S>(model, data, i, L(k, k), data.work.S_columns.col(model.idx_columns[i] + k)))
      throw SingularInertia(model.names[i], int(i), finite<S>(L(k, k)));
    if (n == 1) return void(L(0, 0) = S(1) / L(0, 0));
    L(k, k) = sqrt(L(k, k));
    for (int l = k + 1; l < n; ++l) L(l, k) /= L(k, k);
    for (int l = k + 1; l < n; ++l)
      for (int j = k + 1; j <= l; ++j) L(l, j) -= L(l, k) * L(j, k);
  }
}

/// Sets U = I^A S, D = S^T U + armature and u = tau - S^T p^A of joint i, and factorizes D. With more than one
/// column, U and u then become U L^-T and L^-1 u: D^-1 itself is less accurate if D is ill-conditioned.
template <Scalar S>
void projectOnJoint(const Model<S>& model, Data<S>& data, std::size_t i, const VectorX<S>& tau) {
  auto& w = data.work;
  const int n = model.column_counts[i], first = model.idx_columns[i], first_v = model.idx_vs[i];
  const Matrix6<S>& I = w.articulated[i];
  Matrix6<S>& L = w.D_factor[i];
  for (int k = 0; k < n; ++k) {
    const Vector6<S> s = w.S_columns.col(first + k);
    Vector6<S> U;
    if (rotatesAboutAxis<S>(model.joints[i])) {  // s = (0, axis)
      U.noalias() = I.template rightCols<3>() * s.template tail<3>();
      L(0, 0) = s.template tail<3>().dot(U.template tail<3>());
    } else {
      U.noalias() = I * s;
      for (int j = 0; j <= k; ++j) L(k, j) = w.S_columns.col(first + j).dot(U);
    }
    w.U.col(first + k) = U;
    L(k, k) += model.armature[first_v + k];
    w.u[first + k] = tau[first_v + k] - s.dot(w.force[i].to_vector());
  }
  factorizeJointInertia(model, data, i, n);
  if (n == 1) return;
  for (int k = 0; k < n; ++k) {
    auto U_k = w.U.col(first + k);
    S& u_k = w.u[first + k];
    for (int j = 0; j < k; ++j) U_k -= L(k, j) * w.U.col(first + j), u_k -= L(k, j) * w.u[first + j];
    U_k /= L(k, k), u_k /= L(k, k);
  }
}

/// aba of a model with mimic joints. They couple branches, so M qdd = tau - h is solved with the factor of M.
template <Scalar S>
const VectorX<S>& denseForwardDynamics(const Model<S>& model, Data<S>& data, In<S> q, In<S> v, In<S> tau,
                                       External<S> fext) {
  data.require(Dense::Mass, "aba of a model with mimics");
  data.begin(model, q, v);
  VectorX<S>& ddq = data.ddq.scratch();
  inverseDynamics<S>(model, data, q, v, nullptr, fext, ddq);
  ddq = tau - ddq;
  crba(model, data, q);
  factorize(model, data);
  solve(model, data, ddq);
  return data.ddq.write(Level::Velocity);
}

/// Computes the twists work.velocity of the joints, in the world's axes at each joint's origin, after
/// columnsInWorldAxes.
template <Scalar S>
void velocitiesInWorldAxes(const Model<S>& model, Data<S>& data, In<S> v) {
  auto& w = data.work;
  for (std::size_t i = 1; i < model.joints.size(); ++i) {
    const std::size_t p = std::size_t(model.parents[i]);
    Motion<S> relative = Motion<S>::Zero();
    for (int k = 0; k < model.column_counts[i]; ++k)
      relative = relative + column(w.S_columns, model.idx_columns[i] + k) * v[model.idx_vs[i] + k];
    w.velocity[i] = p == 0 ? relative : shifted(w.velocity[p], w.r[i]) + relative;
    w.bias[i] = crossed(w.velocity[i], relative);
  }
}

/// Computes poses, columns and twists in world axes. Updates liMi, oMi.
template <Scalar S>
void bodiesInWorldAxes(const Model<S>& model, Data<S>& data, In<S> q, In<S> v) {
  data.begin(model, q, v);
  columnsInWorldAxes(model, data, q);
  velocitiesInWorldAxes(model, data, v);
}

/// Computes ddq of aba, for a model without mimics, after bodiesInWorldAxes. The forces fext on the bodies, at their
/// joints' origins, are in the joints' axes, or in the world's.
template <Scalar S>
void articulatedBodies(const Model<S>& model, Data<S>& data, In<S> tau, const External<S>& fext,
                       bool fext_in_world) {
  auto& w = data.work;
  for (std::size_t i = 1; i < model.joints.size(); ++i) {
    const Matrix3<S>& R = data.oMi[i].rotation();
    const auto body = CompositeInertia<S>::rotated(R, model.inertias[i]);
    const MovingInertia<S> moving(body, w.velocity[i]);
    multibody_detail::build(
        w.articulated[i], [&]() __attribute__((always_inline)) { return moving.matrix(); });
    w.carried[i] = InertiaBound<S>(body);
    w.force[i] = crossed(w.velocity[i], Force<S>(moving.f, moving.n));
    if (!fext.empty())
      w.force[i] = w.force[i] - (fext_in_world ? fext[i] : SE3<S>(R, Vector3<S>::Zero()).act(fext[i]));
  }
  VectorX<S>& ddq = data.ddq.scratch();

  for (std::size_t i = model.joints.size() - 1; i > 0; --i) {
    const std::size_t p = std::size_t(model.parents[i]);
    projectOnJoint(model, data, i, tau);
    if (p == 0) continue;
    const int n = model.column_counts[i], first = model.idx_columns[i];
    Matrix6<S>& I = w.articulated[i];
    Vector6<S> f = Vector6<S>::Zero();
    for (int k = 0; k < n; ++k) {
      const Vector6<S> U = w.U.col(first + k), UD = n == 1 ? Vector6<S>(w.D_factor[i](0, 0) * U) : U;
      I.noalias() -= UD * U.transpose();
      f += UD * w.u[first + k];
    }
    w.force[p] =
        w.force[p] + shifted(w.force[i] + Force<S>(Vector6<S>(I * w.bias[i].to_vector() + f)), w.r[i]);
    addShifted(w.articulated[p], I, w.r[i]);
    w.carried[p].join(w.carried[i], w.r[i]);
  }

  w.gravitated[0] = Motion<S>(Vector3<S>(-model.gravity), Vector3<S>::Zero());
  for (std::size_t i = 1; i < model.joints.size(); ++i) {
    const int n = model.column_counts[i], first = model.idx_columns[i], first_v = model.idx_vs[i];
    const Matrix6<S>& L = w.D_factor[i];
    Vector6<S> a = (shifted(w.gravitated[std::size_t(model.parents[i])], w.r[i]) + w.bias[i]).to_vector();
    for (int k = 0; k < n; ++k) ddq[first_v + k] = w.u[first + k] - w.U.col(first + k).dot(a);
    if (n == 1)
      ddq[first_v] *= L(0, 0);
    else  // solves L^T qdd = u - U^T a
      for (int k = n - 1; k >= 0; --k) {
        for (int j = k + 1; j < n; ++j) ddq[first_v + k] -= L(j, k) * ddq[first_v + j];
        ddq[first_v + k] /= L(k, k);
      }
    for (int k = 0; k < n; ++k) a += w.S_columns.col(first + k) * ddq[first_v + k];
    w.gravitated[i] = Motion<S>(a);
  }
}

}  // namespace algorithms_detail

/// qdd [nv; m/s^2, rad/s^2] = M(q)^-1 (tau - h(q, v) + sum J^T fext), tau [nv; N, N m]. Throws
/// SingularInertia. Updates liMi, oMi, ddq (with mimics also v, M).
template <Scalar S>
const VectorX<S>& aba(const Model<S>& model, Data<S>& data, In<S> q, In<S> v, In<S> tau,
                      External<S> fext = {}) {
  using namespace algorithms_detail;
  multibody_detail::checkSize(tau.size(), model.nv, "tau", "nv");
  checkForces<S>(model, fext);
  if (model.has_mimics) return denseForwardDynamics(model, data, q, v, tau, fext);
  bodiesInWorldAxes(model, data, q, v);
  articulatedBodies(model, data, tau, fext, false);
  return data.ddq.write(Level::Velocity);
}

// instantiations_*.cpp instantiates these for float and double.
extern template decltype(aba<float>) aba<float>;
extern template decltype(aba<double>) aba<double>;

}  // namespace liecheck
