#pragma once
// liecheck's own algorithms on a tree of bodies, in any scalar.

#include <liecheck/algorithms/centroidal_derivatives.hpp>
#include <liecheck/algorithms/coriolis.hpp>
#include <liecheck/algorithms/energy.hpp>
#include <liecheck/algorithms/kinematics_derivatives.hpp>
#include <liecheck/algorithms/operational_space.hpp>
#include <subjects/liecheck_trees.hpp>

namespace liecheck::properties {

template <class S>
struct LiecheckTree {
  using O = TreeOperations<S>;
  using X = VecX<S>;
  using M = MatX<S>;
  using V6 = Vec<S, 6>;

  static Vec<S, 3> vector(const oracles::Vec3<S>& v) { return {v[0], v[1], v[2]}; }
  static SE3<S> pose(const oracles::Quaternion<S>& Q, const oracles::Vec3<S>& p) {
    return {SO3<S>(Vec<S, 4>(Q[0], Q[1], Q[2], Q[3])).normalized(), vector(p)};
  }
  static Inertia<S> inertia(const oracles::BodyOf<S>& b) {
    Mat<S, 3> I;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) I(i, j) = b.I_C(i, j);
    return {b.mass, vector(b.c), I};
  }
  static Joint<S> joint(const oracles::JointOf<S>& j) {
    using oracles::JointKind;
    const Vec<S, 3> axis = vector(j.axis);
    const auto simple = [&]() -> typename Mimic<S>::Moved {
      if (j.kind == JointKind::revolute) return Revolute<S>(axis);
      if (j.kind == JointKind::prismatic) return Prismatic<S>(axis);
      return Helical<S>(axis, j.pitch);
    };
    if (j.primary >= 0) return Mimic<S>(simple(), j.primary + 1, j.multiplier, j.offset);
    switch (j.kind) {
      case JointKind::continuous:
        return Continuous<S>(axis);
      case JointKind::spherical:
        return Spherical<S>();
      case JointKind::planar:
        return Planar<S>();
      case JointKind::translation:
        return Translation<S>();
      case JointKind::free_flyer:
        return FreeFlyer<S>();
      default:
        return std::visit([](const auto& moved) -> Joint<S> { return moved; }, simple());
    }
  }
  static Model<S> model(const Tree<S>& tree) {
    Model<S> m;
    m.gravity = vector(tree.gravity);
    for (std::size_t i = 0; i < tree.joints.size(); ++i) {
      const auto& j = tree.joints[i];
      const int id = m.addJoint(j.parent + 1, joint(j), pose(j.Q, j.p), std::to_string(i));
      m.appendBodyToJoint(id, inertia(j.body));
      if (j.primary < 0) m.armature.tail(m.nvs.back()).setConstant(j.armature);
    }
    for (const auto& b : tree.fixed) m.appendBodyToJoint(b.joint + 1, inertia(b.body), pose(b.Q, b.p));
    m.addFrame({"frame", tree.frame_joint + 1, 0, pose(tree.frame_Q, tree.frame_p), FrameType::OP_FRAME});
    return m;
  }

  // Longer than 80 lines: one entry for each operation.
  static O bind(const Tree<S>& tree) {
    struct Bound {
      explicit Bound(const Tree<S>& tree) : m(model(tree)), d(m, Dense::Derivatives) {}
      std::span<const Force<S>> on(int joint, const V6& F) {
        if (joint < 0) return {};
        forces.assign(m.joints.size(), Force<S>::Zero());
        forces[static_cast<std::size_t>(joint) + 1] = Force<S>(F);
        return forces;
      }
      Model<S> m;
      Data<S> d;
      std::vector<Force<S>> forces;
      int frame = 1;
    };
    const auto b = std::make_shared<Bound>(tree);
    const auto seen = [](Seen s) {
      return s == Seen::world   ? ReferenceFrame::WORLD
             : s == Seen::local ? ReferenceFrame::LOCAL
                                : ReferenceFrame::LOCAL_WORLD_ALIGNED;
    };
    O o;
    o[op::tree_rnea] = [b](const X& q, const X& v, const X& a, int i, const V6& F) -> X {
      return rnea(b->m, b->d, q, v, a, b->on(i, F));
    };
    o[op::tree_aba] = [b](const X& q, const X& v, const X& tau, int i, const V6& F) -> X {
      return aba(b->m, b->d, q, v, tau, b->on(i, F));
    };
    o[op::tree_nonlinear_effects] = [b](const X& q, const X& v) -> X {
      return nonLinearEffects(b->m, b->d, q, v);
    };
    o[op::tree_gravity] = [b](const X& q) -> X { return computeGeneralizedGravity(b->m, b->d, q); };
    o[op::tree_crba] = [b](const X& q) -> M { return crba(b->m, b->d, q); };
    o[op::tree_mass_inverse] = [b](const X& q) -> M { return computeMinverse(b->m, b->d, q); };
    o[op::rnea_derivatives] = [b](const X& q, const X& v, const X& a, int i, const V6& F) -> std::pair<M, M> {
      computeRNEADerivatives(b->m, b->d, q, v, a, b->on(i, F));
      return {b->d.dtau_dq(), b->d.dtau_dv()};
    };
    o[op::aba_derivatives] = [b](const X& q, const X& v, const X& tau, int i,
                                 const V6& F) -> std::pair<M, M> {
      computeABADerivatives(b->m, b->d, q, v, tau, b->on(i, F));
      return {b->d.ddq_dq(), b->d.ddq_dv()};
    };
    o[op::tree_kinetic_energy] = [b](const X& q, const X& v) -> S {
      return computeKineticEnergy(b->m, b->d, q, v);
    };
    o[op::tree_potential_energy] = [b](const X& q) -> S { return computePotentialEnergy(b->m, b->d, q); };
    o[op::tree_momentum] = [b](const X& q, const X& v) -> V6 {
      return computeCentroidalMomentum(b->m, b->d, q, v).to_vector();
    };
    o[op::tree_momentum_map] = [b](const X& q) -> M { return computeCentroidalMap(b->m, b->d, q); };
    o[op::frame_pose] = [b](const X& q) -> Pose<S> {
      framesForwardKinematics(b->m, b->d, q);
      const SE3<S>& T = b->d.oMf[static_cast<std::size_t>(b->frame)];
      return {T.rotation(), T.translation()};
    };
    o[op::frame_velocity] = [b, seen](const X& q, const X& v, Seen s) -> V6 {
      forwardKinematics(b->m, b->d, q, v);
      return getFrameVelocity(b->m, b->d, b->frame, seen(s)).to_vector();
    };
    o[op::frame_acceleration] = [b, seen](const X& q, const X& v, const X& a, Seen s) -> V6 {
      forwardKinematics(b->m, b->d, q, v, a);
      return getFrameAcceleration(b->m, b->d, b->frame, seen(s)).to_vector();
    };
    o[op::frame_classical_acceleration] = [b, seen](const X& q, const X& v, const X& a, Seen s) -> V6 {
      forwardKinematics(b->m, b->d, q, v, a);
      return getFrameClassicalAcceleration(b->m, b->d, b->frame, seen(s)).to_vector();
    };
    o[op::frame_jacobian] = [b, seen](const X& q, Seen s) -> M {
      computeJointJacobians(b->m, b->d, q);
      return getFrameJacobian(b->m, b->d, b->frame, seen(s));
    };
    o[op::frame_jacobian_rate] = [b, seen](const X& q, const X& v, Seen s) -> M {
      computeJointJacobiansTimeVariation(b->m, b->d, q, v);
      return getFrameJacobianTimeVariation(b->m, b->d, b->frame, seen(s));
    };
    o[op::tree_static_torque] = [b](const X& q, int i, const V6& F) -> X {
      return computeStaticTorque(b->m, b->d, q, b->on(i, F));
    };
    o[op::static_torque_derivative] = [b](const X& q, int i, const V6& F) -> M {
      return computeStaticTorqueDerivatives(b->m, b->d, q, b->on(i, F));
    };
    o[op::tree_coriolis] = [b](const X& q, const X& v) -> M {
      return computeCoriolisMatrix(b->m, b->d, q, v);
    };
    o[op::tree_center_of_mass] = [b](const X& q) -> Vec<S, 3> { return centerOfMass(b->m, b->d, q); };
    o[op::tree_com_jacobian] = [b](const X& q) -> M { return jacobianCenterOfMass(b->m, b->d, q); };
    const auto centroidal = [b](const X& q, const X& v, const X& a) {
      std::array<M, 4> all;
      for (M& m : all) m.resize(6, b->m.nv);
      computeCentroidalDynamicsDerivatives<S>(b->m, b->d, q, v, a, all[0], all[1], all[2], all[3]);
      return all;
    };
    o[op::momentum_derivative] = [centroidal](const X& q, const X& v) -> M { return centroidal(q, v, v)[0]; };
    o[op::momentum_rate_derivatives] = [centroidal](const X& q, const X& v, const X& a) -> std::pair<M, M> {
      const auto all = centroidal(q, v, a);
      return {all[1], all[2]};
    };
    o[op::frame_velocity_derivatives] = [b, seen](const X& q, const X& v, Seen s) -> std::pair<M, M> {
      M by_q(6, b->m.nv), by_v = by_q;
      computeForwardKinematicsDerivatives(b->m, b->d, q, v, v);
      getFrameVelocityDerivatives<S>(b->m, b->d, b->frame, seen(s), by_q, by_v);
      return {by_q, by_v};
    };
    o[op::frame_acceleration_derivatives] = [b, seen](const X& q, const X& v, const X& a,
                                                      Seen s) -> std::pair<M, M> {
      M by_q(6, b->m.nv), by_v = by_q, by_a = by_q;
      computeForwardKinematicsDerivatives(b->m, b->d, q, v, a);
      getFrameAccelerationDerivatives<S>(b->m, b->d, b->frame, seen(s), by_q, by_v, by_a);
      return {by_q, by_v};
    };
    o[op::operational_inertia] = [b, seen](const X& q, Seen s) -> Mat<S, 6> {
      return computeOperationalSpaceInertia(b->m, b->d, q, b->frame, seen(s));
    };
    return o;
  }
};

template <class S>
TreeOperations<S> liecheck_tree(const Tree<S>& tree) {
  return LiecheckTree<S>::bind(tree);
}
template <class S>
Model<S> liecheck_model(const Tree<S>& tree) {
  return LiecheckTree<S>::model(tree);
}

}  // namespace liecheck::properties
