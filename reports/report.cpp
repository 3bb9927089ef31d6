#include <fmt/format.h>

#include <array>
#include <reports/html.hpp>
#include <reports/record.hpp>
#include <reports/report.hpp>
#include <stdexcept>
#include <string_view>
#include <support/files.hpp>
#include <support/folder.hpp>
#include <support/stop.hpp>
#include <support/text.hpp>
#include <system_error>

namespace liecheck::reports {

namespace {

constexpr std::array columns = {
    "subject",   "scalar",     "property",   "operation",    "block",      "band",       "axis",   "low",
    "high",      "count",      "max_eps",    "p99_eps",      "median_eps", "max_excess", "budget", "rule",
    "ill_posed", "unresolved", "not_finite", "wrong_branch", "refused",    "unmeasured", "status"};

std::string cell(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return properties::csv_field(value);
  if (value.is_number_float()) return fmt::format("{:.17g}", value.get<double>());
  return dumped(value);
}

/// One line for each result; the numbers of the worst input are hexadecimal and separated by spaces.
std::string csv(const Merged& merged) {
  std::string out = fmt::format("{},worst_id,worst_kappa,worst_input\r\n", fmt::join(columns, ","));
  for (const Json& row : merged.results) {
    for (const char* name : columns) out += cell(row.value(name, Json())) + ',';
    const Json& worst = row["worst"];
    if (!has_worst(row))
      out += ",,";
    else
      out += properties::csv_field(worst["id"]) + ',' + cell(worst.value("kappa", Json())) + ',' +
             properties::csv_field(
                 fmt::format("{}", fmt::join(worst["input"].get<std::vector<std::string>>(), " ")));
    out += "\r\n";
  }
  return out;
}

}  // namespace

ReportFiles write_report(const std::vector<std::filesystem::path>& records,
                         const std::filesystem::path& out_dir) {
  const Merged merged = merge_records(records);
  Json whole;  // without a second copy, which a list of members would make
  whole["records"] = merged.records, whole["results"] = merged.results;
  const std::string html = page(merged, whole);
  for (const auto& [kind, all] : merged.measurements) whole[kind] = all;
  properties::make_folder("--out", out_dir.string());
  const ReportFiles files{properties::file_in(out_dir, "report.html"),
                          properties::file_in(out_dir, "report.json"),
                          properties::file_in(out_dir, "report.csv")};
  std::error_code error;
  for (const auto& record : records)
    for (const auto& file : {files.html, files.json, files.csv})
      if (std::filesystem::equivalent(record, file, error))
        throw std::runtime_error(
            fmt::format("{}: the report in {} would overwrite this record: choose another folder",
                        record.string(), out_dir.string()));
  const properties::Unfinished all_three;  // a signal between two files would leave those of two reports
  properties::write_whole(files.json, dumped(whole, 1) + '\n');
  properties::write_whole(files.csv, csv(merged));
  properties::write_whole(files.html, html);
  return files;
}

}  // namespace liecheck::reports
