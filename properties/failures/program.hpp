#pragma once
// Prints a failing case as a C++ program: hexadecimal literals, and a call of the operation on them.

#include <campaign/series.hpp>
#include <failures/calls.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

/// The program uses liecheck's public headers and Eigen, and prints the operation's result. `numbers` are an
/// input of the series' property in hexadecimal. For another subject the program calls liecheck's equivalent
/// function, and a comment says so.
std::string program_of(const Series& series, const Output& output, const std::vector<std::string>& numbers);

/// For a subject of an adapter: its own program for the call whose result is farthest from the oracle's, if the adapter
/// has one, or the numbers of this call.
std::string adapter_program(const Series& series, const Output& output, const NotedCase& noted);

}  // namespace liecheck::properties
