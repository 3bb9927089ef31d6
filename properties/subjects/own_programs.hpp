#pragma once
// Programs in the terms of a subject's own library. A failure of the subject is printed as such a program, which calls
// the library's function and nothing of liecheck (failures/own_program.cpp).

#include <operations/operation.hpp>
#include <string>
#include <utility>
#include <vector>

namespace liecheck::properties {

/// The statements of an operation print its result; an expression without a semicolon is printed. They see S, the arguments as vectors and matrices of Eigen with
/// the names of docs/operations.md, and a pose X as R and p, a pose Y as R_Y and p_Y.
struct OwnPrograms {
  std::string compile;   ///< what the compiler needs beside C++20 and Eigen
  std::string includes;  ///< whole lines
  std::string begin;     ///< statements before those of each operation
  std::vector<std::pair<const Operation*, std::string>> statements;
};

/// A static object of this type registers the programs of a subject.
struct RegisteredPrograms {
  RegisteredPrograms(std::string subject, OwnPrograms programs);
};

/// Null if the subject has none, as the variants that exist only inside liecheck.
const OwnPrograms* own_programs(const std::string& subject);

}  // namespace liecheck::properties
