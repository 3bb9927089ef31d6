#pragma once
// The HTML page. Verdict, standings, definitions and machine are plain HTML without scripts. Scripts in the
// browser draw the charts and the tables of bands from the figures that the page contains as JSON.

#include <reports/record.hpp>
#include <string>

namespace liecheck::reports {

/// The whole page; `numbers` is the content of report.json.
std::string page(const Merged& merged, const Json& numbers);

}  // namespace liecheck::reports
