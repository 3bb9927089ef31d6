#pragma once
// Checks of an XML text that come before its parser, which recurses and is lenient.

#include <liecheck/urdf/error.hpp>
#include <string>

namespace liecheck::urdf_detail {

/// The deepest nesting of elements that is read; a robot needs seven. The parser recurses, so that deeper text could
/// overflow the stack.
constexpr int max_element_depth = 64;

/// Throws UrdfError unless text is UTF-8 without zero bytes, and its tags end, nest no deeper than
/// max_element_depth and close what they opened.
void checkXml(const std::string& text, const Messages& messages);

}  // namespace liecheck::urdf_detail
