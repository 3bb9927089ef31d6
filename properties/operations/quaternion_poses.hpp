#pragma once
// Poses as (p, Q), for libraries that hold a rotation as a quaternion. The laws have poses as (R, p). Q is the quaternion of
// the rotation nearest to R, of which each number is rounded once. Its sign follows from the numbers of the call, so that a
// replay has the same one and half of the quaternions have w < 0.

#include <operations/description.hpp>
#include <span>
#include <vector>

namespace liecheck::properties {

/// Whether a value is a pose (R, p).
bool is_pose(const Layout& layout);

/// The layout of a pose as (p, Q). Any other layout stays as it is.
Layout with_quaternion(const Layout& layout);

/// The arguments of a call with each pose as (p, Q). The numbers are those of float or double.
std::vector<double> poses_as_quaternions(const Operation& operation, std::span<const double> arguments,
                                         bool is_float);

/// A result with a pose (p, Q) as (R(Q), p), where R(Q) = (w^2 - |v|^2) 1 + 2 v v^T + 2 w [v] is not normalised and each
/// number is rounded once.
std::vector<double> poses_as_matrices(const Layout& result, std::span<const double> numbers, bool is_float);

}  // namespace liecheck::properties
