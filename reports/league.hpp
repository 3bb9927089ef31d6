#pragma once
// The page of the league.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace liecheck::reports {

/// One HTML file without any other: library by operation, sorted by what a reader asks. `record` is that of
/// `liecheck lab league --record` (docs/laboratory.md).
std::string league_page(nlohmann::json record);

}  // namespace liecheck::reports
