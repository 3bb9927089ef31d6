#pragma once
// First derivatives of inverse and forward dynamics with respect to tangent increments of q and to v.
//
// All quantities are in world axes at one point O. An increment of joint j along column s_k of its motion
// subspace moves the subtree of j (its body and all descendants) as one rigid body. With p = parent(j), the
// velocity and acceleration of every body i of the subtree change, in addition to that rigid motion, by
//
//   for q_k:  dv_i = w,  da_i = z + w x v_i,  w = v_p x s,  z = a_p x s + v_p x w
//   for v_k:  dv_i = s,  da_i = y + s x v_i,  y = (v_j + v_p) x s
//   df_i = I_i (z or y) + B_i (w or s),      B x = -I (v x x) + x x* (I v) + v x* (I x)
//
// For q_k the force F_j through joint j also moves with the subtree, which adds the change s x* F_j.
// Carpentier & Mansard (2018); Singh, Russell & Wensing (2022).

#include <liecheck/algorithms/aba.hpp>

namespace liecheck {

namespace algorithms_detail {

/// The matrix B [6 x 6] above, of a body with inertia I and velocity v.
template <Scalar S>
Matrix6<S> coriolis(const Matrix6<S>& I, const Motion<S>& v) {
  const Vector6<S> h = I * v.to_vector();
  const Matrix3<S> f = skew<S>(h.template head<3>()), n = skew<S>(h.template tail<3>());
  const Matrix6<S> adjoint = v.toActionMatrix();
  Matrix6<S> momentum;
  momentum << Matrix3<S>::Zero(), f, f, n;
  return -I * adjoint - momentum - adjoint.transpose() * I;
}

}  // namespace algorithms_detail

/// dtau/dq, dtau/dv and dtau/da = M [nv x nv] of rnea(q, v, a, fext). Every fext moves with its body.
/// Updates liMi, oMi, M, dtau_dq, dtau_dv.
template <Scalar S>
void computeRNEADerivatives(const Model<S>& model, Data<S>& data, In<S> q, In<S> v, In<S> a,
                            External<S> fext = {}) {
  using namespace algorithms_detail;
  data.require(Dense::Derivatives, "computeRNEADerivatives");
  checkForces<S>(model, fext);
  columnsInWorldAxes(model, data, q);
  data.begin(model, q, v, a);
  auto& work = data.work;
  const auto& oMi = data.oMi();
  auto &s = work.U, &z = work.z, &w = work.w, &y = work.y;
  auto &V = work.bias, &A = work.gravitated;
  MatrixX<S>& dq = data.dtau_dq.write(Level::Acceleration);
  MatrixX<S>& dv = data.dtau_dv.write(Level::Velocity);
  MatrixX<S>& M = data.M.write(Level::Position);
  dq.setZero(), dv.setZero(), M.setZero();
  M.diagonal() = model.armature;
  const auto columns = [&](std::size_t i, auto f) {
    for (int k = model.idx_columns[i]; k < model.idx_columns[i] + model.column_counts[i]; ++k)
      f(k, model.column_to_v[std::size_t(k)]);
  };
  const Vector3<S> O = model.njoints > 1 ? oMi[1].translation() : oMi[0].translation();

  V[0] = Motion<S>::Zero();
  A[0] = Motion<S>(Vector3<S>(-model.gravity), Vector3<S>::Zero());
  for (std::size_t i = 1; i < model.joints.size(); ++i) {
    const std::size_t p = std::size_t(model.parents[i]);
    // r[i], so far the vector from joint p, becomes the vector from O. It is summed along the tree, so that
    // no digits are lost far from the world's origin.
    work.r[i] = p == 0 ? Vector3<S>(oMi[i].translation() - O) : Vector3<S>(work.r[p] + work.r[i]);
    const SE3<S> X(oMi[i].rotation(), work.r[i]);
    Motion<S> relative = Motion<S>::Zero(), driven = Motion<S>::Zero();
    columns(i, [&](int k, int vk) {
      const Motion<S> sk = shifted(column(work.S_columns, k), Vector3<S>(-X.translation()));
      s.col(k) = sk.to_vector();
      relative = relative + sk * v[vk];
      driven = driven + sk * a[vk];
    });
    V[i] = V[p] + relative;
    A[i] = A[p] + driven + V[i].cross(relative);
    columns(i, [&](int k, int) {
      const Motion<S> sk = column(s, k), wk = V[p].cross(sk);
      w.col(k) = wk.to_vector();
      z.col(k) = (A[p].cross(sk) + V[p].cross(wk)).to_vector();
      y.col(k) = (V[i] + V[p]).cross(sk).to_vector();
    });
    const Inertia<S> I = X.act(model.inertias[i]);
    work.articulated[i] = I.matrix();
    work.coriolis[i] = coriolis<S>(work.articulated[i], V[i]);
    work.force[i] = I * A[i] + V[i].cross(I * V[i]);
    if (!fext.empty()) work.force[i] = work.force[i] - X.act(fext[i]);
  }
  for (std::size_t j = model.joints.size() - 1; j > 0; --j) {
    const Matrix6<S>&I = work.articulated[j], &B = work.coriolis[j];
    columns(j, [&](int k, int vk) {
      const Vector6<S> Is = I * s.col(k), Bs = B.transpose() * s.col(k);
      const Vector6<S> by_v = I * y.col(k) + B * s.col(k), by_q = I * z.col(k) + B * w.col(k);
      const Vector6<S> carried = by_q + column(s, k).cross(work.force[j]).to_vector();
      columns(j, [&](int m, int vm) {
        dq(vm, vk) += s.col(m).dot(by_q);
        dv(vm, vk) += s.col(m).dot(by_v);
        M(vm, vk) += s.col(m).dot(Is);
      });
      for (std::size_t i = std::size_t(model.parents[j]); i > 0; i = std::size_t(model.parents[i]))
        columns(i, [&](int m, int vm) {
          dq(vm, vk) += s.col(m).dot(carried);
          dv(vm, vk) += s.col(m).dot(by_v);
          dq(vk, vm) += z.col(m).dot(Is) + w.col(m).dot(Bs);
          dv(vk, vm) += y.col(m).dot(Is) + s.col(m).dot(Bs);
          M(vm, vk) += s.col(m).dot(Is);
          M(vk, vm) += s.col(m).dot(Is);
        });
    });
    const std::size_t p = std::size_t(model.parents[j]);
    if (p == 0) continue;
    work.articulated[p] += I;
    work.coriolis[p] += B;
    work.force[p] = work.force[p] + work.force[j];
  }
}

/// dqdd/dq, dqdd/dv and dqdd/dtau = M^-1 [nv x nv] of aba(q, v, tau, fext). The first two are -M^-1 times
/// dtau/dq and dtau/dv of rnea at a = qdd. Throws SingularInertia. Updates liMi, oMi, ddq, M, Minv, dtau_dq,
/// dtau_dv, ddq_dq, ddq_dv.
template <Scalar S>
void computeABADerivatives(const Model<S>& model, Data<S>& data, In<S> q, In<S> v, In<S> tau,
                           External<S> fext = {}) {
  data.require(Dense::Derivatives, "computeABADerivatives");
  computeMinverse(model, data, q);
  aba(model, data, q, v, tau, fext);
  computeRNEADerivatives(model, data, q, v, data.ddq(), fext);
  data.ddq_dq.write(Level::Acceleration) = -(data.Minv().lazyProduct(data.dtau_dq()));
  data.ddq_dv.write(Level::Velocity) = -(data.Minv().lazyProduct(data.dtau_dv()));
}

// instantiations_*.cpp instantiates these for float and double.
extern template decltype(computeRNEADerivatives<float>) computeRNEADerivatives<float>;
extern template decltype(computeABADerivatives<float>) computeABADerivatives<float>;
extern template decltype(computeRNEADerivatives<double>) computeRNEADerivatives<double>;
extern template decltype(computeABADerivatives<double>) computeABADerivatives<double>;

}  // namespace liecheck
