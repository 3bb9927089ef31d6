#pragma once
// The HTML page. What a reader must see even without scripts (verdict, standings, definitions, machine) is
// written here; charts and the tables of bands are drawn in the browser from the figures inlined as JSON.

#include <reports/record.hpp>
#include <string>

namespace liecheck::reports {

/// The whole page; `numbers` is what report.json holds.
std::string page(const Merged& merged, const Json& numbers);

}  // namespace liecheck::reports
