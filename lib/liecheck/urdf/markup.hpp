#pragma once
// Checks the words of a URDF: a misspelt element or attribute would silently become a default value.

#include <liecheck/urdf/xml.hpp>

namespace liecheck::urdf_detail {

/// Warns of each element and attribute of a robot that URDF 1.0 does not have, with the nearest words that it
/// has; of an element that is given twice, of which only the first is read; and of xacro that is unexpanded.
/// Words with a namespace, and some without (<gazebo>, <transmission>), belong to other programs.
void checkMarkup(const Element& robot, Messages& messages);

}  // namespace liecheck::urdf_detail
