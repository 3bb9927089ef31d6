#pragma once
// Checks an XML text before it is parsed, since the parser recurses and is lenient.

#include <liecheck/urdf/error.hpp>
#include <string>

namespace liecheck::urdf_detail {

/// Limit of the nesting of elements, since the parser recurses on the stack. A robot needs seven levels.
constexpr int max_element_depth = 64;

/// Throws UrdfError unless text is UTF-8 without zero bytes, every tag ends and every closing tag has an
/// opening tag, and the nesting is at most max_element_depth.
void checkXml(const std::string& text, const Messages& messages);

}  // namespace liecheck::urdf_detail
