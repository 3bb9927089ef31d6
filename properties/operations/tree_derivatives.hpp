#pragma once
// More algorithms on trees of bodies: statics, the Coriolis matrix, the centre of mass, and derivatives of momenta and of the
// motions of frames.

#include <operations/trees.hpp>

namespace liecheck::properties::op {

inline constexpr Value<type::Matrix> C_result{
    {"C", {{"C", nv_by_nv, "kg/s, kg m/s, kg m^2/s"}}, "joint by joint"}},
    tau_q_result{{"dtau/dq", {{"dtau/dq", nv_by_nv, "per m, rad"}}, "joint by joint"}},
    com_jacobian_result{{"J_c", {{"J_c", three_by_nv, "1, m"}}, "world axes"}},
    momentum_derivative_result{
        {"dh/dq", {{"dh/dq", six_by_nv, "per m, rad"}}, "world axes, at the centre of mass"}};
inline constexpr Value<type::Vector3> com_result{{"c", {{"c", 3, "m"}}, "world axes"}};
inline constexpr Value<type::TwoMatrices> momentum_rate_result{
    {"D",
     {{"by q", six_by_nv, "per m, rad"}, {"by v", six_by_nv, "per m/s, rad/s"}},
     "world axes, at the centre of mass"}},
    frame_derivatives_result{{"D",
                              {{"by q", six_by_nv, "per m, rad"}, {"by v", six_by_nv, "per m/s, rad/s"}},
                              "in the reference `seen`"}};
inline constexpr Value<type::Matrix6> operational_result{
    {"Lambda", {{"Lambda", 36, "kg, kg m, kg m^2"}}, "in the reference `seen`"}};

inline constexpr auto tree_static_torque = operation<struct TreeStaticTorque, true>(
    {"tree_static_torque", "tau = g(q) - J^T F, of rest", rnea_source}, tree_tau, {torque},
    {"algorithms/rnea.hpp", "computeStaticTorque(model, data, q, on).transpose()"}, tree_q, wrench_joint,
    wrench);
inline constexpr auto static_torque_derivative = operation<struct StaticTorqueDerivative, true>(
    {"static_torque_derivative", "d tau / d q of static torques, with q displaced by integrate",
     derivatives_source},
    tau_q_result,
    {{block::by_q, "|((dtau/dq - exact) d)_k / sqrt(M_kk)| for a direction d",
      "|((dtau/dq exact) d)_k / sqrt(M_kk)|", torque_unit}},
    {"algorithms/derivatives.hpp", "(computeStaticTorqueDerivatives(model, data, q, on) * d).transpose()"},
    tree_q, wrench_joint, wrench);
inline constexpr auto tree_coriolis = operation<struct TreeCoriolis, true>(
    {"tree_coriolis", "C(q, v): C v = h(q, v) - g(q), C + C^T = M'", "Echeandia & Wensing 2021"}, C_result,
    {{block::torque, "|(C v - (h - g) exact)_k / sqrt(M_kk)|", "|((h - g) exact)_k / sqrt(M_kk)|",
      torque_unit},
     {block::symmetry, "|((C + C^T - M') d)_k / sqrt(M_kk)| for a direction d", "|(M' d)_k / sqrt(M_kk)|",
      torque_unit}},
    {"algorithms/coriolis.hpp", "(computeCoriolisMatrix(model, data, q, v) * v).transpose()"}, tree_q,
    tree_v);

inline constexpr auto tree_center_of_mass = operation<struct TreeCenterOfMass, true>(
    {"tree_center_of_mass", "c = sum_i m_i c_i / m", centroidal_source}, com_result,
    {{block::point, "|c - c_exact|", "|c_exact|", "m"}},
    {"algorithms/centroidal.hpp", "centerOfMass(model, data, q).transpose()"}, tree_q);
inline constexpr auto tree_com_jacobian = operation<struct TreeComJacobian, true>(
    {"tree_com_jacobian", "J_c(q): c' = J_c v", centroidal_source}, com_jacobian_result,
    {{block::linear, "|J_c v - c'_exact|", "|c'_exact|", "m/s"}},
    {"algorithms/centroidal.hpp", "(jacobianCenterOfMass(model, data, q) * v).transpose()"}, tree_q);
inline constexpr Block linear_by_q{block::linear_by_q, "|((D_q - exact) d) linear| for a direction d",
                                   "|(D_q exact d) linear|", "SI"},
    angular_by_q{block::angular_by_q, "|((D_q - exact) d) angular| for a direction d",
                 "|(D_q exact d) angular|", "SI"},
    linear_by_v{block::linear_by_v, "|((D_v - exact) d) linear| for a direction d", "|(D_v exact d) linear|",
                "SI"},
    angular_by_v{block::angular_by_v, "|((D_v - exact) d) angular| for a direction d",
                 "|(D_v exact d) angular|", "SI"};
inline constexpr std::string_view centroidal_call =
    "MatrixX<S> h_q(6, model.nv), f_q = h_q, f_v = h_q, f_a = h_q;\n"
    "computeCentroidalDynamicsDerivatives<S>(model, data, q, v, a, h_q, f_q, f_v, f_a);";
inline constexpr auto momentum_derivative = operation<struct MomentumDerivative, true>(
    {"momentum_derivative", "d h_g / d q, with q displaced by integrate", derivatives_source},
    momentum_derivative_result, {linear_by_q, angular_by_q},
    {"algorithms/centroidal_derivatives.hpp", "(h_q * d).transpose()", centroidal_call}, tree_q, tree_v);
inline constexpr auto momentum_rate_derivatives = operation<struct MomentumRateDerivatives, true>(
    {"momentum_rate_derivatives", "(d h_g' / d q, d h_g' / d v), with q displaced by integrate",
     derivatives_source},
    momentum_rate_result, {linear_by_q, angular_by_q, linear_by_v, angular_by_v},
    {"algorithms/centroidal_derivatives.hpp", "(f_q * d).transpose() << '\\n' << (f_v * d).transpose()",
     centroidal_call},
    tree_q, tree_v, tree_a);

inline constexpr auto frame_velocity_derivatives = operation<struct FrameVelocityDerivatives, true>(
    {"frame_velocity_derivatives", "(d V / d q, d V / d v) of frame_velocity, with q displaced by integrate",
     derivatives_source},
    frame_derivatives_result, {linear_by_q, angular_by_q, linear_by_v, angular_by_v},
    {"algorithms/kinematics_derivatives.hpp", "(by_q * d).transpose() << '\\n' << (by_v * d).transpose()",
     "MatrixX<S> by_q(6, model.nv), by_v = by_q;\n"
     "computeForwardKinematicsDerivatives(model, data, q, v, v);\n"
     "getFrameVelocityDerivatives<S>(model, data, frame, seen, by_q, by_v);"},
    tree_q, tree_v, seen);
inline constexpr auto frame_acceleration_derivatives = operation<struct FrameAccelerationDerivatives, true>(
    {"frame_acceleration_derivatives",
     "(d V' / d q, d V' / d v) of frame_acceleration, with q displaced by integrate", derivatives_source},
    frame_derivatives_result, {linear_by_q, angular_by_q, linear_by_v, angular_by_v},
    {"algorithms/kinematics_derivatives.hpp", "(by_q * d).transpose() << '\\n' << (by_v * d).transpose()",
     "MatrixX<S> by_q(6, model.nv), by_v = by_q, by_a = by_q;\n"
     "computeForwardKinematicsDerivatives(model, data, q, v, a);\n"
     "getFrameAccelerationDerivatives<S>(model, data, frame, seen, by_q, by_v, by_a);"},
    tree_q, tree_v, tree_a, seen);

inline constexpr auto operational_inertia = operation<struct OperationalInertia, true>(
    {"operational_inertia", "Lambda = (J M^-1 J^T)^-1 of a frame, where J has rank 6", "Khatib 1987, eq. 37"},
    operational_result,
    {{block::matrix, "|(Lambda - exact)_kl / sqrt(Lambda_kk Lambda_ll)|, Frobenius",
      "|Lambda_kl / sqrt(Lambda_kk Lambda_ll)|, Frobenius", "1"}},
    {"algorithms/operational_space.hpp", "computeOperationalSpaceInertia(model, data, q, frame, seen)"},
    tree_q, seen);

}  // namespace liecheck::properties::op
