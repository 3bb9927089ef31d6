#pragma once
// Libraries with other conventions than liecheck: the subject liecheck with its functions wrapped by hand, without the
// probe's table.

#include <conventions/values.hpp>
#include <functional>
#include <map>
#include <string>
#include <subjects/typed.hpp>

namespace liecheck::properties::conventions {

/// The functions of a library by the names of their operations, on consecutive numbers.
using Library = std::map<std::string, std::function<Numbers(const Numbers&)>>;

/// Changes numbers in place.
using Change = std::function<void(double*)>;
/// Operations, each with the offset of a value among its arguments or in its result.
using Places = std::vector<std::pair<std::string, std::ptrdiff_t>>;
void change_arguments(Library& l, const Places& where, const Change& change);
void change_results(Library& l, const Places& where, const Change& change);
void exchange_halves(double* six);
void negate3(double* v);
void negate6(double* v);

template <class S>
Library library(const SpatialSlots<S>& slots);
/// The subject liecheck in double.
Library correct();

// Each gives a library another convention. Operations whose meaning it leaves open are removed.
void w_first(Library& l);
void passive_quaternions(Library& l);
void twists_angular_first(Library& l);
void wrenches_moment_first(Library& l);
void columns(Library& l);
void passive_poses(Library& l);
void jacobians_angular_first(Library& l);
void degrees(Library& l);
void quaternion_before_p(Library& l);
void inertia_about_the_origin(Library& l);
void right_jacobian_is_left(Library& l);
void log_of_the_inverse(Library& l);
void left_increments(Library& l);
void reversed_quaternion_product(Library& l);
void translation_without_V(Library& l);
void forces_as_motions(Library& l);
void cross_force_sign(Library& l);
void angle_for_half_angle(Library& l);
void passive_rotation_matrices(Library& l);
void exp_of_the_opposite(Library& l);
void opposite_tangents(Library& l);
void left_jacobian_is_right(Library& l);
void jacobians_exchanged_with_inverses(Library& l);
void quarter_angles(Library& l);
void left_derivatives(Library& l);
void difference_from_q1(Library& l);
void added_translations(Library& l);
void motions_as_forces(Library& l);
void cross_motion_exchanged(Library& l);
void compose_exchanged(Library& l);
void momentum_about_the_centre(Library& l);
void quaternion_product_exchanged(Library& l);
void rows_made_orthogonal(Library& l);
void axis_and_angle_inverse(Library& l);
void adjoint_of_the_inverse(Library& l);
void coadjoint_transposed(Library& l);
void pitch_of_a_turn(Library& l);
void position_rotation_velocity(Library& l);
void rotation_velocity_position(Library& l);
void by_measurements(Library& l);

}  // namespace liecheck::properties::conventions
