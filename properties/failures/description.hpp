#pragma once
// The printed description of a failure.

#include <campaign/series.hpp>

namespace liecheck::properties {

/// Error, limit, and what was returned beside what is right, of one output in one case.
std::string case_text(const Series& series, const CaseId& id, const std::vector<std::string>& input,
                      const Judged& judged);

/// The law, the subject and the block of a failing row, its worst case, shrunk, as case_text() has it, the replay
/// command and a program.
std::string describe_failure(const Series& series, std::uint64_t seed, int output, int band, const Row& row,
                             const Robot& robot);

}  // namespace liecheck::properties
