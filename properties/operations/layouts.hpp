#pragma once
// The arguments and results of operations: names, parts, units and axes. An operation takes those fields of a
// law's input that have the names of its parts.

#include <operations/operation.hpp>

namespace liecheck::properties::op {

// rotations and poses
inline constexpr Value<type::Vector3> phi{{"phi", {{"phi", 3, "rad"}}, "body axes"}};
inline constexpr Value<type::Vector4> Q{{"Q", {{"Q", 4, "1"}}, "from B to A"}};
inline constexpr Value<type::Matrix3> R{{"R", {{"R", 9, "1"}}, "from B to A"}};
inline constexpr Value<type::Vector6> xi{
    {"xi", {{"rho", 3, "m"}, {"phi", 3, "rad"}}, "body axes", "Vector6<S>"}};
inline constexpr Value<type::PoseValue> X{{"X", {{"R", 9, "1"}, {"p", 3, "m"}}, "from B to A", "SE3<S>"}};
inline constexpr Value<type::PoseValue> Y{{"Y", {{"R_Y", 9, "1"}, {"p_Y", 3, "m"}}, "from C to B", "SE3<S>"}};
inline constexpr Value<type::Vector3> p_Y{{"p_Y", {{"p_Y", 3, "m"}}, "B"}};
inline constexpr Value<type::Vector3> p{{"p", {{"p", 3, "m"}}, "B"}};

// configurations of a free-flyer
inline constexpr Value<type::Vector7> q0{
    {"q0", {{"p0", 3, "m"}, {"Q0", 4, "1"}}, "parent axes", "Vector7<S>"}};
inline constexpr Value<type::Vector7> q1{
    {"q1", {{"p1", 3, "m"}, {"Q1", 4, "1"}}, "parent axes", "Vector7<S>"}};
inline constexpr Value<type::Vector7> q{{"q", {{"p", 3, "m"}, {"Q", 4, "1"}}, "parent axes", "Vector7<S>"}};
inline constexpr Value<type::Vector6> delta{
    {"delta", {{"rho", 3, "m"}, {"phi", 3, "rad"}}, "axes of q0's body", "Vector6<S>"}};

// motions, forces and bodies
inline constexpr Value<type::Vector6> V{{"V", {{"u", 3, "m/s"}, {"omega", 3, "rad/s"}}, "B", "Motion<S>"}};
inline constexpr Value<type::Vector6> W{
    {"W", {{"u_W", 3, "m/s"}, {"omega_W", 3, "rad/s"}}, "B", "Motion<S>"}};
inline constexpr Value<type::Vector6> F{{"F", {{"f", 3, "N"}, {"n", 3, "N m"}}, "B", "Force<S>"}};
inline constexpr Value<type::BodyValue> I{
    {"I", {{"mass", 1, "kg"}, {"c", 3, "m"}, {"I_C", 9, "kg m^2"}}, "B", "Inertia<S>"}};

// whole robots; sizes follow from the model
inline constexpr Value<type::Vector> robot_q0{{"q0", {{"q0", nq, "m, 1, rad"}}, "joint by joint"}};
inline constexpr Value<type::Vector> robot_q1{{"q1", {{"q1", nq, "m, 1, rad"}}, "joint by joint"}};
inline constexpr Value<type::Vector> robot_delta{{"delta", {{"delta", nv, "m, rad"}}, "joint by joint"}};
inline constexpr Value<type::Vector> tree_q{{"q", {{"q", nq, "m, 1, rad"}}, "joint by joint"}};
inline constexpr Value<type::Vector> tree_v{{"v", {{"v", nv, "m/s, rad/s"}}, "joint by joint"}};
inline constexpr Value<type::Vector> tree_a{{"a", {{"a", nv, "m/s^2, rad/s^2"}}, "joint by joint"}};
inline constexpr Value<type::Vector> tree_tau{{"tau", {{"tau", nv, "N, N m"}}, "joint by joint"}};
inline constexpr Value<type::Index> wrench_joint{
    {"wrench_joint", {{"wrench_joint", 1, "1"}}, "-1: no wrench"}};
inline constexpr Value<type::Vector6> wrench{
    {"wrench", {{"force", 3, "N"}, {"moment", 3, "N m"}}, "axes and origin of that joint's body"}};
inline constexpr Value<type::Reference> seen{{"seen", {}, "WORLD, LOCAL or LOCAL_WORLD_ALIGNED"}};

// results
inline constexpr Value<type::Vector3> phi_result{
    {"phi", {{"phi", 3, "rad"}}, "body axes; either sign at pi"}};
inline constexpr Value<type::Vector4> Q_result{
    {"Q", {{"Q", 4, "1"}}, "right-handed, angle about n positive"}};
inline constexpr Value<type::Matrix3> R_result{
    {"R", {{"R", 9, "1"}}, "right-handed, angle about n positive"}};
inline constexpr Value<type::PoseValue> T_result{
    {"T", {{"R", 9, "1"}, {"p", 3, "m"}}, "parent axes; increment in body axes"}};
inline constexpr Value<type::PoseValue> X_result{{"X", {{"R", 9, "1"}, {"p", 3, "m"}}, "axes of A"}};
inline constexpr Value<type::Matrix3> J3_left{{"J", {{"J", 9, "1"}}, "increments on the left: parent axes"}};
inline constexpr Value<type::Matrix3> J3_right{{"J", {{"J", 9, "1"}}, "increments on the right: body axes"}};
inline constexpr Value<type::Matrix6> J6_left{
    {"J", {{"J", 36, "1, m"}}, "increments on the left: parent axes"}};
inline constexpr Value<type::Matrix6> J6_right{
    {"J", {{"J", 36, "1, m"}}, "increments on the right: body axes"}};
inline constexpr Value<type::Matrix6> J6_tangent{{"J", {{"J", 36, "1, m"}}, "tangent spaces in body axes"}};
inline constexpr Value<type::Matrix76> J76{{"J", {{"J", 42, "1"}}, "body axes to stored numbers"}};
inline constexpr Value<type::Vector6> log_result{
    {"xi", {{"rho", 3, "m"}, {"phi", 3, "rad"}}, "body axes, linear part first"}};
inline constexpr Value<type::Vector7> q1_result{
    {"q1", {{"p1", 3, "m"}, {"Q1", 4, "1"}}, "parent axes; increment in body axes"}};
inline constexpr Value<type::Vector6> delta_result{
    {"delta", {{"rho", 3, "m"}, {"phi", 3, "rad"}}, "from q0 to q1, in the axes of q0's body"}};
inline constexpr Value<type::Vector3> x_A{{"x_A", {{"x_A", 3, "m"}}, "A"}};
inline constexpr Value<type::Vector6> V_A{{"V_A", {{"u", 3, "m/s"}, {"omega", 3, "rad/s"}}, "A"}};
inline constexpr Value<type::Vector6> V_B{{"V_B", {{"u", 3, "m/s"}, {"omega", 3, "rad/s"}}, "B"}};
inline constexpr Value<type::Vector6> F_A{{"F_A", {{"f", 3, "N"}, {"n", 3, "N m"}}, "A"}};
inline constexpr Value<type::Vector6> F_B{{"F_B", {{"f", 3, "N"}, {"n", 3, "N m"}}, "B"}};
inline constexpr Value<type::Vector6> bracket{
    {"[V, W]", {{"linear", 3, "m/s^2"}, {"angular", 3, "rad/s^2"}}, "B"}};
inline constexpr Value<type::Vector6> dual_bracket{
    {"V x* F", {{"linear", 3, "N/s"}, {"angular", 3, "N m/s"}}, "B"}};
inline constexpr Value<type::BodyValue> I_A{
    {"I_A", {{"mass", 1, "kg"}, {"c", 3, "m"}, {"I_C", 9, "kg m^2"}}, "A"}};
inline constexpr Value<type::BodyValue> I_B{
    {"I_B", {{"mass", 1, "kg"}, {"c", 3, "m"}, {"I_C", 9, "kg m^2"}}, "B"}};
inline constexpr Value<type::Vector6> h{
    {"h", {{"linear", 3, "kg m/s"}, {"angular", 3, "kg m^2/s"}}, "B, about its origin"}};
inline constexpr Value<type::Scalar> kinetic{{"T", {{"T", 1, "J"}}, "any frame"}};
inline constexpr Value<type::Scalar> power_result{{"P", {{"P", 1, "W"}}, "any frame"}};
inline constexpr Value<type::Matrix6> I_O{{"M", {{"M", 36, "kg, kg m, kg m^2"}}, "B, about its origin"}};
inline constexpr Value<type::Vector> robot_q_result{{"q1", {{"q1", nq, "m, 1, rad"}}, "joint by joint"}};
inline constexpr Value<type::Vector> robot_delta_result{
    {"delta", {{"delta", nv, "m, rad"}}, "body axes, joint by joint"}};
inline constexpr Value<type::Truth> same_result{{"same", {{"same", 1, "1"}}, "yes or no"}};
inline constexpr Value<type::Vector> tau_result{{"tau", {{"tau", nv, "N, N m"}}, "joint by joint"}};
inline constexpr Value<type::Vector> acceleration_result{
    {"a", {{"a", nv, "m/s^2, rad/s^2"}}, "joint by joint"}};
inline constexpr Value<type::Matrix> M_result{{"M", {{"M", nv_by_nv, "kg, kg m, kg m^2"}}, "joint by joint"}};
inline constexpr Value<type::Matrix> M_inverse_result{
    {"M^-1", {{"M^-1", nv_by_nv, "1/kg, 1/(kg m), 1/(kg m^2)"}}, "joint by joint"}};
inline constexpr Value<type::TwoMatrices> derivatives_result{
    {"D", {{"by q", nv_by_nv, "per m, rad"}, {"by v", nv_by_nv, "per m/s, rad/s"}}, "joint by joint"}};
inline constexpr Value<type::Scalar> potential{
    {"V", {{"V", 1, "J"}}, "world axes, zero at the world's origin"}};
inline constexpr Value<type::Vector6> momentum_result{
    {"h_g", {{"linear", 3, "kg m/s"}, {"angular", 3, "kg m^2/s"}}, "world axes, at the centre of mass"}};
inline constexpr Value<type::Matrix> momentum_map_result{
    {"A_g", {{"A_g", six_by_nv, "kg, kg m, kg m^2"}}, "world axes, at the centre of mass"}};
inline constexpr Value<type::PoseValue> frame_result{{"oMf", {{"R", 9, "1"}, {"p", 3, "m"}}, "world axes"}};
inline constexpr Value<type::Vector6> frame_velocity_result{
    {"V", {{"linear", 3, "m/s"}, {"angular", 3, "rad/s"}}, "in the reference `seen`"}};
inline constexpr Value<type::Vector6> frame_acceleration_result{
    {"A", {{"linear", 3, "m/s^2"}, {"angular", 3, "rad/s^2"}}, "in the reference `seen`"}};
inline constexpr Value<type::Matrix> frame_jacobian_result{
    {"J", {{"J", six_by_nv, "1, m"}}, "in the reference `seen`"}};
inline constexpr Value<type::Matrix> frame_jacobian_rate_result{
    {"dJ", {{"dJ", six_by_nv, "1/s, m/s"}}, "in the reference `seen`"}};

}  // namespace liecheck::properties::op
