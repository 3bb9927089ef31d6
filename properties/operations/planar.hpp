#pragma once
// Operations on SE(2): poses in the plane, stored as x y, cos sin.

#include <operations/layouts.hpp>

namespace liecheck::properties::op {

inline constexpr std::string_view se2_header = "multibody/se2.hpp",
                                  se2_source = "Sola, Deray & Atchuthan 2018, appendix A";

inline constexpr Value<type::Vector3> planar_delta{
    {"delta", {{"rho", 2, "m"}, {"omega", 1, "rad"}}, "axes of the moving body", "Vector3<S>"}};
inline constexpr Value<type::Vector4> planar_q0{
    {"q0", {{"p0", 2, "m"}, {"r0", 2, "1"}}, "parent axes; r = (cos, sin)", "Vector4<S>"}},
    planar_q1{{"q1", {{"p1", 2, "m"}, {"r1", 2, "1"}}, "parent axes; r = (cos, sin)", "Vector4<S>"}};
inline constexpr Value<type::Vector4> planar_q_result{
    {"q", {{"p", 2, "m"}, {"r", 2, "1"}}, "parent axes; r = (cos, sin)"}};
inline constexpr Value<type::Vector3> planar_delta_result{
    {"delta", {{"rho", 2, "m"}, {"omega", 1, "rad"}}, "axes of the first body; omega in [-pi, pi]"}};

inline constexpr Block planar_rotation{block::rotation, "|r/|r| - r_exact|", "absolute", "rad"},
    planar_norm{block::norm_defect, "| |r|^2 - 1 |", "absolute", "1"},
    planar_angle{block::angle, "|omega - omega_exact|; either sign at pi", "|omega_exact|", "rad"};

inline constexpr auto se2_exp = operation<struct Se2Exp>(
    {"se2_exp", "q = (V(omega) rho, cos omega, sin omega), V = [s, c - 1; 1 - c, s] / omega", se2_source},
    planar_q_result, {planar_rotation, {block::translation, "|p - p_exact|", "|p_exact|", "m"}, planar_norm},
    {se2_header, "se2::exp<S>(delta)"}, planar_delta);
inline constexpr auto se2_log = operation<struct Se2Log>(
    {"se2_log", "delta with exp(delta) = q1, |omega| <= pi", se2_source}, planar_delta_result,
    {planar_angle, {block::linear, "|rho - rho_exact|", "|rho_exact|", "m"}}, {se2_header, "se2::log<S>(q1)"},
    planar_q1);
inline constexpr auto se2_compose = operation<struct Se2Compose>(
    {"se2_compose", "q = q0 q1: p = p0 + R0 p1, the sum of the angles", se2_source}, planar_q_result,
    {planar_rotation, {block::translation, "|p - p_exact|", "max(|p0|, |p1|)", "m"}, planar_norm},
    {se2_header, "se2::compose<S>(q0, q1)"}, planar_q0, planar_q1);
inline constexpr auto se2_integrate = operation<struct Se2Integrate>(
    {"se2_integrate", "q = q0 exp(delta), the step of a planar joint", se2_source}, planar_q_result,
    {planar_rotation,
     {block::translation, "|p - p_exact|", "max(|p_exact|, |p0|, |p_exact - p0|)", "m"},
     planar_norm},
    {"multibody/joints/planar.hpp", "Planar<S>::integrate(q0, delta)"}, planar_q0, planar_delta);
inline constexpr auto se2_difference = operation<struct Se2Difference>(
    {"se2_difference", "delta = log(q0^-1 q1), of a planar joint", se2_source}, planar_delta_result,
    {planar_angle, {block::linear, "|rho - rho_exact|", "max(|rho_exact|, |p1 - p0|)", "m"}},
    {"multibody/joints/planar.hpp", "Planar<S>::difference(q0, q1)"}, planar_q0, planar_q1);

}  // namespace liecheck::properties::op
