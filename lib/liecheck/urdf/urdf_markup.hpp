#pragma once
// What a text must be before TinyXML sees it.

#include <liecheck/urdf/urdf.hpp>
#include <string>
#include <string_view>

namespace liecheck::urdf_detail {

/// Elements inside elements; a robot needs seven. The parsers recurse, so deeper text could end the stack.
constexpr int max_element_depth = 64;

/// Where a text stops to be UTF-8 (RFC 3629: no surrogates, nothing overlong); its size if it nowhere does.
std::size_t firstNotUtf8(std::string_view text);

/// Throws UrdfError unless text is UTF-8 without zero bytes, and its tags end, nest no deeper than
/// max_element_depth and close what they opened.
void checkMarkup(const std::string& text, const std::string& source_name);

}  // namespace liecheck::urdf_detail
