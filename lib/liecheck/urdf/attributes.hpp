#pragma once
// The attributes of URDF elements that hold numbers.

#include <liecheck/spatial/types.hpp>
#include <liecheck/urdf/xml.hpp>
#include <optional>
#include <string_view>
#include <vector>

namespace liecheck::urdf_detail {

/// The numbers in a text, separated by white space, in C notation whatever the locale; nullopt if one
/// of them is not a number, not finite, or outside the range of double.
std::optional<std::vector<double>> numbersIn(std::string_view text);

/// Checks the numeric attributes of all elements below e. Throws UrdfError if one does not hold the right
/// count of finite numbers, or if one without which there is no body is missing. Another one that URDF
/// requires and that is missing, a number whose square is not a finite double, and any error in what is only
/// seen or touched (<visual>, <collision>, <material>) is a warning, since the model does not contain it.
void checkNumbersBelow(const Element& e, Messages& messages);

/// Returns an attribute of e, or fallback if it is missing. Precondition: checkNumbersBelow has checked e.
double number(const Element& e, const char* attribute, double fallback = 0);
Vector3<double> vector(const Element& e, const char* attribute,
                       const Vector3<double>& fallback = Vector3<double>::Zero());

}  // namespace liecheck::urdf_detail
