#pragma once
// Which laws are of whole trees of bodies. A case of theirs is a model and its dynamics: they are timed apart.

#include <string>

namespace liecheck::properties {

bool is_tree_law(const std::string& property);
void add_tree_law(const std::string& property);

}  // namespace liecheck::properties
