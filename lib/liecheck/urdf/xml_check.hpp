#pragma once
// Checks an XML text before it is parsed, since the parser recurses and is lenient.

#include <liecheck/urdf/error.hpp>
#include <string>

namespace liecheck::urdf_detail {

/// Limit of the nesting of elements, since the parser recurses on the stack. A robot needs seven levels.
constexpr int max_element_depth = 64;

/// Limit of the attributes of one element, since the parser compares each with all before it. An element of a
/// URDF has at most six; the namespaces of a <robot> are up to 14 in public files.
constexpr int max_attributes = 64;

/// The longest character reference, from & to ; (Unicode ends at 0x10FFFF, and leading zeros are allowed).
constexpr std::size_t max_reference_size = 16;

/// Throws UrdfError unless text is UTF-8 without zero bytes, every tag and character reference ends, every
/// closing tag has an opening tag, and the limits above hold. Time: linear in the length of the text.
void checkXml(const std::string& text, const Messages& messages);

}  // namespace liecheck::urdf_detail
