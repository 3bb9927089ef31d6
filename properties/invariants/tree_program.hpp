#pragma once
// Prints a case of a tree of bodies as a C++ program.

#include <invariants/tree_case.hpp>
#include <operations/operation.hpp>
#include <string>

namespace liecheck::properties {

/// The program builds the model joint by joint and evaluates the expression in `call`.
/// Numbers are exact, in hexadecimal.
std::string tree_program(const TreeCase<double>& c, const Call& call, const std::string& scalar);

}  // namespace liecheck::properties
