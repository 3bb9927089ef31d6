#pragma once
// Operations between two rotations and between two directions, Euler angles, and the rates of a configuration's
// stored numbers.

#include <operations/layouts.hpp>

namespace liecheck::properties::op {

inline constexpr std::string_view relative_header = "spatial/relative_rotation.hpp",
                                  euler_header = "spatial/euler.hpp",
                                  rate_header = "multibody/coefficient_rate.hpp",
                                  euler_source = "Diebel 2006, sections 5.6 and 8";

inline constexpr Value<type::Vector4> Q0{{"Q0", {{"Q0", 4, "1"}}, "from B to A"}},
    Q1{{"Q1", {{"Q1", 4, "1"}}, "from B to A"}};
inline constexpr Value<type::Vector3> axis{{"axis", {{"axis", 3, "1"}}, "B, of length 1"}},
    a{{"a", {{"a", 3, "1"}}, "A, of length 1"}}, b{{"b", {{"b", 3, "1"}}, "A, of length 1"}};
inline constexpr Value<type::Scalar> fraction{{"t", {{"t", 1, "1"}}, "0 at Q0, 1 at Q1"}};
/// Its number is that of EulerOrder::numbered: docs/conventions.md.
inline constexpr Value<type::Scalar> order{{"order", {{"order", 1, "1"}}, "0 ... 23"}};
inline constexpr Value<type::Vector3> angles{{"angles", {{"angles", 3, "rad"}}, "in the order of the axes"}};
inline constexpr Value<type::Vector7> q_dot{
    {"q_dot", {{"p_dot", 3, "m/s"}, {"Q_dot", 4, "1/s"}}, "parent axes", "Vector7<S>"}};

inline constexpr Value<type::Scalar> angle_result{{"angle", {{"angle", 1, "rad"}}, "[0, pi]"}},
    twist_result{{"angle", {{"angle", 1, "rad"}}, "about `axis`, [-pi, pi]; either sign at pi"}};
inline constexpr Value<type::Vector4> Q_between{{"Q", {{"Q", 4, "1"}}, "from B to A, as Q0 and Q1"}},
    Q_minimal{{"Q", {{"Q", 4, "1"}}, "turns a into b"}}, Q_of_angles{{"Q", {{"Q", 4, "1"}}, "from B to A"}};
inline constexpr Value<type::Matrix3> R_of_angles{{"R", {{"R", 9, "1"}}, "from B to A"}};
inline constexpr Value<type::Vector3> angles_result{
    {"angles", {{"angles", 3, "rad"}}, "in the order of the axes; a, c in [-pi, pi]"}};
inline constexpr Value<type::Vector7> q_dot_result{
    {"q_dot", {{"p_dot", 3, "m/s"}, {"Q_dot", 4, "1/s"}}, "parent axes"}};

inline constexpr auto relative_angle =
    operation<struct RelativeAngle>({"relative_angle", "theta = 2 atan2(|v|, |w|) of (v, w) = Q0* Q1",
                                     "Sola 2017 (arXiv 1711.02508), eq. 78"},
                                    angle_result,
                                    {{block::angle, "|theta - theta_exact|",
                                      "max(theta_exact, 2 |t|), t_i the sum of the |terms| of v_i", "rad"}},
                                    {relative_header, "relativeAngle<S>(SO3<S>(Q0), SO3<S>(Q1))"}, Q0, Q1);
inline constexpr auto twist_angle = operation<struct TwistAngle>(
    {"twist_angle", "2 atan2(v . axis, w) of Q = (v, w), brought to [-pi, pi]", "Dobrowolski 2015, eq. 18"},
    twist_result,
    {{block::angle, "|angle - angle_exact|; either sign at pi",
      "max(|angle_exact|, 2 |w| (|s| + sum_i |v_i axis_i|) / (w^2 + s^2)), s = v . axis", "rad"}},
    {relative_header, "twistAngle<S>(SO3<S>(Q), axis)"}, Q, axis);
inline constexpr auto slerp = operation<struct Slerp>(
    {"slerp", "Q0 (Q0* Q1)^t along the shorter arc, 0 <= t <= 1", "Shoemake 1985, section 3.3"}, Q_between,
    {{block::rotation, "2 min(|Q/|Q| - Q_exact|, |Q/|Q| + Q_exact|); either arc if the angle is pi",
      "absolute", "rad"},
     norm_of_quaternion},
    {relative_header, "slerp<S>(SO3<S>(Q0), SO3<S>(Q1), t).to_vector()"}, Q0, Q1, fraction);
inline constexpr auto rotation_between = operation<struct RotationBetween>(
    {"rotation_between",
     "the smallest rotation with R a = b; by pi about any axis perpendicular to a if b = -a",
     "Sola 2017 (arXiv 1711.02508), eqs. 99-101"},
    Q_minimal,
    {{block::direction, "|R(Q) a/|a| - b/|b||", "absolute", "1"},
     {block::twist, "2 |Qxyz . a| / |a|", "absolute", "rad"},
     norm_of_quaternion},
    {relative_header, "rotationBetween<S>(a, b).to_vector()"}, a, b);

/// The rotation that the angles give back, and whether they are in their ranges.
inline constexpr Block rotation_of_angles{
    block::rotation, "angle from the exact rotation to that of the angles", "absolute", "rad"};
inline constexpr Block range_of_angles{
    block::range,
    "how far a, c are beyond [-pi, pi], b beyond [-pi/2, pi/2] or, if i = k, [0, pi]; 0 up to 2 pi eps",
    "absolute", "rad"};
inline constexpr auto euler_to_quaternion = operation<struct EulerToQuaternion>(
    {"euler_to_quaternion", "R(Q) = R_i(a) R_j(b) R_k(c), or R_k(c) R_j(b) R_i(a) of static axes",
     euler_source},
    Q_of_angles, {rotation_of_quaternion, norm_of_quaternion},
    {euler_header, "eulerToQuaternion<S>(EulerOrder::numbered(int(order)), angles).to_vector()"}, order,
    angles);
inline constexpr auto euler_to_matrix = operation<struct EulerToMatrix>(
    {"euler_to_matrix", "R_i(a) R_j(b) R_k(c), or R_k(c) R_j(b) R_i(a) of static axes", euler_source},
    R_of_angles, {rotation_of_matrix, orthogonality_of_matrix},
    {euler_header, "eulerToMatrix<S>(EulerOrder::numbered(int(order)), angles)"}, order, angles);
inline constexpr auto euler_from_quaternion = operation<struct EulerFromQuaternion>(
    {"euler_from_quaternion", "angles with R(angles) = R(Q/|Q|)", euler_source}, angles_result,
    {rotation_of_angles, range_of_angles},
    {euler_header, "eulerFromQuaternion<S>(EulerOrder::numbered(int(order)), SO3<S>(Q))"}, order, Q);
inline constexpr auto euler_from_matrix = operation<struct EulerFromMatrix>(
    {"euler_from_matrix", "angles of the rotation nearest to R", euler_source}, angles_result,
    {rotation_of_angles, range_of_angles},
    {euler_header, "eulerFromMatrix<S>(EulerOrder::numbered(int(order)), R)"}, order, R);

inline constexpr std::string_view rate_source = "Sola 2017 (arXiv 1711.02508), eqs. 197-201";
inline constexpr auto velocity_to_rate = operation<struct VelocityToRate>(
    {"velocity_to_rate", "q_dot = N(q) V: p_dot = R(Q/|Q|) u, Q_dot = 1/2 Q (omega, 0)", rate_source},
    q_dot_result,
    {{block::translation, "|p_dot - p_dot_exact|", "|u|", "m/s"},
     {block::rotation_rate, "|Q_dot - Q_dot_exact|", "|Q_dot_exact|", "1/s"}},
    {rate_header, "coefficientRate<S>(q, V)"}, q, V);
inline constexpr auto rate_to_velocity = operation<struct RateToVelocity>(
    {"rate_to_velocity", "V = N(q)^+ q_dot: u = R(Q/|Q|)^T p_dot, omega = 2 (Q* Q_dot)_xyz / |Q|^2",
     rate_source},
    V_B,
    {{block::linear, "|u - u_exact|", "|p_dot|", "m/s"},
     {block::angular, "|omega - omega_exact|", "2 |Q_dot| / |Q|", "rad/s"}},
    {rate_header, "velocityOfCoefficientRate<S>(q, q_dot).to_vector()"}, q, q_dot);

}  // namespace liecheck::properties::op
