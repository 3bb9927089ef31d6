#pragma once
// Runs one raw input outside any campaign, through the subject's checked entrance, like a user's input. Its
// rotations may be off unit, off orthogonal or reflected.

#include <campaign/series.hpp>
#include <hard_cases/corpus.hpp>

namespace liecheck::properties {

struct Trial {
  std::vector<std::string> input;  ///< hexadecimal floats
  bool in_domain = true;           ///< false: a rotation is more than 8 eps off, and may be refused
  std::vector<Judged> judged;
  std::string refusal;  ///< the subject's error text if it refused
};

/// Throws std::invalid_argument for an input that is not valid for the law.
Trial attempt(const Series& series, const CaseId& id);

/// Whether the case is one of the series' property and scalar, and needs no robot beside its own.
bool concerns(const HardCase& hard_case, const Series& series);

/// The case as a raw input of the series. Throws std::invalid_argument with file, line and value.
CaseId raw_case(const Series& series, const HardCase& hard_case);

}  // namespace liecheck::properties
