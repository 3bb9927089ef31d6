#pragma once
// Numbers in attributes.

#include <tinyxml2.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace liecheck::urdf_detail {

/// Numbers in C notation whatever the locale, with white space between them; nothing if one is none, not finite, or
/// out of a double's range.
std::optional<std::vector<double>> list(std::string_view text);
/// The first of them. Precondition: checked.
double numberOf(std::string_view text);

/// Throws UrdfError unless the attributes below e that URDF defines as numbers are there and are finite ones.
void checkNumbersBelow(const tinyxml2::XMLElement& e, const std::string& source_name);

}  // namespace liecheck::urdf_detail
