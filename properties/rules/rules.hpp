#pragma once
// Versions of the rules: which laws, inputs, limits and hard cases lead to a verdict. docs/ci.md says what a version
// freezes. fixtures/rules/VERSION.txt records each version by digests; a test fails if this program's rules change
// without a new version.

#include <hard_cases/corpus.hpp>
#include <map>
#include <string>
#include <vector>

namespace liecheck::properties {

struct Rules {
  std::string version;  ///< a number, or "present"
  std::map<std::string, std::string>
      parts;  ///< digests by "law NAME", "hard case NAME" and "limits PROFILE SCALAR"

  /// A line for each part, and the version in the first.
  std::string text() const;
  /// The names of its laws, or of its hard cases.
  std::vector<std::string> names(const std::string& kind) const;
};

/// What this program judges by. The digest of a law is that of its inputs, on the built-in robot, in float and double.
const Rules& present_rules();
/// Throws std::invalid_argument with the file and the line.
Rules parse_rules(const std::string& file, const std::string& text);
/// The versions of fixtures/rules, in ascending order.
const std::vector<Rules>& known_rules();
/// One of known_rules(), or present_rules() for "present". Throws std::invalid_argument with the known versions.
const Rules& rules_named(const std::string& version);

/// What differs, one line each: "law x: changed", "hard case y: only in 1".
std::vector<std::string> differences(const Rules& a, const Rules& b);
/// Throws std::invalid_argument if the program no longer has a law, a limit or a hard case of these rules. What it has
/// in addition is no hindrance: it is left out.
void check_runs(const Rules& rules, const Rules& program);

/// The selected laws, or all laws of the rules if none is selected. Throws std::invalid_argument if the rules do not have
/// one of them.
std::vector<std::string> laws_of(const Rules& rules, const std::vector<std::string>& selected);
/// The built-in hard cases that the rules have.
std::vector<HardCase> hard_cases_of(const Rules& rules);

}  // namespace liecheck::properties
