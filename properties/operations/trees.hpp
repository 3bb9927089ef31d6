#pragma once
// The algorithms on trees of bodies. Each is bound to one tree; q, v, a and tau are in the subject's order.

#include <operations/layouts.hpp>

namespace liecheck::properties::op {

inline constexpr std::string_view lagrange_source = "Uicker 1965; Paul 1981, chapter 6",
                                  rnea_source = "Featherstone 2008, chapter 5",
                                  crba_source = "Featherstone 2008, chapter 6",
                                  aba_source = "Featherstone 2008, chapter 7",
                                  derivatives_source = "Carpentier & Mansard 2018",
                                  centroidal_source = "Orin & Goswami 2008",
                                  frame_source = "Featherstone 2008, sections 2.2, 2.10",
                                  frames_before = "forwardKinematics(model, data, q, v, a);",
                                  rnea_call = "rnea(model, data, q, v, a, on).transpose()";

/// Norms of generalised forces and accelerations are weighted by the diagonal of the mass matrix.
inline constexpr std::string_view torque_error = "|(tau - tau_exact)_k / sqrt(M_kk)|",
                                  torque_size = "|tau_exact,k / sqrt(M_kk)|", torque_unit = "sqrt(J)/s",
                                  mass_error = "|(M - M_exact)_kl / sqrt(M_kk M_ll)|, Frobenius",
                                  mass_size = "|M_kl / sqrt(M_kk M_ll)|, Frobenius";
inline constexpr Block torque{block::torque, torque_error, torque_size, torque_unit};

inline constexpr auto tree_rnea = operation<struct TreeRnea, true>(
    {"tree_rnea", "tau = M(q) a + h(q, v) - J^T F, inverse dynamics", rnea_source}, tree_tau, {torque},
    {"algorithms/rnea.hpp", rnea_call}, tree_q, tree_v, tree_a, wrench_joint, wrench);
inline constexpr auto tree_nonlinear_effects = operation<struct TreeNonlinearEffects, true>(
    {"tree_nonlinear_effects", "h(q, v): tau for a = 0 without a wrench", rnea_source}, tree_tau, {torque},
    {"algorithms/rnea.hpp", "nonLinearEffects(model, data, q, v).transpose()"}, tree_q, tree_v);
inline constexpr auto tree_gravity = operation<struct TreeGravity, true>(
    {"tree_gravity", "g(q) = h(q, 0)", rnea_source}, tree_tau, {torque},
    {"algorithms/rnea.hpp", "computeGeneralizedGravity(model, data, q).transpose()"}, tree_q);
inline constexpr auto tree_aba = operation<struct TreeAba, true>(
    {"tree_aba", "a = M(q)^-1 (tau - h(q, v) + J^T F), forward dynamics", aba_source}, tree_a,
    {{block::acceleration, "|(a - a_exact)_k sqrt(M_kk)|", "|a_exact,k sqrt(M_kk)|", "sqrt(J)/s"}},
    {"algorithms/aba.hpp", "aba(model, data, q, v, tau, on).transpose()"}, tree_q, tree_v, tree_tau,
    wrench_joint, wrench);
inline constexpr auto tree_crba = operation<struct TreeCrba, true>(
    {"tree_crba", "M(q) = d^2 T / d v^2, the joint-space inertia matrix", crba_source}, M_result,
    {{block::matrix, mass_error, mass_size, "1"}}, {"algorithms/crba.hpp", "crba(model, data, q)"}, tree_q);
inline constexpr auto tree_mass_inverse = operation<struct TreeMassInverse, true>(
    {"tree_mass_inverse", "M(q)^-1", "Carpentier 2018; Featherstone 2008, chapter 6"}, M_inverse_result,
    {{block::matrix, "|(M^-1 - exact)_kl sqrt(M_kk M_ll)|, Frobenius", "|M^-1_kl sqrt(M_kk M_ll)|, Frobenius",
      "1"}},
    {"algorithms/crba.hpp", "computeMinverse(model, data, q)"}, tree_q);

inline constexpr auto rnea_derivatives = operation<struct RneaDerivatives, true>(
    {"rnea_derivatives", "(d tau / d q, d tau / d v) of inverse dynamics, with q displaced by integrate",
     derivatives_source},
    derivatives_result,
    {{block::by_q, "|((dtau/dq - exact) d)_k / sqrt(M_kk)| for a direction d",
      "|((dtau/dq exact) d)_k / sqrt(M_kk)|", torque_unit},
     {block::by_v, "|((dtau/dv - exact) d)_k / sqrt(M_kk)| for a direction d",
      "|((dtau/dv exact) d)_k / sqrt(M_kk)|", torque_unit}},
    {"algorithms/derivatives.hpp",
     "(data.dtau_dq() * d).transpose() << '\\n' << (data.dtau_dv() * d).transpose()",
     "computeRNEADerivatives(model, data, q, v, a, on);"},
    tree_q, tree_v, tree_a, wrench_joint, wrench);
inline constexpr auto aba_derivatives = operation<struct AbaDerivatives, true>(
    {"aba_derivatives", "(d a / d q, d a / d v) = -M^-1 (d tau / d q, d tau / d v) at a = aba(tau)",
     derivatives_source},
    derivatives_result,
    {{block::by_q, "|((da/dq - exact) d)_k sqrt(M_kk)| for a direction d", "|((da/dq exact) d)_k sqrt(M_kk)|",
      torque_unit},
     {block::by_v, "|((da/dv - exact) d)_k sqrt(M_kk)| for a direction d", "|((da/dv exact) d)_k sqrt(M_kk)|",
      torque_unit}},
    {"algorithms/derivatives.hpp",
     "(data.ddq_dq() * d).transpose() << '\\n' << (data.ddq_dv() * d).transpose()",
     "computeABADerivatives(model, data, q, v, tau, on);"},
    tree_q, tree_v, tree_tau, wrench_joint, wrench);

inline constexpr auto tree_kinetic_energy = operation<struct TreeKineticEnergy, true>(
    {"tree_kinetic_energy", "T = 1/2 v^T M(q) v", lagrange_source}, kinetic,
    {{block::energy, "|T - T_exact|", "T_exact", "J"}},
    {"algorithms/energy.hpp", "computeKineticEnergy(model, data, q, v)"}, tree_q, tree_v);
inline constexpr auto tree_potential_energy = operation<struct TreePotentialEnergy, true>(
    {"tree_potential_energy", "V = -sum_i m_i g . c_i", lagrange_source}, potential,
    {{block::energy, "|V - V_exact|", "|V_exact|", "J"}},
    {"algorithms/energy.hpp", "computePotentialEnergy(model, data, q)"}, tree_q);
inline constexpr auto tree_momentum = operation<struct TreeMomentum, true>(
    {"tree_momentum", "h_g = sum_i m_i (x_i', (x_i - c) x x_i')", centroidal_source}, momentum_result,
    {{block::linear, "|l - l_exact|", "|l_exact|", "kg m/s"},
     {block::angular, "|k - k_exact|", "|k_exact|", "kg m^2/s"}},
    {"algorithms/centroidal.hpp", "computeCentroidalMomentum(model, data, q, v).to_vector().transpose()"},
    tree_q, tree_v);
inline constexpr auto tree_momentum_map = operation<struct TreeMomentumMap, true>(
    {"tree_momentum_map", "A_g(q): h_g = A_g v", centroidal_source}, momentum_map_result,
    {{block::linear, "|(A_g v - h_g exact) linear|", "|l_exact|", "kg m/s"},
     {block::angular, "|(A_g v - h_g exact) angular|", "|k_exact|", "kg m^2/s"}},
    {"algorithms/centroidal.hpp", "(computeCentroidalMap(model, data, q) * v).transpose()"}, tree_q);

inline constexpr auto frame_pose = operation<struct FramePose, true>(
    {"frame_pose", "oMf = X_W,joint(q) X_joint,frame", frame_source}, frame_result,
    {{block::rotation, "|R - R_exact|, Frobenius", "|R_exact|", "1"},
     {block::translation, "|p - p_exact|", "|p_exact|", "m"}},
    {"algorithms/frames.hpp", "data.oMf[frame].toActionMatrix()", "framesForwardKinematics(model, data, q);"},
    tree_q);
inline constexpr auto frame_velocity = operation<struct FrameVelocity, true>(
    {"frame_velocity", "V: R' = [omega] R and p' of the frame's pose, in the reference `seen`", frame_source},
    frame_velocity_result,
    {{block::linear, "|u - u_exact| in each reference", "|u_exact|", "m/s"},
     {block::angular, "|omega - omega_exact| in each reference", "|omega_exact|", "rad/s"}},
    {"algorithms/frames.hpp", "getFrameVelocity(model, data, frame, seen).to_vector().transpose()",
     frames_before},
    tree_q, tree_v, seen);
inline constexpr auto frame_acceleration = operation<struct FrameAcceleration, true>(
    {"frame_acceleration", "V', the spatial acceleration, in the reference `seen`", frame_source},
    frame_acceleration_result,
    {{block::linear, "|V'_linear - exact| in each reference", "|V'_linear exact|", "m/s^2"},
     {block::angular, "|omega' - exact| in each reference", "|omega' exact|", "rad/s^2"}},
    {"algorithms/frames.hpp", "getFrameAcceleration(model, data, frame, seen).to_vector().transpose()",
     frames_before},
    tree_q, tree_v, tree_a, seen);
inline constexpr auto frame_classical_acceleration = operation<struct FrameClassicalAcceleration, true>(
    {"frame_classical_acceleration",
     "V' + (omega x u, 0), the acceleration of the frame's origin, in the reference `seen`", frame_source},
    frame_acceleration_result,
    {{block::linear, "|p'' - p''_exact| in each reference", "|p''_exact|", "m/s^2"},
     {block::angular, "|omega' - exact| in each reference", "|omega' exact|", "rad/s^2"}},
    {"algorithms/frames.hpp",
     "getFrameClassicalAcceleration(model, data, frame, seen).to_vector().transpose()", frames_before},
    tree_q, tree_v, tree_a, seen);
inline constexpr auto frame_jacobian = operation<struct FrameJacobian, true>(
    {"frame_jacobian", "J(q): V = J v, in the reference `seen`", frame_source}, frame_jacobian_result,
    {{block::linear, "|(J v - V_exact) linear| in each reference", "|u_exact|", "m/s"},
     {block::angular, "|(J v - V_exact) angular| in each reference", "|omega_exact|", "rad/s"}},
    {"algorithms/jacobians.hpp", "(getFrameJacobian(model, data, frame, seen) * v).transpose()",
     "computeJointJacobians(model, data, q);"},
    tree_q, seen);
inline constexpr auto frame_jacobian_rate = operation<struct FrameJacobianRate, true>(
    {"frame_jacobian_rate", "J'(q, v): V' = J a + J' v, in the reference `seen`", frame_source},
    frame_jacobian_rate_result,
    {{block::linear, "|(J a + J' v - A_exact) linear|; A is spatial, but classical in LOCAL_WORLD_ALIGNED",
      "|A_linear exact|", "m/s^2"},
     {block::angular, "|(J a + J' v - A_exact) angular|", "|omega'_exact|", "rad/s^2"}},
    {"algorithms/jacobians.hpp",
     "(getFrameJacobian(model, data, frame, seen) * a + getFrameJacobianTimeVariation(model, data, frame, "
     "seen) * v).transpose()",
     "computeJointJacobiansTimeVariation(model, data, q, v);"},
    tree_q, tree_v, seen);

// Quantities that laws form from these operations.
inline constexpr Operation rnea_of_aba =
    formed({"rnea_of_aba", "rnea(q, v, aba(q, v, tau, F), F) = tau", aba_source}, tree_tau,
           {{block::torque, "|(rnea(aba(tau)) - tau)_k / sqrt(M_kk)|", "|tau_k / sqrt(M_kk)|", torque_unit}},
           {"algorithms/aba.hpp", "(rnea(model, data, q, v, a, on) - tau).transpose()",
            "a = aba(model, data, q, v, tau, on);"},
           tree_q, tree_v, tree_tau, wrench_joint, wrench);
inline constexpr Operation crba_symmetric =
    formed({"crba_symmetric", "M = M^T", crba_source}, M_result,
           {{block::matrix, "|(M - M^T)_kl / sqrt(M_kk M_ll)|, Frobenius", mass_size, "1"}},
           {"algorithms/crba.hpp", "crba(model, data, q)"}, tree_q);
inline constexpr Operation crba_positive =
    formed({"crba_positive", "x^T M x > 0", crba_source}, M_result,
           {{block::matrix, "0 if M has a Cholesky factor, else infinite", "absolute", "1"}},
           {"algorithms/crba.hpp", "crba(model, data, q)"}, tree_q);
inline constexpr Operation crba_columns =
    formed({"crba_columns", "M e_k = rnea(q, 0, e_k) without gravity", crba_source}, M_result,
           {{block::matrix, "|(M - [rnea(q, 0, e_k)])_kl / sqrt(M_kk M_ll)|, Frobenius", mass_size, "1"}},
           {"algorithms/crba.hpp", "crba(model, data, q)"}, tree_q);
inline constexpr Operation tree_power =
    formed({"tree_power", "rnea(q, v, a)^T v = d/dt (T + V)", "Goldstein 1980, section 2.6"}, power_result,
           {{block::power, "|tau^T v - d/dt (T + V)|", "|d/dt (T + V)|", "W"}},
           {"algorithms/rnea.hpp", "rnea(model, data, q, v, a).dot(v)"}, tree_q, tree_v, tree_a);
inline constexpr Operation momentum_conserved = formed(
    {"momentum_conserved", "tau_base(q, v, aba(q, v, (0, tau))) = 0 for g = 0", "Noether 1918"}, tree_tau,
    {{block::torque, "|tau_base,k / sqrt(M_kk)| of the exact inverse dynamics at the computed a",
      "|A| |a| + |tau| + the terms of inverse dynamics, in the same norms", torque_unit}},
    {"algorithms/aba.hpp", "rnea(model, data, q, v, a).head(6).transpose()",
     "model.gravity.setZero(), tau.head(6).setZero();\n  a = aba(model, data, q, v, tau);"},
    tree_q, tree_v, tree_tau);
inline constexpr Operation rnea_of_a_moved_world = formed(
    {"rnea_of_a_moved_world",
     "tau does not change if the world frame is rotated by pi about x and moved by 100 m", rnea_source},
    tree_tau, {torque}, {"algorithms/rnea.hpp", rnea_call}, tree_q, tree_v, tree_a, wrench_joint, wrench);
inline constexpr Operation rnea_of_reordered_joints = formed(
    {"rnea_of_reordered_joints", "tau does not change if branches are added in the opposite order",
     rnea_source},
    tree_tau, {torque}, {"algorithms/rnea.hpp", rnea_call}, tree_q, tree_v, tree_a, wrench_joint, wrench);
inline constexpr Operation rnea_of_split_bodies = formed(
    {"rnea_of_split_bodies", "tau does not change if each body is split into two halves on one joint",
     rnea_source},
    tree_tau, {torque}, {"algorithms/rnea.hpp", rnea_call}, tree_q, tree_v, tree_a, wrench_joint, wrench);

}  // namespace liecheck::properties::op
