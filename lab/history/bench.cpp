#include <fmt/format.h>
#include <algorithm>
#include <history/bench.hpp>
#include <stdexcept>
#include <support/stop.hpp>

namespace liecheck::properties {

bool HistoryRow::accused() const {
  return !fixed.by.empty() || (bug->kind == HistoryKind::control && !faulty.by.empty());
}

std::string HistoryRow::verdict() const {
  const bool control = bug->kind == HistoryKind::control;
  if (bug->kind == HistoryKind::not_expressed) return "not expressed";
  if (accused()) return "ACCUSED";
  if (!control && faulty.by.empty()) return faulty.in_time ? "NOT FOUND" : "INCOMPLETE";
  const auto open = [](const FirstFailure& f) {
    return !f.in_time || f.cases == 0 || !f.not_measured.empty();
  };
  if (open(fixed) || (control && open(faulty))) return "INCOMPLETE";
  return control ? "silent" : "found";
}

std::size_t HistoryBench::count(const std::string& verdict) const {
  return static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [&](const HistoryRow& r) { return r.verdict() == verdict; }));
}

bool HistoryBench::passed() const {
  return std::all_of(rows.begin(), rows.end(),
                     [](const HistoryRow& r) { return r.passed() || r.verdict() == "INCOMPLETE"; });
}

std::vector<const HistoricBug*> history_rows(const std::vector<std::string>& names) {
  std::vector<const HistoricBug*> all;
  for (const HistoricBug& b : historic_bugs())
    if (names.empty() || std::ranges::find(names, b.name) != names.end()) all.push_back(&b);
  for (const std::string& name : names)
    if (std::ranges::none_of(all, [&](auto* b) { return b->name == name; }))
      throw std::invalid_argument(
          fmt::format("history: unknown name '{}'; fixtures/history/README.md lists them", name));
  return all;
}

HistoryRow measure(const HistoricBug& bug, const HistoryBench& bench, const Robot& robot) {
  HistoryRow row{&bug, {}, {}};
  if (bug.kind == HistoryKind::not_expressed) return row;
  const auto search = [&](bool fixed) {
    const std::string name = bug.subject(fixed);
    return first_failure({{{name}, {}, {"double"}, {}, {{name, Profile::careful}}},
                          bench.seed,
                          bench.from,
                          bench.cases,
                          bench.seconds},
                         robot);
  };
  row.faulty = search(false);
  if (!stop_requested) row.fixed = search(true);
  return row;
}

std::string history_table() {
  std::string table =
      "| name | library | source | operation | inputs | symptom | what was wrong "
      "|\n|---|---|---|---|---|---|---|\n";
  for (const HistoricBug& b : historic_bugs()) {
    const char* kind = b.kind == HistoryKind::control ? " (control)"
                       : b.kind == HistoryKind::bug   ? ""
                                                      : " (not expressed)";
    table += fmt::format("| `{}`{} | {} | {} | {} | {} | {} | {} |\n", b.name, kind, b.library, b.thread,
                         b.forms.operation.empty() ? "-" : b.forms.operation, b.region, b.symptom, b.wrong);
  }
  return table;
}

}  // namespace liecheck::properties
