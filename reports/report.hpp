#pragma once
// The accuracy report of stored records: one self-contained HTML page, and its figures as JSON and CSV.

#include <filesystem>
#include <vector>

namespace liecheck::reports {

struct ReportFiles {
  std::filesystem::path html, json, csv;
};

/// Merges `records` (JSON files, one campaign each), creates the folder `out_dir` and writes report.html,
/// report.json and report.csv into it. Each file appears complete or not at all. Throws std::runtime_error
/// with one line: the file, the field or position, and the wrong value.
ReportFiles write_report(const std::vector<std::filesystem::path>& records,
                         const std::filesystem::path& out_dir);

}  // namespace liecheck::reports
