#pragma once
// What follows from a pose or a twist: adjoint matrices, a transported covariance, the screw; means of rotations and
// poses, and what lies between two poses or two directions.

#include <operations/configurations.hpp>
#include <operations/representations.hpp>
#include <operations/spatial.hpp>

namespace liecheck::properties::op {

inline constexpr std::string_view motion_header = "spatial/motion.hpp",
                                  transforms_header = "spatial/transforms.hpp",
                                  means_header = "multibody/means.hpp",
                                  transform_source = "Featherstone 2008, eqs. 2.24-2.28",
                                  mean_source = "Pennec & Arsigny 2013, Exponential barycenters";

inline constexpr Value<type::Matrix6> Sigma{
    {"Sigma", {{"Sigma", 36, "m^2, m rad, rad^2"}}, "of increments in axes of B"}};
inline constexpr Value<type::Vector4> Q2{{"Q2", {{"Q2", 4, "1"}}, "from B to A"}};
inline constexpr Value<type::Vector7> q2{
    {"q2", {{"p2", 3, "m"}, {"Q2", 4, "1"}}, "parent axes", "Vector7<S>"}};
inline constexpr Value<type::Vector3> weights{{"weights", {{"weights", 3, "1"}}, "positive, of any sum"}};

inline constexpr Value<type::Matrix6> Ad{{"Ad", {{"Ad", 36, "1, m"}}, "motions of B to motions of A"}},
    coAd{{"coAd", {{"coAd", 36, "1, m"}}, "forces of B to forces of A"}},
    ad{{"ad", {{"ad", 36, "1/s, m/s"}}, "B"}},
    Sigma_A{{"Sigma_A", {{"Sigma_A", 36, "m^2, m rad, rad^2"}}, "of increments in axes of A"}};
inline constexpr Value<type::Vector7> screw_result{
    {"(axis, pitch, point)", {{"axis", 3, "1"}, {"pitch", 1, "m/rad"}, {"point", 3, "m"}}, "B"}},
    q_between{{"q", {{"p", 3, "m"}, {"Q", 4, "1"}}, "parent axes"}};
inline constexpr Value<type::Vector4> Q_mean{{"Q", {{"Q", 4, "1"}}, "from B to A, as Q0; either sign"}};
inline constexpr Value<type::Vector3> direction_between{{"x", {{"x", 3, "1"}}, "A"}};

inline constexpr Block rotation_blocks{block::jacobian,
                                       "larger |R - R_exact| of the two 3 x 3 diagonal blocks, Frobenius; "
                                       "infinite if the zero block is not zero",
                                       "|R_exact|", "1"};
inline constexpr Block lever_block{block::coupling, "|C - C_exact| of the fourth 3 x 3 block, Frobenius",
                                   "|C_exact|", "m"};

inline constexpr auto adjoint =
    operation<struct Adjoint>({"adjoint", "Ad = [[R, [p] R], [0, R]]: V_A = Ad V_B", transform_source}, Ad,
                              {rotation_blocks, lever_block}, {se3_header, "X.toActionMatrix()"}, X);
inline constexpr auto coadjoint = operation<struct Coadjoint>(
    {"coadjoint", "Ad^-T = [[R, 0], [[p] R, R]]: F_A = Ad^-T F_B", transform_source}, coAd,
    {rotation_blocks, lever_block}, {se3_header, "X.toDualActionMatrix()"}, X);
inline constexpr auto small_adjoint = operation<struct SmallAdjoint>(
    {"small_adjoint", "ad_V = [[[omega], [u]], [0, [omega]]]: ad_V W = V x W", "Featherstone 2008, eq. 2.31"},
    ad, {rotation_blocks, lever_block}, {motion_header, "V.toActionMatrix()"}, V);
inline constexpr auto transport_covariance = operation<struct TransportCovariance>(
    {"transport_covariance", "Sigma_A = Ad Sigma Ad^T of a symmetric positive Sigma",
     "Barfoot & Furgale 2014, eq. 40"},
    Sigma_A,
    {{block::matrix,
      "|(Sigma_A - exact)_kl / (s_k s_l)|, Frobenius; s^2 = |S_ll| + 2 |p| |S_la| + |p|^2 |S_aa| of linear "
      "numbers, |S_aa| of angular ones",
      "absolute", "1"},
     {block::symmetry, "|(Sigma_A - Sigma_A^T)_kl / (s_k s_l)|, Frobenius", "absolute", "1"}},
    {transforms_header, "transported<S>(X, Sigma)"}, X, Sigma);
inline constexpr auto screw_parameters =
    operation<struct ScrewParameters>({"screw_parameters",
                                       "axis omega/|omega|, pitch u . omega/|omega|^2, point omega x "
                                       "u/|omega|^2 nearest to the origin, omega != 0",
                                       "Murray, Li & Sastry 1994, section 2.3.3"},
                                      screw_result,
                                      {{block::direction, "|axis - axis_exact|", "absolute", "1"},
                                       {block::pitch, "|pitch - pitch_exact|", "|u|/|omega|", "m/rad"},
                                       {block::point, "|point - point_exact|", "|u|/|omega|", "m"}},
                                      {transforms_header, "screwOf<S>(V).to_vector()"}, V);

inline constexpr auto mean_rotation = operation<struct MeanRotation>(
    {"mean_rotation", "the Q that maximises sum_i w_i (Q . Q_i)^2: the chordal mean",
     "Markley et al. 2007, Averaging quaternions, eq. 12"},
    Q_mean, {rotation_of_quaternion, norm_of_quaternion},
    {means_header, "chordalMean<S, 3>({SO3<S>(Q0), SO3<S>(Q1), SO3<S>(Q2)}, weights).to_vector()"}, Q0, Q1, Q2, weights);
inline constexpr auto geodesic_mean = operation<struct GeodesicMean>(
    {"geodesic_mean", "Q with sum_i w_i log(Q* Q_i) = 0, of rotations within 2 rad of one another",
     "Moakher 2002, eq. 3.16"},
    Q_mean, {rotation_of_quaternion, norm_of_quaternion},
    {means_header, "geodesicMean<S, 3>({SO3<S>(Q0), SO3<S>(Q1), SO3<S>(Q2)}, weights).to_vector()"}, Q0, Q1, Q2, weights);
inline constexpr Block translation_of_mean{block::translation, "|p - p_exact|",
                                           "max(|p_exact|, |p0|, |p1|, |p2|)", "m"};
inline constexpr auto mean_pose = operation<struct MeanPose>(
    {"mean_pose", "T with sum_i w_i log(T^-1 T_i) = 0, of rotations within 2 rad of one another",
     mean_source},
    q_between, {rotation_of_quaternion, translation_of_mean, norm_of_quaternion},
    {means_header, "meanPose<S, 3>({q0, q1, q2}, weights)"}, q0, q1, q2, weights);
inline constexpr auto interpolate = operation<struct Interpolate>(
    {"interpolate", "T0 exp(t log(T0^-1 T1)), 0 <= t <= 1", plus_source}, q_between,
    {{block::rotation, "2 min(|Q/|Q| - Q_exact|, |Q/|Q| + Q_exact|); either arc if the angle is pi",
      "absolute", "rad"},
     {block::translation, "|p - p_exact|", "max(|p_exact|, |p0|, |p1|)", "m"},
     norm_of_quaternion},
    {configuration_header, "interpolateSE3<S>(q0, q1, t)"}, q0, q1, fraction);

inline constexpr auto angle_between = operation<struct AngleBetween>(
    {"angle_between", "theta = atan2(|a x b|, a . b)", "Kahan 2006, How futile are mindless assessments"},
    angle_result,
    {{block::angle, "|theta - theta_exact|", "max(theta_exact, |t|), t_i the sum of the |terms| of (a x b)_i",
      "rad"}},
    {relative_header, "angleBetween<S>(a, b)"}, a, b);
inline constexpr auto slerp_directions = operation<struct SlerpDirections>(
    {"slerp_directions", "(sin((1 - t) theta) a + sin(t theta) b)/sin theta of unit vectors, 0 <= t <= 1",
     "Shoemake 1985, section 3.3"},
    direction_between,
    {{block::direction, "|x/|x| - x_exact|", "absolute", "1"},
     {block::norm_defect, "| |x| - 1 |", "absolute", "1"}},
    {relative_header, "slerp<S>(a, b, t)"}, a, b, fraction);

}  // namespace liecheck::properties::op
