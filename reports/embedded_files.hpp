#pragma once
// Files that embed.cmake compiles into the program: parts of the page, Chart.js and the schema of a record.

#include <string_view>

namespace liecheck::reports {

/// The text of the file with this name: "page.html", "chart.min.js", "record.json".
std::string_view embedded_file(std::string_view name);

}  // namespace liecheck::reports
