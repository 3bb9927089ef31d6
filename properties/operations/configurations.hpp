#pragma once
// The operations on configurations of a free-flyer, and of a whole robot.

#include <operations/layouts.hpp>

namespace liecheck::properties::op {

inline constexpr std::string_view configuration_header = "multibody/se3_configuration.hpp",
                                  robot_header =
                                      "multibody/configuration.hpp>\n#include <liecheck/urdf/urdf.hpp",
                                  plus_source = "Sola, Deray & Atchuthan 2018, eqs. 25-28",
                                  adjoint_source = "Sola, Deray & Atchuthan 2018, eqs. 79-85";

inline constexpr auto integrate = operation<struct Integrate>(
    {"integrate", "q1 = T0 exp(delta)", plus_source}, q1_result,
    {rotation_of_quaternion,
     {block::translation, "|p - p_exact|", "max(|p_exact|, |p0|, |p_exact - p0|)", "m"},
     {block::norm_defect, "| |Q1|^2 - 1 |", "absolute", "1"},
     {block::sign, "max(0, -Q0 . Q1)", "absolute", "1"}},
    {configuration_header, "integrateSE3<S>(q0, delta)"}, q0, delta);
inline constexpr auto difference = operation<struct Difference>(
    {"difference", "delta = log(T0^-1 T1)", plus_source}, delta_result,
    {rotation_vector, {block::linear, "|rho - rho_exact|", "max(|rho_exact|, |p1 - p0|)", "m"}},
    {configuration_header, "differenceSE3<S>(q0, q1)"}, q0, q1);

/// Laws form the next two quantities from integrate and difference.
inline constexpr Operation difference_of_integrate = formed(
    {"difference_of_integrate", "difference(q0, integrate(q0, delta)) = delta, |phi| < pi", plus_source},
    delta_result,
    {{block::rotation_vector, "|phi' - phi|", "|phi|", "rad"},
     {block::linear, "|rho' - rho|", "max(|rho|, |p1 - p0|)", "m"}},
    {configuration_header, "differenceSE3<S>(q0, integrateSE3<S>(q0, delta))"}, q0, delta);
inline constexpr Operation integrate_of_difference = formed(
    {"integrate_of_difference", "integrate(q0, difference(q0, q1)) = q1 as a pose", plus_source}, q1_result,
    {{block::rotation, "2 min(|Q1' - Q1/|Q1||, |Q1' + Q1/|Q1||)", "absolute", "rad"},
     {block::translation, "|p1' - p1|", "max(|p1|, |p0|, |p1 - p0|)", "m"}},
    {configuration_header, "integrateSE3<S>(q0, differenceSE3<S>(q0, q1))"}, q0, q1);

inline constexpr Block tangent_coupling{
    block::coupling, "|C - C_exact| of the upper right 3 x 3 block, Frobenius", "|C_exact|", "m"};

inline constexpr auto d_integrate_arg0 = operation<struct DIntegrateArg0>(
    {"d_integrate_arg0", "d integrate(q0, delta) / d q0 = Ad(exp(-delta))", adjoint_source}, J6_tangent,
    {jacobian6, coupling6}, {configuration_header, "dIntegrateSE3<S>(q0, delta, ArgumentPosition::ARG0)"}, q0,
    delta);
inline constexpr auto d_integrate_arg1 = operation<struct DIntegrateArg1>(
    {"d_integrate_arg1", "d integrate(q0, delta) / d delta = J_r(delta)", adjoint_source}, J6_tangent,
    {jacobian6, coupling6}, {configuration_header, "dIntegrateSE3<S>(q0, delta, ArgumentPosition::ARG1)"}, q0,
    delta);
inline constexpr auto d_difference_arg0 = operation<struct DDifferenceArg0>(
    {"d_difference_arg0", "d difference(q0, q1) / d q0 = -J_l(difference)^-1", adjoint_source}, J6_tangent,
    {jacobian6, tangent_coupling},
    {configuration_header, "dDifferenceSE3<S>(q0, q1, ArgumentPosition::ARG0)"}, q0, q1);
inline constexpr auto d_difference_arg1 = operation<struct DDifferenceArg1>(
    {"d_difference_arg1", "d difference(q0, q1) / d q1 = J_r(difference)^-1", adjoint_source}, J6_tangent,
    {jacobian6, tangent_coupling},
    {configuration_header, "dDifferenceSE3<S>(q0, q1, ArgumentPosition::ARG1)"}, q0, q1);

inline constexpr auto integrate_coefficient_jacobian = operation<struct IntegrateCoefficientJacobian>(
    {"integrate_coefficient_jacobian",
     "J = d integrate(q, delta) / d delta at delta = 0, of the stored numbers",
     "Sola 2017 (arXiv 1711.02508), eqs. 197-201"},
    J76,
    {{block::translation, "|J_p v - R u|", "|R u|", "m/s"},
     {block::rotation_rate, "|J_Q v - 1/2 Q (omega, 0)|", "|1/2 Q (omega, 0)|", "1/s"},
     {block::R_dot, "|R_dot - R [omega]| with R_dot from Q_dot = J_Q v, Frobenius", "|R [omega]|", "1/s"},
     {block::translation_matrix, "|J_p - R|, Frobenius", "|R|", "1"},
     {block::quaternion_matrix, "|J_Q - 1/2 [Qw I + [Qxyz]; -Qxyz^T]|, Frobenius", "|J_Q exact|", "1"},
     {block::zeros, "0 if the structural zeros are zero, else infinite", "absolute", "1"}},
    {configuration_header, "integrateCoeffWiseJacobianSE3<S>(q)"}, q);

// The whole configuration vector of a robot.
inline constexpr auto robot_integrate = operation<struct RobotIntegrate, true>(
    {"robot_integrate", "q1 = integrate(q0, delta), joint by joint", "Pinocchio 3.8, joint-configuration"},
    robot_q1,
    {rotation_of_quaternion,
     {block::translation, "|p - p_exact| of a free-flyer", "max(|p_exact|, |p0|, |p_exact - p0|)", "m"},
     {block::norm_defect, "| |Q1|^2 - 1 |", "absolute", "1"},
     {block::sign, "max(0, -Q0 . Q1)", "absolute", "1"},
     {block::continuous, "|(cos, sin) - (cos, sin)_exact|", "absolute", "rad"},
     {block::joint, "|q1 - (q0 + delta)|", "|q0 + delta|", "rad or m"}},
    {robot_header, "integrate(model, q0, delta)"}, robot_q0, robot_delta);
inline constexpr auto robot_difference = operation<struct RobotDifference, true>(
    {"robot_difference", "delta = difference(q0, q1), joint by joint", "Pinocchio 3.8, joint-configuration"},
    robot_delta_result,
    {rotation_vector,
     {block::linear, "|rho - rho_exact| of a free-flyer", "max(|rho_exact|, |p1 - p0|)", "m"},
     {block::continuous, "|angle - angle_exact|; either sign at pi", "|angle_exact|", "rad"},
     {block::joint, "|delta - (q1 - q0)|", "|q1 - q0|", "rad or m"}},
    {robot_header, "difference(model, q0, q1)"}, robot_q0, robot_q1);
inline constexpr auto robot_is_same = operation<struct RobotIsSame, true>(
    {"robot_is_same",
     "whether q0 and q1 are the same: yes if Q1 = -Q0; no if a joint differs by more than sqrt(eps) [rad; "
     "relative to max(1, |p|)]",
     "Pinocchio 3.8, joint-configuration"},
    same_result, {{block::same, "0 if the answer is right, else a wrong branch", "absolute", "1"}},
    {robot_header, "isSameConfiguration(model, q0, q1)"}, robot_q0, robot_q1);

// Their derivatives, with the blocks of the free-flyer, and those of all joints with one coordinate.
inline constexpr Block one_coordinate{
    block::joint,
    "largest |J - 1| (by q0 of difference: |J + 1|) of a joint with one coordinate; infinite if "
    "an entry of two joints is not zero",
    "absolute", "1"};
inline constexpr auto robot_d_integrate_arg0 = operation<struct RobotDIntegrateArg0, true>(
    {"robot_d_integrate_arg0", "d integrate(q0, delta) / d q0, joint by joint", adjoint_source},
    robot_derivative, {jacobian6, coupling6, one_coordinate},
    {robot_header, "dIntegrate(model, q0, delta, ArgumentPosition::ARG0)"}, robot_q0, robot_delta);
inline constexpr auto robot_d_integrate_arg1 = operation<struct RobotDIntegrateArg1, true>(
    {"robot_d_integrate_arg1", "d integrate(q0, delta) / d delta, joint by joint", adjoint_source},
    robot_derivative, {jacobian6, coupling6, one_coordinate},
    {robot_header, "dIntegrate(model, q0, delta, ArgumentPosition::ARG1)"}, robot_q0, robot_delta);
inline constexpr auto robot_d_difference_arg0 = operation<struct RobotDDifferenceArg0, true>(
    {"robot_d_difference_arg0", "d difference(q0, q1) / d q0, joint by joint", adjoint_source},
    robot_derivative, {jacobian6, tangent_coupling, one_coordinate},
    {robot_header, "dDifference(model, q0, q1, ArgumentPosition::ARG0)"}, robot_q0, robot_q1);
inline constexpr auto robot_d_difference_arg1 = operation<struct RobotDDifferenceArg1, true>(
    {"robot_d_difference_arg1", "d difference(q0, q1) / d q1, joint by joint", adjoint_source},
    robot_derivative, {jacobian6, tangent_coupling, one_coordinate},
    {robot_header, "dDifference(model, q0, q1, ArgumentPosition::ARG1)"}, robot_q0, robot_q1);

}  // namespace liecheck::properties::op
