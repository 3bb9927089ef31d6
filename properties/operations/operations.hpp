#pragma once
// All operations, as the slots of a subject. Their error limits are in budgets/budgets.csv.

#include <operations/configurations.hpp>
#include <operations/exponentials.hpp>
#include <operations/list.hpp>
#include <operations/navigation.hpp>
#include <operations/orientations.hpp>
#include <operations/planar.hpp>
#include <operations/quaternions.hpp>
#include <operations/representations.hpp>
#include <operations/spatial.hpp>
#include <operations/transforms.hpp>
#include <operations/tree_derivatives.hpp>

namespace liecheck::properties {

/// The operations on fixed-size values.
template <class S>
using SpatialSlots =
    Slots<S, op::exp3_quaternion, op::exp3_matrix, op::log3_quaternion, op::log3_matrix, op::exp6, op::log6,
          op::compose, op::inverse, op::act_point, op::act_motion, op::act_inverse_motion, op::act_force,
          op::act_inverse_force, op::cross_motion, op::cross_force, op::rotate_point, op::act_inertia,
          op::act_inverse_inertia, op::momentum, op::kinetic_energy, op::inertia_matrix, op::integrate,
          op::difference, op::left_jacobian3, op::right_jacobian3, op::left_jacobian3_inverse,
          op::right_jacobian3_inverse, op::left_jacobian6, op::right_jacobian6, op::left_jacobian6_inverse,
          op::right_jacobian6_inverse, op::d_integrate_arg0, op::d_integrate_arg1, op::d_difference_arg0,
          op::d_difference_arg1, op::integrate_coefficient_jacobian, op::normalize, op::first_order_normalize,
          op::matrix_from_quaternion_any_norm, op::rotate_point_any_norm, op::log3_any_norm,
          op::integrate_any_norm, op::difference_any_norm, op::d_difference_any_norm, op::relative_angle,
          op::twist_angle, op::slerp, op::rotation_between, op::euler_to_quaternion, op::euler_to_matrix,
          op::euler_from_quaternion, op::euler_from_matrix, op::velocity_to_rate, op::rate_to_velocity,
          op::se2_exp, op::se2_log, op::se2_compose, op::se2_integrate, op::se2_difference,
          op::quaternion_from_matrix, op::matrix_from_quaternion, op::quaternion_product,
          op::quaternion_inverse, op::axis_angle_from_quaternion, op::axis_angle_from_matrix,
          op::quaternion_from_axis_angle, op::matrix_from_axis_angle, op::gibbs_from_quaternion,
          op::quaternion_from_gibbs, op::mrp_from_quaternion, op::quaternion_from_mrp, op::nearest_rotation,
          op::gram_schmidt, op::adjoint, op::coadjoint, op::small_adjoint, op::transport_covariance,
          op::screw_parameters, op::mean_rotation, op::geodesic_mean, op::mean_pose, op::interpolate,
          op::angle_between, op::slerp_directions, op::se23_exp, op::se23_log, op::se23_left_jacobian,
          op::se23_right_jacobian, op::se23_adjoint, op::preintegrate_forster, op::preintegrate_brossard,
          op::forster_bias_jacobians, op::brossard_bias_jacobians>;

/// The operations on the whole configuration vector of one robot.
template <class S>
using RobotOperations =
    Slots<S, op::robot_integrate, op::robot_difference, op::robot_is_same, op::robot_d_integrate_arg0,
          op::robot_d_integrate_arg1, op::robot_d_difference_arg0, op::robot_d_difference_arg1>;

/// The operations on one tree of bodies.
template <class S>
using TreeOperations =
    Slots<S, op::tree_rnea, op::tree_aba, op::tree_nonlinear_effects, op::tree_gravity, op::tree_crba,
          op::tree_mass_inverse, op::rnea_derivatives, op::aba_derivatives, op::tree_kinetic_energy,
          op::tree_potential_energy, op::tree_momentum, op::tree_momentum_map, op::frame_pose,
          op::frame_velocity, op::frame_acceleration, op::frame_classical_acceleration, op::frame_jacobian,
          op::frame_jacobian_rate, op::tree_static_torque, op::static_torque_derivative, op::tree_coriolis,
          op::tree_center_of_mass, op::tree_com_jacobian, op::momentum_derivative,
          op::momentum_rate_derivatives, op::frame_velocity_derivatives, op::frame_acceleration_derivatives,
          op::operational_inertia>;

}  // namespace liecheck::properties
