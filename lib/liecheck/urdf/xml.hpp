#pragma once
// An XML text as a tree of its elements, read by expat.

#include <liecheck/urdf/error.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace liecheck::urdf_detail {

struct Attribute {
  std::string name, value;
  int line;
};

struct Element {
  std::string name;
  int line = 0;
  std::vector<Attribute> attributes;
  std::vector<Element> children;

  /// The value of an attribute; null if there is none of that name.
  const char* attribute(std::string_view attribute_name) const;
  /// The first child of that name; null if there is none.
  const Element* first(std::string_view child_name) const;
};

/// Limit of the nesting of elements, since those who visit the tree recurse on the stack. A robot needs seven levels.
constexpr int max_element_depth = 64;

/// The root element of a text in UTF-8, whatever encoding it declares. White space before an XML declaration is
/// allowed, text between elements is not kept, and nothing outside of the text is read. Throws UrdfError if the text
/// is not well-formed, has a DOCTYPE with declarations, or exceeds the limit above. Time: linear in the length of the
/// text. Precondition: the length is a positive int.
Element parseXml(const std::string& text, const Messages& messages);

}  // namespace liecheck::urdf_detail
