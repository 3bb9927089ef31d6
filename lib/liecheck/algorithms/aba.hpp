#pragma once
// Forward dynamics by the articulated-body algorithm: Featherstone (2008), table 7.1.
//
//   U = I^A S, D = S^T U + armature, u = tau - S^T p^A
//   I^a = I^A - U D^-1 U^T,  I^A_p += X* I^a X^-1,  p^A_p += X* (p^A + I^a c + U D^-1 u),  c = v x S qd
//   qdd = D^-1 (u - U^T (X^-1 a_p + c)),   a = X^-1 a_p + c + S qdd,   X = liM_i
//
// All quantities of a joint are in its own axes at its origin. In most robots the axes of the joints are
// coordinate axes, so that S and the inertias of the bodies contain exact zeros and ones. In world axes, as
// in crba, they have none, and the pose of each body is rounded too. Means of |error of qdd| / |qdd| over 40
// states of each robot, against long double [1e-16]:
//
//                            solo12   humanoid   panda   double pendulum
//   joint axes (this file)     5.2       5.3       2.7        2.2
//   world axes                 7.6       8.0       4.1        3.1
//   crba and factors of M      8.9      22.9       7.1       14.1
//   Pinocchio 3.7              4.9       5.1       2.3        2.7
//
// The rest comes in similar parts from the velocities, the articulated inertias, the forces and the last pass.
// It grows with the condition number of M. On chains with arbitrary axes, joint and world axes differ little.

#include <liecheck/algorithms/crba.hpp>
#include <liecheck/algorithms/rnea.hpp>

namespace liecheck {

namespace algorithms_detail {

/// R M R^T of a symmetric or any other matrix [3 x 3].
template <bool symmetric, Scalar S>
[[gnu::always_inline]] inline Matrix3<S> congruent(const Matrix3<S>& R, const Matrix3<S>& M) {
  const Matrix3<S> RM = product<S>(R, M);
  const auto entry = [&](int i, int j) __attribute__((always_inline)) {
    return mul_add(RM(i, 0), R(j, 0), mul_add(RM(i, 1), R(j, 1), S(RM(i, 2) * R(j, 2))));
  };
  const S xy = entry(0, 1), xz = entry(0, 2), yz = entry(1, 2);
  if constexpr (symmetric) return rows<S>(entry(0, 0), xy, xz, xy, entry(1, 1), yz, xz, yz, entry(2, 2));
  return rows<S>(entry(0, 0), xy, xz, entry(1, 0), entry(1, 1), yz, entry(2, 0), entry(2, 1), entry(2, 2));
}

/// Adds X* I^A X^-1 to sum, I^A = [A, B; B^T, D], X = (R, r): all blocks are rotated by R, and the reference
/// point is moved by -r: B' = B - A [r], D' = D + [r] B' + ([r] B)^T.
template <Scalar S>
void addTransformed(Matrix6<S>& sum, const Matrix6<S>& I, const SE3<S>& X) {
  const Matrix3<S>& R = X.rotation();
  const Vector3<S>& r = X.translation();
  const Matrix3<S> A = congruent<true, S>(R, I.template topLeftCorner<3, 3>()),
                   B = congruent<false, S>(R, I.template topRightCorner<3, 3>()),
                   D = congruent<true, S>(R, I.template bottomRightCorner<3, 3>());
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
  sum.template bottomRightCorner<3, 3>() += D + r_moved + r_B.transpose();
}

/// Replaces D [n x n], in the corner of L, by its Cholesky factor, D = L L^T, or by 1 / D if n = 1. Throws
/// SingularInertia unless each pivot is above the rounding error of D_kk. scale_k is the sum of the absolute
/// values of the terms of D_kk.
template <Scalar S>
void factorizeJointInertia(const Model<S>& model, std::size_t joint, int n, const Vector6<S>& scale,
                           Matrix6<S>& L) {
  using std::sqrt;
  for (int k = 0; k < n; ++k) {
    if (!(L(k, k) > S(64) * eps<S>() * scale[k]))
      throw SingularInertia(model.names[joint], int(joint), finite<S>(L(k, k)));
    if (n == 1) return void(L(0, 0) = S(1) / L(0, 0));
    L(k, k) = sqrt(L(k, k));
    for (int i = k + 1; i < n; ++i) L(i, k) /= L(k, k);
    for (int i = k + 1; i < n; ++i)
      for (int j = k + 1; j <= i; ++j) L(i, j) -= L(i, k) * L(j, k);
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
  Vector6<S> scale = Vector6<S>::Zero();
  if (const Axis<S>* axis = rotationAxis<S>(model.joints[i])) {  // S = (0, axis)
    const Vector3<S>& a = axis->to_vector();
    const Vector3<S> moment = axis->in(I.template bottomRightCorner<3, 3>());
    w.U.col(first) << axis->in(I.template topRightCorner<3, 3>()), moment;
    L(0, 0) = dot<S>(a, moment) + model.armature[first_v];
    scale[0] = a.cwiseAbs().dot(moment.cwiseAbs());
    w.u[first] = tau[first_v] - dot<S>(a, w.force[i].angular());
  } else {
    for (int k = 0; k < n; ++k) {
      const Vector6<S> s = w.S_columns.col(first + k);
      Vector6<S> U;
      U.noalias() = I * s;
      for (int j = 0; j <= k; ++j) L(k, j) = w.S_columns.col(first + j).dot(U);
      w.U.col(first + k) = U;
      scale[k] = s.cwiseAbs().dot(U.cwiseAbs());
      L(k, k) += model.armature[first_v + k];
      w.u[first + k] = tau[first_v + k] - s.dot(w.force[i].to_vector());
    }
  }
  factorizeJointInertia(model, i, n, scale, L);
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
  VectorX<S>& ddq = data.ddq.write(Level::Velocity);
  inverseDynamics<S>(model, data, q, v, nullptr, fext, ddq);
  ddq = tau - ddq;
  crba(model, data, q);
  factorize(model, data);
  solve(model, data.work.factor, ddq);
  return ddq;
}

}  // namespace algorithms_detail

/// qdd [nv; m/s^2, rad/s^2] = M(q)^-1 (tau - h(q, v) + sum J^T fext), tau [nv; N, N m]. Throws
/// SingularInertia. Updates liMi, v, ddq (with mimics also oMi, M).
template <Scalar S>
const VectorX<S>& aba(const Model<S>& model, Data<S>& data, In<S> q, In<S> v, In<S> tau,
                      External<S> fext = {}) {
  using namespace algorithms_detail;
  multibody_detail::checkSize(tau.size(), model.nv, "tau", "nv");
  checkForces<S>(model, fext);
  if (model.has_mimics) return denseForwardDynamics(model, data, q, v, tau, fext);
  data.begin(model, q, v);
  auto& w = data.work;
  auto& liMi = data.liMi.write(Level::Position);
  auto& V = data.v.write(Level::Velocity);
  const Matrix3<S> own_axes = Matrix3<S>::Identity();
  multibody_detail::forEachJoint(model, [&]<class Place>(const Place& joint) {
    const std::size_t i = std::size_t(joint.index), p = std::size_t(model.parents[i]);
    multibody_detail::build(
        liMi[i], [&]() __attribute__((always_inline)) { return joint.transform(q); });
    if constexpr (!Place::rotates) joint.subspaceIn(own_axes, w.S_columns.data() + 6 * joint.column);
    const Motion<S> relative = joint.motion(v);
    V[i] = p == 0 ? relative : liMi[i].actInv(V[p]) + relative;
    w.bias[i] = joint.velocityProduct(V[i], relative);
    const Inertia<S>& I = model.inertias[i];
    w.articulated[i] = I.matrix();
    w.force[i] = V[i].cross(I * V[i]);
    if (!fext.empty()) w.force[i] = w.force[i] - fext[i];
  });
  VectorX<S>& ddq = data.ddq.write(Level::Velocity);

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
    w.force[p] = w.force[p] + liMi[i].act(w.force[i] + Force<S>(Vector6<S>(I * w.bias[i].to_vector() + f)));
    addTransformed(w.articulated[p], I, liMi[i]);
  }

  w.gravitated[0] = Motion<S>(Vector3<S>(-model.gravity), Vector3<S>::Zero());
  for (std::size_t i = 1; i < model.joints.size(); ++i) {
    const int n = model.column_counts[i], first = model.idx_columns[i], first_v = model.idx_vs[i];
    const Matrix6<S>& L = w.D_factor[i];
    Vector6<S> a = (liMi[i].actInv(w.gravitated[std::size_t(model.parents[i])]) + w.bias[i]).to_vector();
    for (int k = 0; k < n; ++k) ddq[first_v + k] = w.u[first + k] - w.U.col(first + k).dot(a);
    if (n == 1)
      ddq[first_v] *= L(0, 0);
    else  // solves L^T qdd = u - U^T a
      for (int k = n - 1; k >= 0; --k) {
        for (int j = k + 1; j < n; ++j) ddq[first_v + k] -= L(j, k) * ddq[first_v + j];
        ddq[first_v + k] /= L(k, k);
      }
    if (const Axis<S>* axis = rotationAxis<S>(model.joints[i]))
      a.template tail<3>() += ddq[first_v] * axis->to_vector();
    else
      for (int k = 0; k < n; ++k) a += w.S_columns.col(first + k) * ddq[first_v + k];
    w.gravitated[i] = Motion<S>(a);
  }
  return ddq;
}

// instantiations_*.cpp instantiates these for float and double.
extern template decltype(aba<float>) aba<float>;
extern template decltype(aba<double>) aba<double>;

}  // namespace liecheck
