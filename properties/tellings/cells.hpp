#pragma once
// The cells of a campaign: what one subject's operations reach, each by band of the angle.

#include <campaign/campaign.hpp>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <tellings/tellings.hpp>
#include <utility>
#include <vector>

namespace liecheck::properties::league {

struct MeasureOptions {
  std::uint64_t cases = 300;  ///< of each law and scalar
  std::uint64_t seed = 42;
  unsigned jobs = 1;
  std::string
      robot;  ///< a URDF, on which the operations on trees are judged; empty: none, but for random trees
  bool fixed = false;  ///< its root
  std::string
      limits;  ///< a limits file of the library, whose expected failures do not count; empty if there is none
};

/// A quiet campaign over one subject.
CampaignOptions options_of(const std::string& subject, const MeasureOptions& options);

using CellKey = std::pair<std::string, std::string>;  ///< operation, scalar
/// Names the cell of an operation in a scalar, or gives nothing if it does not count.
using CellOf = std::function<std::optional<CellKey>(const std::string& operation, const std::string& scalar)>;

/// The cells in the order of their names, with the fields of docs/laboratory.md; the time "ns" is 0.
std::vector<nlohmann::json> cells_of(const CampaignResult& result, const CellOf& key_of);

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

}  // namespace liecheck::properties::league
