#pragma once
// This file defines the names of blocks, the arguments and results of operations with their parts, units and
// axes, and the blocks that several operations share. An operation takes those fields of a law's input that
// have the names of its parts.

#include <operations/operation.hpp>

namespace liecheck::properties {

namespace block {
inline constexpr BlockName rotation{"rotation"}, norm_defect{"norm defect"},
    orthogonality_defect{"orthogonality defect"}, rotation_vector{"rotation vector"},
    translation{"translation"}, linear{"linear"}, angular{"angular"}, jacobian{"jacobian"},
    coupling{"coupling"}, jump{"jump"}, sign{"sign"}, point{"point"}, power{"power"}, energy{"energy"},
    mass{"mass"}, lever{"lever"}, inertia{"inertia"}, matrix{"matrix"}, rotation_rate{"rotation rate"},
    R_dot{"R_dot"}, translation_matrix{"translation matrix"}, quaternion_matrix{"quaternion matrix"},
    zeros{"zeros"}, continuous{"continuous"}, joint{"joint"}, same{"same"}, torque{"torque"},
    acceleration{"acceleration"}, by_q{"by q"}, by_v{"by v"}, quaternion{"quaternion"}, entry{"entry"},
    angle{"angle"}, direction{"direction"}, twist{"twist"}, range{"range"}, parameters{"parameters"},
    pitch{"pitch"}, symmetry{"symmetry"}, velocity{"velocity"}, linear_by_q{"linear by q"},
    angular_by_q{"angular by q"}, linear_by_v{"linear by v"}, angular_by_v{"angular by v"};
}

namespace op {

/// Parts that several values have.
namespace parts {
inline constexpr Few<Part, 4> pose{{"R", 9, "1"}, {"p", 3, "m"}}, tangent{{"rho", 3, "m"}, {"phi", 3, "rad"}},
    twist{{"u", 3, "m/s"}, {"omega", 3, "rad/s"}}, force{{"f", 3, "N"}, {"n", 3, "N m"}},
    body{{"mass", 1, "kg"}, {"c", 3, "m"}, {"I_C", 9, "kg m^2"}},
    momenta{{"linear", 3, "kg m/s"}, {"angular", 3, "kg m^2/s"}},
    second_configuration{{"p1", 3, "m"}, {"Q1", 4, "1"}};
}

// rotations and poses
inline constexpr Value<type::Vector3> phi{{"phi", {{"phi", 3, "rad"}}, "body axes"}},
    p_Y{{"p_Y", {{"p_Y", 3, "m"}}, "B"}}, p{{"p", {{"p", 3, "m"}}, "B"}};
inline constexpr Value<type::Vector4> Q{{"Q", {{"Q", 4, "1"}}, "from B to A"}};
inline constexpr Value<type::Matrix3> R{{"R", {{"R", 9, "1"}}, "from B to A"}};
inline constexpr Value<type::Vector6> xi{{"xi", parts::tangent, "body axes", "Vector6<S>"}};
inline constexpr Value<type::PoseValue> X{{"X", parts::pose, "from B to A", "SE3<S>"}},
    Y{{"Y", {{"R_Y", 9, "1"}, {"p_Y", 3, "m"}}, "from C to B", "SE3<S>"}};

// configurations of a free-flyer
inline constexpr Value<type::Vector7> q0{
    {"q0", {{"p0", 3, "m"}, {"Q0", 4, "1"}}, "parent axes", "Vector7<S>"}},
    q1{{"q1", parts::second_configuration, "parent axes", "Vector7<S>"}},
    q{{"q", {{"p", 3, "m"}, {"Q", 4, "1"}}, "parent axes", "Vector7<S>"}};
inline constexpr Value<type::Vector6> delta{{"delta", parts::tangent, "axes of q0's body", "Vector6<S>"}};

// motions, forces and bodies
inline constexpr Value<type::Vector6> V{{"V", parts::twist, "B", "Motion<S>"}},
    W{{"W", {{"u_W", 3, "m/s"}, {"omega_W", 3, "rad/s"}}, "B", "Motion<S>"}},
    F{{"F", parts::force, "B", "Force<S>"}};
inline constexpr Value<type::BodyValue> I{{"I", parts::body, "B", "Inertia<S>"}};

// whole robots; sizes follow from the model
inline constexpr Value<type::Vector> robot_q0{{"q0", {{"q0", nq, "m, 1, rad"}}, "joint by joint"}},
    robot_q1{{"q1", {{"q1", nq, "m, 1, rad"}}, "joint by joint"}},
    robot_delta{{"delta", {{"delta", nv, "m, rad"}}, "joint by joint"}},
    tree_q{{"q", {{"q", nq, "m, 1, rad"}}, "joint by joint"}},
    tree_v{{"v", {{"v", nv, "m/s, rad/s"}}, "joint by joint"}},
    tree_a{{"a", {{"a", nv, "m/s^2, rad/s^2"}}, "joint by joint"}},
    tree_tau{{"tau", {{"tau", nv, "N, N m"}}, "joint by joint"}};
inline constexpr Value<type::Index> wrench_joint{
    {"wrench_joint", {{"wrench_joint", 1, "1"}}, "-1: no wrench"}};
inline constexpr Value<type::Vector6> wrench{
    {"wrench", {{"force", 3, "N"}, {"moment", 3, "N m"}}, "axes and origin of that joint's body"}};
inline constexpr Value<type::Reference> seen{{"seen", {}, "WORLD, LOCAL or LOCAL_WORLD_ALIGNED"}};

// results
inline constexpr Value<type::Vector3> phi_result{
    {"phi", {{"phi", 3, "rad"}}, "body axes; either sign at pi"}},
    x_A{{"x_A", {{"x_A", 3, "m"}}, "A"}};
inline constexpr Value<type::Vector4> Q_result{
    {"Q", {{"Q", 4, "1"}}, "right-handed, angle about n positive"}};
inline constexpr Value<type::Vector4> unit_result{{"Q_n", {{"Q_n", 4, "1"}}, "from B to A, as Q"}};
inline constexpr Value<type::Matrix3> R_result{
    {"R", {{"R", 9, "1"}}, "right-handed, angle about n positive"}},
    J3_left{{"J", {{"J", 9, "1"}}, "increments on the left: parent axes"}},
    J3_right{{"J", {{"J", 9, "1"}}, "increments on the right: body axes"}};
inline constexpr Value<type::PoseValue> T_result{{"T", parts::pose, "parent axes; increment in body axes"}},
    X_result{{"X", parts::pose, "axes of A"}}, frame_result{{"oMf", parts::pose, "world axes"}};
inline constexpr Value<type::Matrix6> J6_left{
    {"J", {{"J", 36, "1, m"}}, "increments on the left: parent axes"}},
    J6_right{{"J", {{"J", 36, "1, m"}}, "increments on the right: body axes"}},
    J6_tangent{{"J", {{"J", 36, "1, m"}}, "tangent spaces in body axes"}},
    I_O{{"M", {{"M", 36, "kg, kg m, kg m^2"}}, "B, about its origin"}};
inline constexpr Value<type::Matrix76> J76{{"J", {{"J", 42, "1"}}, "body axes to stored numbers"}};
inline constexpr Value<type::Vector6> log_result{{"xi", parts::tangent, "body axes, linear part first"}},
    delta_result{{"delta", parts::tangent, "from q0 to q1, in the axes of q0's body"}},
    V_A{{"V_A", parts::twist, "A"}}, V_B{{"V_B", parts::twist, "B"}}, F_A{{"F_A", parts::force, "A"}},
    F_B{{"F_B", parts::force, "B"}},
    bracket{{"[V, W]", {{"linear", 3, "m/s^2"}, {"angular", 3, "rad/s^2"}}, "B"}},
    dual_bracket{{"V x* F", {{"linear", 3, "N/s"}, {"angular", 3, "N m/s"}}, "B"}},
    h{{"h", parts::momenta, "B, about its origin"}},
    momentum_result{{"h_g", parts::momenta, "world axes, at the centre of mass"}},
    frame_velocity_result{{"V", {{"linear", 3, "m/s"}, {"angular", 3, "rad/s"}}, "in the reference `seen`"}},
    frame_acceleration_result{
        {"A", {{"linear", 3, "m/s^2"}, {"angular", 3, "rad/s^2"}}, "in the reference `seen`"}};
inline constexpr Value<type::Vector7> q1_result{
    {"q1", parts::second_configuration, "parent axes; increment in body axes"}};
inline constexpr Value<type::BodyValue> I_A{{"I_A", parts::body, "A"}}, I_B{{"I_B", parts::body, "B"}};
inline constexpr Value<type::Scalar> kinetic{{"T", {{"T", 1, "J"}}, "any frame"}},
    power_result{{"P", {{"P", 1, "W"}}, "any frame"}},
    potential{{"V", {{"V", 1, "J"}}, "world axes, zero at the world's origin"}};
inline constexpr Value<type::Vector> robot_delta_result{
    {"delta", {{"delta", nv, "m, rad"}}, "body axes, joint by joint"}};
inline constexpr Value<type::Truth> same_result{{"same", {{"same", 1, "1"}}, "yes or no"}};
inline constexpr Value<type::Matrix> robot_derivative{
    {"J", {{"J", nv_by_nv, "1, m"}}, "tangent spaces, joint by joint"}},
    M_result{{"M", {{"M", nv_by_nv, "kg, kg m, kg m^2"}}, "joint by joint"}},
    M_inverse_result{{"M^-1", {{"M^-1", nv_by_nv, "1/kg, 1/(kg m), 1/(kg m^2)"}}, "joint by joint"}},
    momentum_map_result{
        {"A_g", {{"A_g", six_by_nv, "kg, kg m, kg m^2"}}, "world axes, at the centre of mass"}},
    frame_jacobian_result{{"J", {{"J", six_by_nv, "1, m"}}, "in the reference `seen`"}},
    frame_jacobian_rate_result{{"dJ", {{"dJ", six_by_nv, "1/s, m/s"}}, "in the reference `seen`"}};
inline constexpr Value<type::TwoMatrices> derivatives_result{
    {"D", {{"by q", nv_by_nv, "per m, rad"}, {"by v", nv_by_nv, "per m/s, rad/s"}}, "joint by joint"}};

// blocks
inline constexpr Block rotation_of_quaternion{block::rotation, "2 min(|Q/|Q| - Q_exact|, |Q/|Q| + Q_exact|)",
                                              "absolute", "rad"};
inline constexpr Block norm_of_quaternion{block::norm_defect, "| |Q|^2 - 1 |", "absolute", "1"};
inline constexpr Block rotation_of_matrix{
    block::rotation, "angle from the exact rotation to the rotation nearest to R", "absolute", "rad"};
inline constexpr Block orthogonality_of_matrix{block::orthogonality_defect, "|R^T R - I|, Frobenius",
                                               "absolute", "1"};
inline constexpr Block rotation_vector{block::rotation_vector, "|phi - phi_exact|", "|phi_exact|", "rad"};
/// Both diagonal blocks of a 6 x 6 Jacobian; infinite if the block below them is not zero.
inline constexpr Block jacobian6{
    block::jacobian, "larger |J - J_exact| of the two 3 x 3 diagonal blocks, Frobenius", "|J_exact|", "1"};
inline constexpr Block coupling6{block::coupling, "|C - C_exact| of the upper right 3 x 3 block, Frobenius",
                                 "|C_exact|; beyond pi max(|C_exact|, |rho| min(1, |J_exact|))", "m"};

}  // namespace op
}  // namespace liecheck::properties
