#pragma once
// The operations that are timed: the law that measures each, and which of the law's numbers it takes.

#include <invariants/property.hpp>
#include <tuple>

namespace liecheck::properties {

/// visit(name, law, pointer to member of Operations<S>, arguments of the law's numbers), once for each.
template <class S, class Visit>
void for_each_cost_operation(Visit visit) {
  using O = Operations<S>;
  using X = const std::vector<S>&;
  const auto at = []<int N>(X x, std::integral_constant<int, N>, std::size_t first) {
    Vec<S, N> v;
    for (int i = 0; i < N; ++i) v[i] = x[first + static_cast<std::size_t>(i)];
    return v;
  };
  using Three = std::integral_constant<int, 3>;
  using Four = std::integral_constant<int, 4>;
  using Six = std::integral_constant<int, 6>;
  using Seven = std::integral_constant<int, 7>;
  const auto matrix = [](X x, std::size_t first) {
    Mat<S, 3> m;
    for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = x[first + static_cast<std::size_t>(i)];
    return m;
  };
  const auto pose = [=](X x, std::size_t first) {
    return Pose<S>{matrix(x, first), at(x, Three(), first + 9)};
  };
  const auto phi = [=](X x) { return std::tuple(at(x, Three(), 3)); };
  const auto xi = [=](X x) { return std::tuple(at(x, Six(), 0)); };
  const auto two = [=](X x) { return std::tuple(at(x, Seven(), 0), at(x, Seven(), 7)); };
  const auto step = [=](X x) { return std::tuple(at(x, Seven(), 0), at(x, Six(), 14)); };
  const auto Q = [=](X x) { return std::tuple(at(x, Four(), 0)); };

  visit("exp3_quaternion", "exp_oracle", &O::exp3_quaternion, phi);
  visit("exp3_matrix", "exp_oracle", &O::exp3_matrix, phi);
  visit("log3_quaternion", "log_oracle", &O::log3_quaternion, Q);
  visit("log3_matrix", "log_oracle", &O::log3_matrix, [=](X x) { return std::tuple(matrix(x, 4)); });
  visit("exp6", "exp_oracle", &O::exp6, xi);
  visit("log6", "log_oracle", &O::log6, [=](X x) { return std::tuple(pose(x, 4)); });
  visit("compose", "pose_group", &O::compose, [=](X x) { return std::tuple(pose(x, 0), pose(x, 12)); });
  visit("inverse", "pose_group", &O::inverse, [=](X x) { return std::tuple(pose(x, 0)); });
  visit("act_point", "pose_group", &O::act_point,
        [=](X x) { return std::tuple(pose(x, 0), at(x, Three(), 21)); });
  visit("act_motion", "power_pairing", &O::act_motion,
        [=](X x) { return std::tuple(pose(x, 0), at(x, Six(), 12)); });
  visit("rotate_point", "power_pairing", &O::rotate_point,
        [=](X x) { return std::tuple(at(x, Four(), 30), at(x, Three(), 9)); });
  visit("integrate", "integrate_difference", &O::integrate, step);
  visit("difference", "integrate_difference", &O::difference, two);
  visit("left_jacobian3", "jacobian_oracle", &O::left_jacobian3, phi);
  visit("right_jacobian3", "jacobian_oracle", &O::right_jacobian3, phi);
  visit("left_jacobian3_inverse", "jacobian_oracle", &O::left_jacobian3_inverse, phi);
  visit("right_jacobian3_inverse", "jacobian_oracle", &O::right_jacobian3_inverse, phi);
  visit("left_jacobian6", "jacobian_oracle", &O::left_jacobian6, xi);
  visit("right_jacobian6", "jacobian_oracle", &O::right_jacobian6, xi);
  visit("left_jacobian6_inverse", "jacobian_oracle", &O::left_jacobian6_inverse, xi);
  visit("right_jacobian6_inverse", "jacobian_oracle", &O::right_jacobian6_inverse, xi);
  visit("d_integrate_arg0", "d_integrate", &O::d_integrate_arg0, step);
  visit("d_integrate_arg1", "d_integrate", &O::d_integrate_arg1, step);
  visit("d_difference_arg0", "d_integrate", &O::d_difference_arg0, two);
  visit("d_difference_arg1", "d_integrate", &O::d_difference_arg1, two);
}

}  // namespace liecheck::properties
