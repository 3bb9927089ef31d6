#pragma once
// What a probe of conventions finds.

#include <string>
#include <vector>

namespace liecheck::properties::conventions {

/// An answer that differs from the right one by more of its largest number is another convention, or wrong.
inline constexpr double probe_tolerance = 1e-3;

struct Finding {
  /// A convention; otherwise one operation that no known convention explains, or in which one holds that does not hold in
  /// as many others.
  bool named;
  std::string sentence;
  std::vector<std::string> operations;
  bool choice = false;  ///< one of several right results
  bool usual = false;   ///< a choice that need not be stated: liecheck's own, or none
};

}  // namespace liecheck::properties::conventions
