#pragma once
// The names of the laws on trees of bodies. Each of their cases builds a model, so they are timed separately.

#include <string>

namespace liecheck::properties {

bool is_tree_law(const std::string& property);
void add_tree_law(const std::string& property);

}  // namespace liecheck::properties
