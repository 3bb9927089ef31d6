#pragma once
// Errors of formulas have shapes over the angle theta: what cancels as theta goes to 0 grows as a power of 1 / theta and ends
// where the code changes its formula; a series with a wrong term has an error that grows with theta up to its end.

#include <failures/blocks.hpp>

namespace liecheck::properties {

/// The cause that the errors at small angles tell, or "".
std::string shape_at_small_angles(const FailedBlock& f);
/// The cause that the errors near pi tell, or "".
std::string shape_near_pi(const FailedBlock& f);

/// What the errors of Euler angles near gimbal lock tell, or "".
std::string near_gimbal_lock(const FailedBlock& f);

/// The angle to two digits, as 0.02 or 1.5e-8, and a power of ten as 1e-2.
std::string short_angle(double theta);
/// The angle as a power of ten.
std::string power_of_ten(double theta);

std::string_view operation_of(const FailedBlock& f);
/// Whether the result is a rotation vector, or its angle alone.
bool has_angle(const FailedBlock& f);

}  // namespace liecheck::properties
