#pragma once
// The operations of poses on points, motions, forces and inertias, and those of a single body.

#include <operations/layouts.hpp>

namespace liecheck::properties::op {

inline constexpr std::string_view se3_header = "spatial/se3.hpp", inertia_header = "spatial/inertia.hpp",
                                  poses_source = "Murray, Li & Sastry 1994, eqs. 2.19-2.22",
                                  motions_source = "Featherstone 2008, table 2.2",
                                  crosses_source = "Featherstone 2008, sections 2.8 and 2.9",
                                  inertias_source = "Featherstone 2008, eqs. 2.62-2.67";

inline constexpr auto compose = operation<struct Compose>(
    {"compose", "X_AC = X_AB X_BC = (R R_Y, R p_Y + p), of the stored numbers", poses_source}, X_result,
    {{block::matrix, "|R - R_exact|, Frobenius", "|R_exact|", "1"},
     {block::translation, "|p - p_exact|", "max(|p_exact|, |p|, |p_Y|)", "m"}},
    {se3_header, "(X * Y).toActionMatrix()"}, X, Y);
inline constexpr auto inverse = operation<struct Inverse>(
    {"inverse", "X_BA = (R^T, -R^T p), of the stored numbers", poses_source}, X_result,
    {{block::matrix, "|R - R_stored^T|, Frobenius", "|R_stored^T|", "1"},
     {block::translation, "|p + R_stored^T p_stored|", "|R_stored^T p_stored|", "m"}},
    {se3_header, "X.inverse().toActionMatrix()"}, X);
inline constexpr auto act_point = operation<struct ActPoint>(
    {"act_point", "x_A = R x_B + p", poses_source}, x_A,
    {{block::point, "|x_A - (R x_B + p)|", "|R x_B + p|", "m"}}, {se3_header, "X.act(p_Y)"}, X, p_Y);
inline constexpr auto rotate_point = operation<struct RotatePoint>(
    {"rotate_point", "x_A = R(Q/|Q|) x_B", "Sola 2017 (arXiv 1711.02508), section 2"}, x_A,
    {{block::point, "|x_A - R(Q/|Q|) x_B|", "|x_B|", "m"}}, {se3_header, "SO3<S>(Q).act(p)"}, Q, p);

inline constexpr Block linear_velocity{block::linear, "|u - u_exact|", "|u_exact|", "m/s"},
    angular_velocity{block::angular, "|omega - omega_exact|", "|omega_exact|", "rad/s"},
    force{block::linear, "|f - f_exact|", "|f_exact|", "N"},
    moment{block::angular, "|n - n_exact|", "|n_exact|", "N m"};

inline constexpr auto act_motion = operation<struct ActMotion>(
    {"act_motion", "V_A = X V_B = (R u + p x R omega, R omega)", motions_source}, V_A,
    {linear_velocity, angular_velocity}, {se3_header, "X.act(V).to_vector()"}, X, V);
inline constexpr auto act_inverse_motion = operation<struct ActInverseMotion>(
    {"act_inverse_motion", "V_B = X^-1 V_A = (R^T (u - p x omega), R^T omega)", motions_source}, V_B,
    {linear_velocity, angular_velocity}, {se3_header, "X.actInv(V).to_vector()"}, X, V);
inline constexpr auto act_force =
    operation<struct ActForce>({"act_force", "F_A = X^-T F_B = (R f, R n + p x R f)", motions_source}, F_A,
                               {force, moment}, {se3_header, "X.act(F).to_vector()"}, X, F);
inline constexpr auto act_inverse_force = operation<struct ActInverseForce>(
    {"act_inverse_force", "F_B = X^T F_A = (R^T f, R^T (n - p x f))", motions_source}, F_B, {force, moment},
    {se3_header, "X.actInv(F).to_vector()"}, X, F);
inline constexpr auto cross_motion = operation<struct CrossMotion>(
    {"cross_motion", "ad_V W = (omega x u_W + u x omega_W, omega x omega_W)", crosses_source}, bracket,
    {{block::linear, "|l - l_exact|", "|l_exact|", "m/s^2"},
     {block::angular, "|a - a_exact|", "|a_exact|", "rad/s^2"}},
    {se3_header, "V.cross(W).to_vector()"}, V, W);
inline constexpr auto cross_force = operation<struct CrossForce>(
    {"cross_force", "ad_V* F = -ad_V^T F = (omega x f, omega x n + u x f)", crosses_source}, dual_bracket,
    {{block::linear, "|l - l_exact|", "|l_exact|", "N/s"},
     {block::angular, "|a - a_exact|", "|a_exact|", "N m/s"}},
    {se3_header, "V.cross(F).to_vector()"}, V, F);

/// The law power_pairing forms this quantity from act_motion and act_force.
inline constexpr Operation power = formed(
    {"power", "F_A^T V_A = F_B^T V_B", "Featherstone 2008, eq. 2.7"}, power_result,
    {{block::power, "|F_A^T V_A - F_B^T V_B|", "|f| (|u| + |p| |omega|) + (|n| + |p| |f|) |omega|", "W"}},
    {se3_header, "X.act(F).to_vector().dot(X.act(V).to_vector()) - F.to_vector().dot(V.to_vector())"}, X, V,
    F);

inline constexpr Block body_mass{block::mass, "|m - m_exact|", "m_exact", "kg"},
    body_lever{block::lever, "|c - c_exact|", "|c_exact|", "m"},
    body_inertia{block::inertia, "|I_C - I_C exact|, Frobenius", "|I_C exact|", "kg m^2"};

inline constexpr auto act_inertia = operation<struct ActInertia>(
    {"act_inertia", "I_A = X^-T I_B X^-1: (m, R c + p, R I_C R^T)", inertias_source}, I_A,
    {body_mass, body_lever, body_inertia}, {inertia_header, "X.act(I).matrix()"}, X, I);
inline constexpr auto act_inverse_inertia = operation<struct ActInverseInertia>(
    {"act_inverse_inertia", "I_B = X^T I_A X: (m, R^T (c - p), R^T I_C R)", inertias_source}, I_B,
    {body_mass, body_lever, body_inertia}, {inertia_header, "X.actInv(I).matrix()"}, X, I);
inline constexpr auto momentum = operation<struct Momentum>(
    {"momentum", "h = I V = (m (u + omega x c), I_C omega + c x m (u + omega x c))", inertias_source}, h,
    {{block::linear, "|l - l_exact|", "|l_exact|", "kg m/s"},
     {block::angular, "|k - k_exact|", "|k_exact|", "kg m^2/s"}},
    {inertia_header, "(I * V).to_vector()"}, I, V);
inline constexpr auto kinetic_energy = operation<struct KineticEnergyOfABody>(
    {"kinetic_energy", "T = 1/2 V^T I V", inertias_source}, kinetic,
    {{block::energy, "|T - T_exact|", "T_exact", "J"}}, {inertia_header, "I.kineticEnergy(V)"}, I, V);
inline constexpr auto inertia_matrix = operation<struct InertiaMatrix>(
    {"inertia_matrix", "M = [[m 1, -m [c]], [m [c], I_C + m (|c|^2 1 - c c^T)]]", inertias_source}, I_O,
    {{block::matrix, "|M - M_exact| of the 3 x 3 block with the largest error, Frobenius",
      "|M_exact| of that block", "kg, kg m, kg m^2"}},
    {inertia_header, "I.matrix()"}, I);

/// The law kinetic_energy forms this quantity from kinetic_energy, act_inertia and act_motion.
inline constexpr Operation energy_frames = formed(
    {"energy_frames", "T of (X I, X V) = T of (I, V)", inertias_source}, kinetic,
    {{block::energy, "|T_A - T_B|", "m s^2 + |I_C| |omega|^2 / 2, s = |u| + |omega| (|c| + 2 |p|)", "J"}},
    {inertia_header, "X.act(I).kineticEnergy(X.act(V)) - I.kineticEnergy(V)"}, X, I, V);

}  // namespace liecheck::properties::op
