#pragma once
// A limits file: what one subject promises, in place of the limits of a profile, and on which inputs.
// docs/limits.md defines the format.

#include <budgets/domain.hpp>
#include <budgets/input_region.hpp>
#include <budgets/profile.hpp>

namespace liecheck::properties {

struct SubjectLimits {
  std::string file;  ///< its name, as the user gave it
  std::string text;  ///< the whole file
  std::string subject;
  int subject_line = 0;
  std::optional<Profile> profile;  ///< judges what the lines do not name
  std::vector<Budget> lines;       ///< the subject's own limits
  std::vector<DomainBound> domain;
  std::vector<ExpectedFailure> expected;
};

/// Throws std::invalid_argument with file, line and value for a line that is wrong or names nothing. Whether
/// the subject exists is not checked here.
SubjectLimits parse_limits(const std::string& file, const std::string& text);

/// Reads a file or a pipe and parses it like parse_limits. Throws std::runtime_error naming the file, too.
SubjectLimits read_limits(const std::string& path);

}  // namespace liecheck::properties
