#pragma once
// The corpus of hard cases, fixtures/hard_cases/*.txt. The README there defines the format of a line.

#include <generators/input_layout.hpp>
#include <hard_cases/expression.hpp>
#include <invariants/measurement.hpp>

namespace liecheck::properties {

/// One line: an input, written once for every scalar, for one law or several laws with the same fields.
struct HardCase {
  std::string file;
  int line = 0;
  std::string name, input, hard_class, reason, origin;
  std::vector<std::string> properties;
  std::vector<std::string> scalars;  ///< the scalars in which the case runs; empty: all

  std::string place() const;  ///< FILE:LINE
};

/// The cases of one file's text. Throws std::invalid_argument with file, line and value.
std::vector<HardCase> parse_corpus(const std::string& file, const std::string& text);
/// Reads a file and parses it like parse_corpus.
std::vector<HardCase> read_corpus(const std::string& path);
/// The corpus that is compiled into the program.
const std::vector<HardCase>& built_in_corpus();
/// Throws std::invalid_argument if two cases have the same name.
void check_names_differ(const std::vector<HardCase>& cases);

/// A case's numbers in a scalar, in the order of a law's fields, as hexadecimal floats that the scalar holds
/// exactly. Throws std::invalid_argument with file, line and value.
std::vector<std::string> numbers_of(const HardCase& c, const std::vector<Field>& fields,
                                    const Scalar& scalar);

}  // namespace liecheck::properties
