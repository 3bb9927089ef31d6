#pragma once
// The bench of causes: faulty forms whose cause is known, and whether a finding names it.

#include <cstdint>
#include <string>
#include <vector>

namespace liecheck::properties {

enum class Named : std::uint8_t { right, where, near, wrong, silent, not_found };
inline constexpr const char* named_words[] = {"right", "where", "near", "wrong", "silent", "not found"};

/// One faulty form of one operation of the subject liecheck.
struct CauseRow {
  std::string form, cause;  ///< "cutoff_log3_quaternion_1e-3"; the class of its cause
  double threshold = 0;     ///< of theta, or 0
  Named named = Named::not_found;
  std::string guess;  ///< of the worst finding
  std::string where;  ///< where the finding says that it fails
};

/// Runs a campaign of a thousand cases on each form, or on every third one, and so on, in double, until a signal. A guess is
/// right if it names the class, with the threshold within a factor of 2; `where` if the finding says under which condition
/// it fails, and not why; near if it names the kind, or another threshold.
std::vector<CauseRow> bench_of_causes(std::uint64_t seed, std::size_t every = 1);

}  // namespace liecheck::properties
