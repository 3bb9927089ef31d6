#pragma once
// The measurement of one library for the league: every operation that its adapter offers, by band of the angle.

#include <cstdint>
#include <league/tellings.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace liecheck::properties::league {

struct MeasureOptions {
  std::uint64_t cases = 300;  ///< of each law and scalar
  std::uint64_t seed = 42;
  unsigned jobs = 1;
  std::string
      robot;  ///< a URDF, on which the operations on trees are judged; empty: none, but for random trees
  bool fixed = false;  ///< its root
  std::string limits;  ///< a limits file of the library, whose expected failures do not count; empty if there is none
};

/// Registers the adapter and runs every law that it offers the operations of, judged by the profile `careful`. Returns
/// its name, its version and a list of cells, one for each operation and scalar: docs/league.md. Throws
/// std::invalid_argument if the adapter does not start.
nlohmann::json measure(const std::string& adapter, const MeasureOptions& options);

/// One telling of a robot and its cell, whose operation is told_NAME: all operations on trees that the subject offers.
struct Told {
  Telling telling;
  nlohmann::json cell;
};
inline constexpr std::uint64_t most_told_cases =
    20;  ///< of each law and telling: a wrong reader fails in nearly all

/// Judges a registered subject on each telling of the robot (tellings.hpp), by the exact motion of the tree that
/// liecheck reads from it.
std::vector<Told> measure_tellings(const std::string& subject, const Robot& robot,
                                   const MeasureOptions& options);

/// The shortest of seven times of one call [ns], at angles from 0.3 to 2.5, through the adapter; 0 if a call fails.
double time_of_call(const std::string& adapter, const std::string& operation, const std::string& scalar);

}  // namespace liecheck::properties::league
