#pragma once
// Exponentials and logarithms of rotations and poses, and the Jacobians of exp.

#include <operations/layouts.hpp>

namespace liecheck::properties::op {

inline constexpr std::string_view exp_log_header = "spatial/exp_log.hpp",
                                  jacobians_header = "spatial/jacobians.hpp";

inline constexpr auto exp3_quaternion = operation<struct Exp3Quaternion>(
    {"exp3_quaternion", "Q = (sin(theta/2) n, cos(theta/2)) of phi = theta n",
     "Murray, Li & Sastry 1994, section 2.3"},
    Q_result,
    {rotation_of_quaternion,
     norm_of_quaternion,
     {block::jump, "|(Q+ - Q+_exact) - (Q- - Q-_exact)| over adjacent inputs", "|Q_exact|", "1"}},
    {exp_log_header, "quaternion::exp3<S>(phi).to_vector()"}, phi);

inline constexpr auto exp3_matrix = operation<struct Exp3Matrix>(
    {"exp3_matrix", "R = exp [phi]", "Murray, Li & Sastry 1994, eq. 2.14"}, R_result,
    {rotation_of_matrix, orthogonality_of_matrix}, {exp_log_header, "exp3<S>(phi)"}, phi);

inline constexpr auto log3_quaternion = operation<struct Log3Quaternion>(
    {"log3_quaternion", "phi of Q/|Q|, |phi| <= pi", "Sola, Deray & Atchuthan 2018, appendix B"}, phi_result,
    {rotation_vector}, {exp_log_header, "quaternion::log3<S>(SO3<S>(Q))"}, Q);

inline constexpr auto log3_matrix = operation<struct Log3Matrix>(
    {"log3_matrix", "phi of the rotation nearest to R, |phi| <= pi", "Murray, Li & Sastry 1994, section 2.2"},
    phi_result, {rotation_vector}, {exp_log_header, "log3<S>(R)"}, R);

inline constexpr auto exp6 = operation<struct Exp6>(
    {"exp6", "T = exp(rho, phi)", "Murray, Li & Sastry 1994, eq. 2.36"}, T_result,
    {rotation_of_matrix,
     orthogonality_of_matrix,
     {block::translation, "|p - p_exact|", "|p_exact|", "m"},
     {block::jump, "|(p+ - p+_exact) - (p- - p-_exact)| over adjacent inputs", "|p_exact|", "m"}},
    {exp_log_header, "exp6<S>(Motion<S>(xi)).toActionMatrix()"}, xi);

inline constexpr auto log6 = operation<struct Log6>(
    {"log6", "(rho, phi) = log(R, p), |phi| <= pi", "Murray, Li & Sastry 1994, section 2.3"}, log_result,
    {rotation_vector, {block::linear, "|rho - rho_exact|", "|rho_exact|", "m"}},
    {exp_log_header, "log6<S>(X).to_vector()"}, X);

/// The error of a 3 x 3 Jacobian, and its jump.
inline constexpr Block jacobian3{block::jacobian, "|J - J_exact|, Frobenius", "|J_exact|", "1"};
inline constexpr Block jacobian3_jump{
    block::jump, "|(J+ - J+_exact) - (J- - J-_exact)| over adjacent inputs, Frobenius", "|J_exact|", "1"};
inline constexpr Block coupling6_jump{
    block::jump,
    "|(C+ - C+_exact) - (C- - C-_exact)| of the upper right block over adjacent inputs, Frobenius",
    "|C_exact|", "m"};

inline constexpr std::string_view jacobians3_source = "Sola, Deray & Atchuthan 2018, eqs. 143-146",
                                  jacobians6_source = "Sola, Deray & Atchuthan 2018, eqs. 179-180";

inline constexpr auto left_jacobian3 = operation<struct LeftJacobian3>(
    {"left_jacobian3", "J_l(phi) = c1 I + c2 [phi] + c3 phi phi^T", jacobians3_source}, J3_left,
    {jacobian3, jacobian3_jump}, {jacobians_header, "leftJacobian<S>(phi)"}, phi);
inline constexpr auto right_jacobian3 =
    operation<struct RightJacobian3>({"right_jacobian3", "J_r(phi) = J_l(-phi)", jacobians3_source}, J3_right,
                                     {jacobian3}, {jacobians_header, "rightJacobian<S>(phi)"}, phi);
inline constexpr auto left_jacobian3_inverse = operation<struct LeftJacobian3Inverse>(
    {"left_jacobian3_inverse", "J_l(phi)^-1", jacobians3_source}, J3_left, {jacobian3, jacobian3_jump},
    {jacobians_header, "leftJacobianInverse<S>(phi)"}, phi);
inline constexpr auto right_jacobian3_inverse = operation<struct RightJacobian3Inverse>(
    {"right_jacobian3_inverse", "J_r(phi)^-1", jacobians3_source}, J3_right, {jacobian3},
    {jacobians_header, "rightJacobianInverse<S>(phi)"}, phi);
inline constexpr auto left_jacobian6 = operation<struct LeftJacobian6>(
    {"left_jacobian6", "J_l(rho, phi) = [[J_l(phi), C(rho, phi)], [0, J_l(phi)]]", jacobians6_source},
    J6_left, {jacobian6, coupling6}, {jacobians_header, "leftJacobian<S>(Motion<S>(xi))"}, xi);
inline constexpr auto right_jacobian6 = operation<struct RightJacobian6>(
    {"right_jacobian6", "J_r(rho, phi) = J_l(-rho, -phi)", jacobians6_source}, J6_right,
    {jacobian6, coupling6, coupling6_jump}, {jacobians_header, "rightJacobian<S>(Motion<S>(xi))"}, xi);
inline constexpr auto left_jacobian6_inverse = operation<struct LeftJacobian6Inverse>(
    {"left_jacobian6_inverse", "J_l(rho, phi)^-1", jacobians6_source}, J6_left, {jacobian6, coupling6},
    {jacobians_header, "leftJacobianInverse<S>(Motion<S>(xi))"}, xi);
inline constexpr auto right_jacobian6_inverse = operation<struct RightJacobian6Inverse>(
    {"right_jacobian6_inverse", "J_r(rho, phi)^-1", jacobians6_source}, J6_right,
    {jacobian6, coupling6, coupling6_jump}, {jacobians_header, "rightJacobianInverse<S>(Motion<S>(xi))"}, xi);

}  // namespace liecheck::properties::op
