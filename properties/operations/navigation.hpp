#pragma once
// Inertial navigation: extended poses of SE_2(3), which have a position and a velocity, and the preintegration of inertial
// measurements, as Forster et al. and as Brossard et al. define it.

#include <operations/exponentials.hpp>

namespace liecheck::properties::op {

inline constexpr std::string_view extended_header = "spatial/extended_pose.hpp",
                                  preintegration_header = "spatial/preintegration.hpp",
                                  brossard_source =
                                      "Brossard et al. 2022, Associating uncertainty to extended poses",
                                  forster_source = "Forster et al. 2017, On-manifold preintegration";

namespace parts {
inline constexpr Few<Part, 4> extended{{"R", 9, "1"}, {"p", 3, "m"}, {"v", 3, "m/s"}};
}
inline constexpr Value<type::ExtendedPose> extended_X{{"X", parts::extended, "from B to A", "ExtendedPose<S>"}},
    extended_result{{"X", parts::extended, "parent axes"}};
inline constexpr Value<type::Vector9> extended_xi{
    {"xi", {{"rho", 3, "m"}, {"nu", 3, "m/s"}, {"phi", 3, "rad"}}, "body axes", "Vector9<S>"}},
    extended_log_result{{"xi", {{"rho", 3, "m"}, {"nu", 3, "m/s"}, {"phi", 3, "rad"}}, "body axes"}};
inline constexpr Value<type::Matrix9> J9{{"J", {{"J", 81, "1, m, m/s"}}, "position, velocity, rotation"}};

inline constexpr Block velocity_of_pose{block::velocity, "|v - v_exact|", "|v_exact|", "m/s"};
inline constexpr auto se23_exp = operation<struct Se23Exp>(
    {"se23_exp", "X = (exp [phi], J_l(phi) rho, J_l(phi) nu), |phi| <= pi", brossard_source}, extended_result,
    {rotation_of_matrix,
     orthogonality_of_matrix,
     {block::translation, "|p - p_exact|", "|p_exact|", "m"},
     velocity_of_pose},
    {extended_header, "exp9<S>(xi).to_vector()"}, extended_xi);
inline constexpr auto se23_log = operation<struct Se23Log>(
    {"se23_log", "(rho, nu, phi) with exp(rho, nu, phi) = X, |phi| <= pi", brossard_source},
    extended_log_result,
    {rotation_vector,
     {block::linear, "|rho - rho_exact|", "|rho_exact|", "m"},
     {block::velocity, "|nu - nu_exact|", "|nu_exact|", "m/s"}},
    {extended_header, "log9<S>(X)"}, extended_X);
inline constexpr Block jacobian9{
    block::jacobian,
    "largest |J - J_exact| of the three 3 x 3 diagonal blocks, Frobenius; infinite if a zero is not zero",
    "|J_exact|", "1"},
    coupling9{block::coupling, "larger |C - C_exact| / |C_exact| of the blocks by rho and by nu, Frobenius",
              "absolute", "1"};
inline constexpr auto se23_left_jacobian = operation<struct Se23LeftJacobian>(
    {"se23_left_jacobian", "[[J, 0, C(rho)], [0, J, C(nu)], [0, 0, J]], J = J_l(phi), |phi| <= pi",
     brossard_source},
    J9, {jacobian9, coupling9}, {extended_header, "leftJacobian<S>(xi)"}, extended_xi);
inline constexpr auto se23_right_jacobian = operation<struct Se23RightJacobian>(
    {"se23_right_jacobian", "J_r(xi) = J_l(-xi), |phi| <= pi", brossard_source}, J9, {jacobian9, coupling9},
    {extended_header, "rightJacobian<S>(xi)"}, extended_xi);
inline constexpr auto se23_adjoint = operation<struct Se23Adjoint>(
    {"se23_adjoint", "[[R, 0, [p] R], [0, R, [v] R], [0, 0, R]]", brossard_source}, J9,
    {jacobian9, coupling9}, {extended_header, "adjoint<S>(X)"}, extended_X);

// Three measurements, each held for the time dt.
inline constexpr Value<type::Vector9> gyro{
    {"gyro", {{"gyro", 9, "rad/s"}}, "body axes, one after the other"}},
    accelerometer{{"accelerometer", {{"accelerometer", 9, "m/s^2"}}, "body axes, one after the other"}};
inline constexpr Value<type::Scalar> dt{{"dt", {{"dt", 1, "s"}}, "of each measurement"}};
inline constexpr Value<type::ExtendedPose> increment_result{
    {"(dR, dp, dv)", {{"dR", 9, "1"}, {"dp", 3, "m"}, {"dv", 3, "m/s"}}, "axes of the first body"}};
inline constexpr Value<type::Numbers<15, 3>> bias_jacobian_result{
    {"D",
     {{"dR by b_g", 9, "s"}, {"dp by b_g, b_a", 18, "m s, s^2"}, {"dv by b_g, b_a", 18, "m, s"}},
     "dR in axes of the last body"}};

inline constexpr Block increment_translation{block::translation, "|dp - dp_exact|", "sum_i |a_i| dt^2", "m"},
    increment_velocity{block::velocity, "|dv - dv_exact|", "sum_i |a_i| dt", "m/s"};
inline constexpr Block rotation_by_bias{block::rotation, "|D - D_exact| of d dR / d b_g, Frobenius",
                                        "|D_exact|", "s"},
    position_by_bias{
        block::translation,
        "larger |D - D_exact| of d dp by the biases, Frobenius, over sum_i |a_i| dt^3 and by b_a dt^2",
        "absolute", "1"},
    velocity_by_bias{
        block::velocity,
        "larger |D - D_exact| of d dv by the biases, Frobenius, over sum_i |a_i| dt^2 and by b_a dt",
        "absolute", "1"};
inline constexpr auto preintegrate_forster = operation<struct PreintegrateForster>(
    {"preintegrate_forster",
     "dp += dv dt + 1/2 dR a dt^2, dv += dR a dt, dR <- dR exp(omega dt), of three measurements",
     forster_source},
    increment_result,
    {rotation_of_matrix, orthogonality_of_matrix, increment_translation, increment_velocity},
    {preintegration_header, "preintegratedForster<S, 3>(gyro, accelerometer, dt).increment()"}, gyro,
    accelerometer, dt);
inline constexpr auto preintegrate_brossard = operation<struct PreintegrateBrossard>(
    {"preintegrate_brossard",
     "the exact motion of constant omega and a in body axes: dv += dR J_l(omega dt) a dt, and its integral",
     brossard_source},
    increment_result,
    {rotation_of_matrix, orthogonality_of_matrix, increment_translation, increment_velocity},
    {preintegration_header, "preintegratedBrossard<S, 3>(gyro, accelerometer, dt).increment()"}, gyro,
    accelerometer, dt);
inline constexpr auto forster_bias_jacobians = operation<struct ForsterBiasJacobians>(
    {"forster_bias_jacobians",
     "derivatives of preintegrate_forster by the biases of omega - b_g and a - b_a, at zero; of dR on the "
     "right",
     forster_source},
    bias_jacobian_result, {rotation_by_bias, position_by_bias, velocity_by_bias},
    {preintegration_header, "preintegratedForster<S, 3>(gyro, accelerometer, dt).by_biases()"}, gyro,
    accelerometer, dt);
inline constexpr auto brossard_bias_jacobians = operation<struct BrossardBiasJacobians>(
    {"brossard_bias_jacobians",
     "derivatives of preintegrate_brossard by the biases of omega - b_g and a - b_a, at zero; of dR on the "
     "right",
     brossard_source},
    bias_jacobian_result, {rotation_by_bias, position_by_bias, velocity_by_bias},
    {preintegration_header, "preintegratedBrossard<S, 3>(gyro, accelerometer, dt).by_biases()"}, gyro,
    accelerometer, dt);

}  // namespace liecheck::properties::op
