#pragma once
// Measures the rows of history.hpp: how soon a law finds each faulty form, and that the repaired forms and the
// controls stay silent.

#include <history/first_failure.hpp>
#include <history/history.hpp>

namespace liecheck::properties {

struct HistoryRow {
  const HistoricBug* bug = nullptr;
  FirstFailure faulty, fixed;  ///< the repaired form has all of its cases, unless it is accused
  /// "found", "NOT FOUND", "silent" of a control, "ACCUSED", "INCOMPLETE" or "not expressed".
  std::string verdict() const;
  bool accused() const;  ///< the repaired form or the control failed
  bool passed() const {
    return verdict() == "found" || verdict() == "silent" || verdict() == "not expressed";
  }
};

struct HistoryBench {
  std::vector<std::string> names;  ///< of the rows to run; empty: all
  std::uint64_t seed = 42, from = 0, cases = 1000;
  double seconds = 60;  ///< at most for a form of a tree's row, whose cases take longer
  std::vector<HistoryRow> rows;
  bool complete = false;  ///< every row was measured

  std::size_t count(const std::string& verdict) const;
  bool passed() const;
  bool measured() const { return count("INCOMPLETE") == 0; }
};

/// The rows that are named, or all. Throws std::invalid_argument for a name that is not known.
std::vector<const HistoricBug*> history_rows(const std::vector<std::string>& names);

/// Measures one row. The profile careful judges: a report's repaired form need not reach liecheck's own limits.
HistoryRow measure(const HistoricBug& bug, const HistoryBench& bench, const Robot& robot);

/// The table of fixtures/history/README.md in Markdown.
std::string history_table();

}  // namespace liecheck::properties
