#pragma once
// What the arguments and results of an operation are, as types of values: a convention belongs to such a type.

#include <operations/operation.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace liecheck::properties::conventions {

/// The arguments or the result of an operation: consecutive numbers, in the order of docs/conventions.md.
using Numbers = std::vector<double>;

enum class Kind {
  scalar,
  order,  ///< of Euler angles
  angle,
  euler_angles,
  axis_angle,
  parameters,  ///< Gibbs or modified Rodrigues
  weights,
  covariance,
  screw,
  extended_pose,
  extended_tangent,
  jacobian9,
  samples,     ///< measurements, one after the other
  increments,  ///< preintegrated, or their derivatives
  vector,
  direction,
  rotation_vector,
  quaternion,
  rotation_matrix,
  jacobian3,
  jacobian6,
  jacobian76,
  inertia_matrix,
  tangent,
  twist,
  wrench,
  pose,
  configuration,
  planar_tangent,
  planar_pose,
  body
};

Kind kind_of(const Layout& layout);
std::size_t size_of(const Layout& layout);

/// The name of a number of a part: "p[2]", "R[0,1]", "Q.w", or the part's own name if it has one number.
std::string number_name(const Part& part, std::size_t i);

/// The number of all arguments.
std::size_t arguments_of(const Operation& operation);

/// Calls visit(layout, its numbers) for each argument.
template <class Visit>
void for_each_argument(const Operation& operation, std::span<double> numbers, Visit visit) {
  for (const Layout* l : operation.arguments) {
    visit(*l, numbers.first(size_of(*l)));
    numbers = numbers.subspan(size_of(*l));
  }
}

/// The operation of this name among those on fixed-size values.
const Operation& operation_named(std::string_view name);

}  // namespace liecheck::properties::conventions
