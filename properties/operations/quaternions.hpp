#pragma once
// Normalisation, and the operations that take a quaternion of any norm. The operations on rotations and
// configurations in the other files take a quaternion whose norm is 1 up to 8 eps. Those named ..._any_norm take
// every finite Q != 0 as the rotation of Q/|Q|: a library offers them if it promises that.

#include <operations/configurations.hpp>
#include <operations/exponentials.hpp>
#include <operations/spatial.hpp>

namespace liecheck::properties::op {

inline constexpr std::string_view so3_header = "spatial/so3.hpp",
                                  quaternion_source = "Sola 2017 (arXiv 1711.02508), section 2";

inline constexpr auto normalize =
    operation<struct Normalize>({"normalize", "Q/|Q| of any finite Q != 0", quaternion_source}, unit_result,
                                {{block::quaternion, "|Q_n - Q/|Q||", "absolute", "1"}, norm_of_quaternion},
                                {so3_header, "SO3<S>(Q).normalized().to_vector()"}, Q);
inline constexpr auto first_order_normalize = operation<struct FirstOrderNormalize>(
    {"first_order_normalize", "Q (3 - |Q|^2) / 2, one Newton step to Q/|Q|, for ||Q|^2 - 1| <= 1/2",
     "Higham 2008, eq. 8.20 (Newton-Schulz)"},
    unit_result, {{block::quaternion, "|Q_n - Q (3 - |Q|^2) / 2|", "|Q (3 - |Q|^2) / 2|", "1"}},
    {so3_header, "SO3<S>(Q).firstOrderNormalized().to_vector()"}, Q);
inline constexpr auto matrix_from_quaternion_any_norm = operation<struct MatrixFromQuaternionAnyNorm>(
    {"matrix_from_quaternion_any_norm", "R(Q/|Q|) of any finite Q != 0", quaternion_source}, R_result,
    {{block::entry, "largest |R - R_exact| of an entry", "absolute", "1"}},
    {so3_header, "SO3<S>(Q).matrix()"}, Q);
inline constexpr auto rotate_point_any_norm = operation<struct RotatePointAnyNorm>(
    {"rotate_point_any_norm", "x_A = R(Q/|Q|) x_B of any finite Q != 0", quaternion_source}, x_A,
    {{block::point, "|x_A - R(Q/|Q|) x_B|", "|x_B|", "m"}}, {so3_header, "SO3<S>(Q).act(p)"}, Q, p);
inline constexpr auto log3_any_norm = operation<struct Log3AnyNorm>(
    {"log3_any_norm", "phi of Q/|Q|, |phi| <= pi, of any finite Q != 0", log3_quaternion.source}, phi_result,
    {rotation_vector}, log3_quaternion.call, Q);
inline constexpr auto integrate_any_norm = operation<struct IntegrateAnyNorm>(
    {"integrate_any_norm", "q1 = T0 exp(delta), |Q1| = 1, of any finite Q0 != 0", plus_source}, q1_result,
    {rotation_of_quaternion,
     {block::translation, "|p - p_exact|", "max(|p_exact|, |p0|, |p_exact - p0|)", "m"},
     {block::norm_defect, "| |Q1|^2 - 1 |", "absolute", "1"},
     {block::sign, "max(0, -Q0 . Q1)", "|Q0|", "1"}},
    integrate.call, q0, delta);
inline constexpr auto difference_any_norm = operation<struct DifferenceAnyNorm>(
    {"difference_any_norm", "delta = log(T0^-1 T1) of any finite Q0, Q1 != 0", plus_source}, delta_result,
    {rotation_vector, {block::linear, "|rho - rho_exact|", "max(|rho_exact|, |p1 - p0|)", "m"}},
    difference.call, q0, q1);
inline constexpr auto d_difference_any_norm = operation<struct DDifferenceAnyNorm>(
    {"d_difference_any_norm", "d difference(q0, q1) / d q1 = J_r(difference)^-1 of any finite Q0, Q1 != 0",
     adjoint_source},
    J6_tangent, {jacobian6, tangent_coupling}, d_difference_arg1.call, q0, q1);

}  // namespace liecheck::properties::op
