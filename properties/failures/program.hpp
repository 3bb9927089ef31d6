#pragma once
// Prints a failing case as a C++ program: hexadecimal literals, and a call of the operation on them.

#include <campaign/series.hpp>
#include <failures/calls.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

/// The program uses liecheck's public headers and Eigen, and prints the operation's result. `numbers` are an
/// input of the series' property in hexadecimal. For a subject that exists only inside the harness, as a known bug does,
/// the program calls liecheck's function in its place, and a comment says so.
std::string program_of(const Series& series, const Output& output, const std::vector<std::string>& numbers);

/// The program of a call in the terms of the subject's own library (subjects/own_programs.hpp), or "".
std::string own_program(const Series& series, const NotedCall& call);

/// That of the call whose result is farthest from the oracle's, or "".
std::string own_program(const Series& series, const Output& output, const NotedCase& noted);

/// For a subject of an adapter: its own program for the call whose result is farthest from the oracle's; "" if it has no
/// template of the operation.
std::string program_of_template(const Series& series, const Output& output, const NotedCase& noted);

/// The same, or the numbers of this call.
std::string adapter_program(const Series& series, const Output& output, const NotedCase& noted,
                            const CaseId& id);

}  // namespace liecheck::properties
