#pragma once
// Kinetic and potential energy of all bodies that are not fixed to the world, and of the motors (armature).

#include <liecheck/algorithms/kinematics.hpp>

namespace liecheck {

/// T = 1/2 sum_i v_i^T I_i v_i + 1/2 sum_k armature_k v_k^2 = 1/2 v^T M v [J], as in Pinocchio. Updates liMi,
/// oMi, v, kinetic_energy. q [nq], v [nv].
template <Scalar S>
S computeKineticEnergy(const Model<S>& model, Data<S>& data, In<S> q, In<S> v) {
  forwardKinematics(model, data, q, v);
  S& energy = data.kinetic_energy.write(Level::Velocity);
  energy = S(0);
  for (int k = 0; k < model.nv; ++k) energy += model.armature[k] * v[k] * v[k];
  energy /= S(2);
  for (std::size_t i = 1; i < model.joints.size(); ++i) energy += model.inertias[i].kineticEnergy(data.v[i]);
  return energy;
}

/// -sum m_i g . c_i [J], zero at the world's origin. Updates liMi, oMi, potential_energy. q [nq].
template <Scalar S>
S computePotentialEnergy(const Model<S>& model, Data<S>& data, In<S> q) {
  forwardKinematics(model, data, q);
  S& energy = data.potential_energy.write(Level::Position);
  energy = S(0);
  for (std::size_t i = 1; i < model.joints.size(); ++i)
    energy -= model.inertias[i].mass() * model.gravity.dot(data.oMi[i].act(model.inertias[i].lever()));
  return energy;
}

/// Kinetic plus potential energy [J]. It does not change in a motion with the accelerations of aba at tau = 0.
/// Updates liMi, oMi, v, kinetic_energy, potential_energy. q [nq], v [nv].
template <Scalar S>
S computeMechanicalEnergy(const Model<S>& model, Data<S>& data, In<S> q, In<S> v) {
  return computeKineticEnergy(model, data, q, v) + computePotentialEnergy(model, data, q);
}

}  // namespace liecheck
