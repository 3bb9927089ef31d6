#pragma once
// Runs one raw input outside any campaign, through the subject's checked entrance, like a user's input. Its
// rotations may be off unit, off orthogonal or reflected.

#include <campaign/series.hpp>

namespace liecheck::properties {

struct Trial {
  std::vector<std::string> input;  ///< hexadecimal floats
  bool in_domain = true;           ///< false: a rotation is more than 8 eps off, and may be refused
  std::vector<Judged> judged;
  std::string refusal;  ///< the subject's error text if it refused
};

/// Throws std::invalid_argument for an input that is not valid for the law.
Trial attempt(const Series& series, const CaseId& id);

}  // namespace liecheck::properties
