#pragma once
// The page's own files and Chart.js, embedded at build time by embed.cmake.

#include <string_view>

namespace liecheck::reports {

/// The text of a file of the page, by its name: "page.html", "chart.min.js".
std::string_view part(std::string_view name);

}  // namespace liecheck::reports
