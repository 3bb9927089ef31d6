#pragma once
// The corpus of hard cases: fixtures/hard_cases/*.txt, whose README defines the line.

#include <hard_cases/expression.hpp>
#include <invariants/property.hpp>

namespace liecheck::properties {

/// One line: an input, written once for every scalar, of one law or of several that read it alike.
struct HardCase {
  std::string file;
  int line = 0;
  std::string name, input, hard_class, reason, origin;
  std::vector<std::string> properties;
  std::vector<std::string> scalars;  ///< of which the input makes sense; empty: of every one

  std::string place() const;  ///< FILE:LINE
};

/// The cases of one file's text. Throws std::invalid_argument naming file, line and value.
std::vector<HardCase> parse_corpus(const std::string& file, const std::string& text);
/// The same, of a file on disk.
std::vector<HardCase> read_corpus(const std::string& path);
/// The corpus that the program carries with it.
const std::vector<HardCase>& built_in_corpus();
/// Throws where two cases have one name.
void check_names_differ(const std::vector<HardCase>& cases);

/// A case's numbers in a scalar, in the order of a law's fields: hexadecimal floats that the scalar holds exactly.
/// Throws std::invalid_argument naming file, line and value.
std::vector<std::string> numbers_of(const HardCase& c, const std::vector<Field>& fields,
                                    const Format& format);

}  // namespace liecheck::properties
