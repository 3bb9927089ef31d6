#pragma once
// One raw input outside any campaign, as a user would hand it in: through the subject's checked entrance. It may hold
// rotations that are off unit, off orthogonal or reflected.

#include <campaign/series.hpp>

namespace liecheck::properties {

struct Trial {
  std::vector<std::string> input;  ///< hexadecimal floats
  bool in_domain = true;           ///< false: a rotation more than 8 eps off; refusing it is right
  std::vector<Judged> judged;
  std::string refusal;  ///< the subject's error text where it refused
};

/// Throws std::invalid_argument for an input that the law does not take.
Trial attempt(const Series& series, const CaseId& id);

}  // namespace liecheck::properties
