#pragma once
// A case of a tree of bodies as a C++ program.

#include <invariants/tree_case.hpp>
#include <operations/operation.hpp>
#include <string>

namespace liecheck::properties {

/// Makes the model by hand and calls liecheck's own algorithm as the operation's record says; numbers are hexadecimal, exact.
std::string tree_program(const TreeCase<double>& c, const Call& call, const std::string& scalar);

}  // namespace liecheck::properties
