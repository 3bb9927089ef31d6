#pragma once
// The accuracy report of stored campaign records: one self-contained HTML page, and its figures as JSON and
// CSV.

#include <filesystem>
#include <vector>

namespace liecheck::reports {

struct ReportFiles {
  std::filesystem::path html, json, csv;
};

/// Merges `records` (JSON files, one campaign each) and writes report.html, report.json and report.csv into
/// `out_dir`, which is created. Each file appears complete or not at all.
/// Throws std::runtime_error, one line, that names the file, the field or byte, and the offending value.
ReportFiles write_report(const std::vector<std::filesystem::path>& records,
                         const std::filesystem::path& out_dir);

}  // namespace liecheck::reports
