#pragma once
// Inverse dynamics by the recursive Newton-Euler algorithm: Featherstone (2008), table 5.1.
//
//   f_i = I_i a_i + v_i x* I_i v_i - fext_i + sum_children X* f_c,   tau_i = S_i^T f_i + armature qdd
//
// Gravity is included because the universe gets the acceleration -g.

#include <liecheck/algorithms/kinematics.hpp>

namespace liecheck {

namespace algorithms_detail {

/// Computes tau [nv] from the forces f on the bodies. f[i] becomes the force that the parent exerts on joint
/// i, and f[0] the total force that the world exerts.
template <Scalar S>
void backwardForces(const Model<S>& model, const std::vector<SE3<S>>& liMi, std::vector<Force<S>>& f,
                    VectorX<S>& tau) {
  tau.setZero();
  f[0] = Force<S>::Zero();
  for (std::size_t i = model.joints.size() - 1; i > 0; --i) {
    multibody_detail::visitJoint(model, i, [&]<class Joint>(const Joint& joint) {
      tau.template segment<Joint::columns>(joint.idx_v) += joint.project(f[i]);
    });
    const std::size_t p = std::size_t(model.parents[i]);
    f[p] = f[p] + act(liMi[i], f[i]);
  }
}

/// Computes tau of (q, v, a), or of (q, v, 0) if a is null. Updates liMi, v and, unless a is null, f.
template <Scalar S>
void inverseDynamics(const Model<S>& model, Data<S>& data, In<S> q, In<S> v, const VectorX<S>* a,
                     const External<S>& fext, VectorX<S>& tau) {
  checkForces<S>(model, fext);
  auto& liMi = data.liMi.scratch();
  auto& V = data.v.scratch();
  auto& f = data.f.scratch();
  auto& A = data.work.gravitated;
  A[0] = Motion<S>(Vector3<S>(-model.gravity), Vector3<S>::Zero());
  multibody_detail::forEachJoint(model, [&](const auto& joint) {
    const std::size_t i = std::size_t(joint.index), p = std::size_t(model.parents[i]);
    liMi[i] = joint.transform(q);
    const Motion<S> relative = joint.motion(v);
    V[i] = p == 0 ? relative : actInv(liMi[i], V[p]) + relative;
    A[i] = actInv(liMi[i], A[p]) + joint.velocityProduct(V[i], relative);
    if (a) A[i] = A[i] + joint.motion(*a);
    f[i] = momentum(model.inertias[i], A[i]) + crossed(V[i], momentum(model.inertias[i], V[i]));
    if (!fext.empty()) f[i] = f[i] - fext[i];
  });
  backwardForces(model, liMi, f, tau);
  data.liMi.write(Level::Position), data.v.write(Level::Velocity);
  if (!a) return;
  data.f.write(Level::Acceleration);
  tau += model.armature.cwiseProduct(*a);
}

}  // namespace algorithms_detail

/// tau [nv; N, N m] = M(q) a + h(q, v) - sum J^T fext: the generalised forces of the acceleration a [nv].
/// q [nq], v [nv]. Updates liMi, v, f, tau.
template <Scalar S>
const VectorX<S>& rnea(const Model<S>& model, Data<S>& data, In<S> q, In<S> v, In<S> a,
                       External<S> fext = {}) {
  data.begin(model, q, v, a);
  algorithms_detail::inverseDynamics<S>(model, data, q, v, &a, fext, data.tau.scratch());
  return data.tau.write(Level::Acceleration);
}

/// h(q, v) [nv; N, N m]: Coriolis, centrifugal and gravity terms, tau at a = 0. Updates liMi, v, nle.
template <Scalar S>
const VectorX<S>& nonLinearEffects(const Model<S>& model, Data<S>& data, In<S> q, In<S> v) {
  data.begin(model, q, v);
  algorithms_detail::inverseDynamics<S>(model, data, q, v, nullptr, {}, data.nle.scratch());
  return data.nle.write(Level::Velocity);
}

namespace algorithms_detail {

/// Computes tau of (q, 0, 0). Updates liMi and the field that tau is.
template <Scalar S>
const VectorX<S>& statics(const Model<S>& model, Data<S>& data, In<S> q, const External<S>& fext,
                          Field<VectorX<S>>& tau) {
  data.begin(model, q);
  checkForces<S>(model, fext);
  auto& liMi = data.liMi.scratch();
  auto& f = data.f.scratch();
  auto& A = data.work.gravitated;
  A[0] = Motion<S>(Vector3<S>(-model.gravity), Vector3<S>::Zero());
  multibody_detail::forEachJoint(model, [&](const auto& joint) {
    const std::size_t i = std::size_t(joint.index), p = std::size_t(model.parents[i]);
    liMi[i] = joint.transform(q);
    A[i] = actInv(liMi[i], A[p]);
    f[i] = momentum(model.inertias[i], A[i]);
    if (!fext.empty()) f[i] = f[i] - fext[i];
  });
  backwardForces(model, liMi, f, tau.scratch());
  data.liMi.write(Level::Position);
  return tau.write(Level::Position);
}

}  // namespace algorithms_detail

/// g(q) [nv; N, N m]: the generalised gravity, tau at v = a = 0. Updates liMi, g.
template <Scalar S>
const VectorX<S>& computeGeneralizedGravity(const Model<S>& model, Data<S>& data, In<S> q) {
  return algorithms_detail::statics<S>(model, data, q, {}, data.g);
}
/// g(q) - sum J^T fext [nv; N, N m]: the generalised forces of static equilibrium. Updates liMi, tau_static.
template <Scalar S>
const VectorX<S>& computeStaticTorque(const Model<S>& model, Data<S>& data, In<S> q, External<S> fext) {
  return algorithms_detail::statics<S>(model, data, q, fext, data.tau_static);
}

// instantiations_*.cpp instantiates these for float and double.
extern template decltype(rnea<float>) rnea<float>;
extern template decltype(nonLinearEffects<float>) nonLinearEffects<float>;
extern template decltype(rnea<double>) rnea<double>;
extern template decltype(nonLinearEffects<double>) nonLinearEffects<double>;

}  // namespace liecheck
