#pragma once
// The length of a test: short in the default line, full in the preset `nightly`, which sets LIECHECK_NIGHTLY=1.

#include <cstdlib>
#include <string_view>

namespace liecheck {

template <class N>
N sample(N small, N full) {
  const char* const nightly = std::getenv("LIECHECK_NIGHTLY");
  return nightly && std::string_view(nightly) == "1" ? full : small;
}

}  // namespace liecheck
