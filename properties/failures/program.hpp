#pragma once
// A failing case as a C++ program: the numbers as hexadecimal literals, and the operation called on them.

#include <campaign/series.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

/// Compiles against liecheck's public headers and Eigen; prints the operation's result. `numbers` are an input of
/// the series' property in hexadecimal. Another subject's case calls liecheck's function of the same meaning, with a
/// comment that says so.
std::string program_of(const Series& series, const Output& output, const std::vector<std::string>& numbers);

}  // namespace liecheck::properties
