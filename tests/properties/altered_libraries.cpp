#include "altered_libraries.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <operations/numbers.hpp>
#include <sstream>

#include "../own_subject.hpp"

namespace liecheck::properties::conventions {
namespace {

template <class S, const auto&... all>
Library of_slots(const Slots<S, all...>& slots) {
  Library l;
  const auto one = [&](const auto& operation) {
    if (slots[operation])
      l[std::string(operation.name)] = [f = slots[operation], &operation](const Numbers& numbers) {
        const std::vector<S> x(numbers.begin(), numbers.end());
        const std::vector<S> result = called(f, operation, x.data());
        return Numbers(result.begin(), result.end());
      };
  };
  (one(all), ...);
  return l;
}

}  // namespace

template <class S>
Library library(const SpatialSlots<S>& slots) {
  return of_slots<S>(slots);
}
template Library library(const SpatialSlots<float>&);
template Library library(const SpatialSlots<double>&);

Library correct() {
  return of_slots<double>(own_subject().operations);
}

void change_arguments(Library& l, const Places& where, const Change& change) {
  for (const auto& [name, offset] : where)
    if (l.contains(name))
      l[name] = [f = l[name], offset = offset, change](Numbers x) {
        change(x.data() + offset);
        return f(x);
      };
}
void change_results(Library& l, const Places& where, const Change& change) {
  for (const auto& [name, offset] : where)
    if (l.contains(name))
      l[name] = [f = l[name], offset = offset, change](const Numbers& x) {
        Numbers r = f(x);
        change(r.data() + offset);
        return r;
      };
}

void exchange_halves(double* v) {
  std::swap_ranges(v, v + 3, v + 3);
}
void negate3(double* v) {
  for (int i = 0; i < 3; ++i) v[i] = -v[i];
}
void negate6(double* v) {
  negate3(v), negate3(v + 3);
}
namespace {

template <int N>
void transpose(double* v) {
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < i; ++j) std::swap(v[N * i + j], v[N * j + i]);
}

/// Places by words: operations, each with its offsets.
Places places(const std::string& text) {
  Places all;
  std::istringstream words(text);
  std::string operation;
  for (std::string word; words >> word;)
    if (std::isdigit(static_cast<unsigned char>(word[0])))
      all.emplace_back(operation, std::stol(word));
    else
      operation = word;
  return all;
}

const Places
    quaternion_arguments = places(
        "log3_quaternion 0 log3_any_norm 0 rotate_point 0 rotate_point_any_norm 0 "
        "matrix_from_quaternion_any_norm 0 integrate 3 integrate_any_norm 3 difference 3 10 "
        "difference_any_norm 3 10 d_difference_arg0 3 10 d_difference_arg1 3 10 "
        "d_difference_any_norm 3 10 relative_angle 0 4 twist_angle 0 slerp 0 4 "
        "euler_from_quaternion 1 velocity_to_rate 3 rate_to_velocity 3 10 matrix_from_quaternion 0 "
        "quaternion_product 0 4 quaternion_inverse 0 axis_angle_from_quaternion 0 gibbs_from_quaternion 0 "
        "mrp_from_quaternion 0 mean_rotation 0 4 8 geodesic_mean 0 4 8 mean_pose 3 10 17 interpolate 3 10"),
    quaternion_results = places(
        "exp3_quaternion 0 integrate 3 integrate_any_norm 3 slerp 0 rotation_between 0 "
        "euler_to_quaternion 0 velocity_to_rate 3 quaternion_from_matrix 0 quaternion_product 0 "
        "quaternion_inverse 0 quaternion_from_axis_angle 0 quaternion_from_gibbs 0 quaternion_from_mrp 0 "
        "mean_rotation 0 geodesic_mean 0 mean_pose 3 interpolate 3"),
    tangent_arguments = places(
        "exp6 0 left_jacobian6 0 right_jacobian6 0 left_jacobian6_inverse 0 "
        "right_jacobian6_inverse 0 integrate 7 integrate_any_norm 7 d_integrate_arg0 7 "
        "d_integrate_arg1 7"),
    tangent_results = places("log6 0 difference 0 difference_any_norm 0"),
    twist_arguments = places(
        "act_motion 12 act_inverse_motion 12 cross_motion 0 6 cross_force 0 momentum 13 "
        "kinetic_energy 13 velocity_to_rate 7 small_adjoint 0 screw_parameters 0"),
    twist_results = places("act_motion 0 act_inverse_motion 0 cross_motion 0 rate_to_velocity 0"),
    wrench_arguments = places("act_force 12 act_inverse_force 12 cross_force 6"),
    wrench_results = places("act_force 0 act_inverse_force 0 cross_force 0 momentum 0"),
    pose_arguments = places(
        "log6 0 compose 0 12 inverse 0 act_point 0 act_motion 0 act_inverse_motion 0 act_force 0 "
        "act_inverse_force 0 act_inertia 0 act_inverse_inertia 0 adjoint 0 coadjoint 0 transport_covariance "
        "0"),
    pose_results = places("exp6 0 compose 0 inverse 0"),
    jacobians3 =
        places("left_jacobian3 0 right_jacobian3 0 left_jacobian3_inverse 0 right_jacobian3_inverse 0"),
    matrix_arguments = places(
        "log3_matrix 0 euler_from_matrix 1 quaternion_from_matrix 0 axis_angle_from_matrix 0 "
        "nearest_rotation 0 gram_schmidt 0"),
    matrix_results = places(
        "exp3_matrix 0 matrix_from_quaternion_any_norm 0 euler_to_matrix 0 matrix_from_quaternion 0 "
        "matrix_from_axis_angle 0 nearest_rotation 0 gram_schmidt 0"),
    parameter_arguments = places("quaternion_from_gibbs 0 quaternion_from_mrp 0"),
    parameter_results = places("gibbs_from_quaternion 0 mrp_from_quaternion 0"),
    axis_angle_results = places("axis_angle_from_quaternion 0 axis_angle_from_matrix 0"),
    jacobians6 = places(
        "left_jacobian6 0 right_jacobian6 0 left_jacobian6_inverse 0 right_jacobian6_inverse 0 "
        "d_integrate_arg0 0 d_integrate_arg1 0 d_difference_arg0 0 d_difference_arg1 0 "
        "d_difference_any_norm 0 adjoint 0 coadjoint 0 small_adjoint 0"),
    jacobians9 = places("se23_left_jacobian 0 se23_right_jacobian 0 se23_adjoint 0"),
    configuration_arguments = places(
        "integrate 0 integrate_any_norm 0 difference 0 7 difference_any_norm 0 7 "
        "d_difference_arg0 0 7 d_difference_arg1 0 7 d_difference_any_norm 0 7 d_integrate_arg0 0 "
        "d_integrate_arg1 0 integrate_coefficient_jacobian 0 velocity_to_rate 0 rate_to_velocity 0 7 "
        "mean_pose 0 7 14 "
        "interpolate 0 7"),
    configuration_results =
        places("integrate 0 integrate_any_norm 0 velocity_to_rate 0 mean_pose 0 interpolate 0"),
    body_arguments =
        places("act_inertia 12 act_inverse_inertia 12 momentum 0 kinetic_energy 0 inertia_matrix 0"),
    body_results = places("act_inertia 0 act_inverse_inertia 0");

}  // namespace

void w_first(Library& l) {
  change_arguments(l, {{"integrate_coefficient_jacobian", 3}},
                   [](double* q) { std::rotate(q, q + 1, q + 4); });
  change_results(l, {{"integrate_coefficient_jacobian", 18}},
                 [](double* J) { std::rotate(J, J + 18, J + 24); });
  change_arguments(l, quaternion_arguments, [](double* q) { std::rotate(q, q + 1, q + 4); });
  change_results(l, quaternion_results, [](double* q) { std::rotate(q, q + 3, q + 4); });
}
void passive_quaternions(Library& l) {
  change_arguments(l, {{"integrate_coefficient_jacobian", 3}}, negate3);
  for (const int row : {18, 24, 30}) change_results(l, {{"integrate_coefficient_jacobian", row}}, negate6);
  change_arguments(l, quaternion_arguments, negate3);
  change_results(l, quaternion_results, negate3);
}
static void exchange_columns(double* M, int rows) {
  for (int row = 0; row < rows; ++row) exchange_halves(M + 6 * row);
}
void twists_angular_first(Library& l) {
  change_results(l, {{"inertia_matrix", 0}}, [](double* M) { exchange_columns(M, 6); });
  for (const Places& p : {tangent_arguments, twist_arguments}) change_arguments(l, p, exchange_halves);
  for (const Places& p : {tangent_results, twist_results}) change_results(l, p, exchange_halves);
}
void wrenches_moment_first(Library& l) {
  change_results(l, {{"inertia_matrix", 0}}, [](double* M) { std::swap_ranges(M, M + 18, M + 18); });
  change_arguments(l, wrench_arguments, exchange_halves);
  change_results(l, wrench_results, exchange_halves);
}
void columns(Library& l) {
  change_results(l, {{"integrate_coefficient_jacobian", 0}}, [](double* J) {
    const Numbers rows(J, J + 42);
    for (std::size_t i = 0; i < 42; ++i) J[i] = rows[i % 7 * 6 + i / 7];
  });
  change_arguments(l, pose_arguments, transpose<3>);
  change_arguments(l, matrix_arguments, transpose<3>);
  change_arguments(l, {{"se23_log", 0}, {"se23_adjoint", 0}}, transpose<3>);
  change_results(l, {{"se23_exp", 0}}, transpose<3>), change_results(l, jacobians9, transpose<9>);
  change_results(l, pose_results, transpose<3>), change_results(l, jacobians3, transpose<3>);
  change_results(l, matrix_results, transpose<3>);
  change_results(l, jacobians6, transpose<6>);
}
void passive_poses(Library& l) {
  const auto invert = [](double* x) {
    const Numbers r = correct()["inverse"](Numbers(x, x + 12));
    std::ranges::copy(r, x);
  };
  change_arguments(l, pose_arguments, invert), change_results(l, pose_results, invert);
}
void jacobians_angular_first(Library& l) {
  change_results(l, {{"integrate_coefficient_jacobian", 0}}, [](double* J) { exchange_columns(J, 7); });
  const auto exchange = [](double* J) {
    std::swap_ranges(J, J + 18, J + 18);
    exchange_columns(J, 6);
  };
  change_results(l, jacobians6, exchange), change_results(l, {{"transport_covariance", 0}}, exchange);
  change_arguments(l, {{"transport_covariance", 12}}, exchange);
}
void degrees(Library& l) {
  const auto to_radians = [](double* v) {
    for (int i = 0; i < 3; ++i) v[i] *= std::numbers::pi / 180;
  };
  const auto to_degrees = [](double* v) {
    for (int i = 0; i < 3; ++i) v[i] *= 180 / std::numbers::pi;
  };
  const auto one = [](double factor) { return [factor](double* v) { *v *= factor; }; };
  change_arguments(l,
                   {{"se2_exp", 2},
                    {"se2_integrate", 6},
                    {"quaternion_from_axis_angle", 3},
                    {"matrix_from_axis_angle", 3}},
                   one(std::numbers::pi / 180));
  change_results(l,
                 {{"relative_angle", 0},
                  {"twist_angle", 0},
                  {"se2_log", 2},
                  {"se2_difference", 2},
                  {"angle_between", 0},
                  {"axis_angle_from_quaternion", 3},
                  {"axis_angle_from_matrix", 3}},
                 one(180 / std::numbers::pi));
  Places inside_arguments = places("exp3_quaternion 0 exp3_matrix 0 euler_to_quaternion 1 euler_to_matrix 1"),
         inside_results = places(
             "log3_quaternion 0 log3_any_norm 0 log3_matrix 0 euler_from_quaternion 0 euler_from_matrix 0");
  for (auto [name, at] : jacobians3) inside_arguments.emplace_back(name, at);
  for (auto [name, at] : tangent_arguments) inside_arguments.emplace_back(name, at + 3);
  for (auto [name, at] : tangent_results) inside_results.emplace_back(name, at + 3);
  change_arguments(l, inside_arguments, to_radians), change_results(l, inside_results, to_degrees);
}
void quaternion_before_p(Library& l) {
  change_results(l, {{"integrate_coefficient_jacobian", 0}},
                 [](double* J) { std::rotate(J, J + 18, J + 42); });
  change_arguments(l, configuration_arguments, [](double* q) { std::rotate(q, q + 4, q + 7); });
  change_results(l, configuration_results, [](double* q) { std::rotate(q, q + 3, q + 7); });
}
void inertia_about_the_origin(Library& l) {
  const auto moved = [](double sign) {
    return [sign](double* I) {
      const Eigen::Vector3d c(I[1], I[2], I[3]);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          I[4 + 3 * i + j] += sign * I[0] * ((i == j ? c.squaredNorm() : 0) - c[i] * c[j]);
    };
  };
  change_arguments(l, body_arguments, moved(-1)), change_results(l, body_results, moved(1));
}
void passive_rotation_matrices(Library& l) {
  change_arguments(l, matrix_arguments, transpose<3>);
  change_results(l, matrix_results, transpose<3>);
}
void opposite_tangents(Library& l) {
  change_arguments(l, tangent_arguments, negate6), change_results(l, tangent_results, negate6);
  change_arguments(l, {{"exp3_quaternion", 0}, {"exp3_matrix", 0}}, negate3);
  change_arguments(l, jacobians3, negate3), change_arguments(l, parameter_arguments, negate3);
  change_results(l, parameter_results, negate3), change_results(l, axis_angle_results, negate3);
  change_results(l, {{"log3_quaternion", 0}, {"log3_any_norm", 0}, {"log3_matrix", 0}}, negate3);
}
}  // namespace liecheck::properties::conventions
