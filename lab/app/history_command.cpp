#include <fmt/format.h>
#include <algorithm>
#include <campaign/robots.hpp>
#include <history/bench.hpp>
#include <support/say.hpp>
#include <support/stop.hpp>
#include "lab_commands.hpp"

namespace liecheck::properties {

namespace {

struct HistoryFlags {
  HistoryBench bench;
  bool list = false;
  std::string json;
};

void print_row(const HistoryRow& row) {
  const HistoricBug& b = *row.bug;
  const FirstFailure& f = row.faulty;
  if (b.kind == HistoryKind::not_expressed) {
    say("{:<25} {:<14}{}\n", b.name, row.verdict(), b.wrong);
  } else {
    const std::string digits = f.by.empty()        ? "-"
                               : f.outcome.empty() ? fmt::format("{:.1f}", f.digits_lost())
                                                   : f.outcome;
    say("{:<25} {:<14}{:>6}{:>8.3f}  {:<13}{:<60} {}\n", b.name, row.verdict(), f.cases, f.seconds, digits,
        f.by.empty() ? "-" : f.by, f.replay.substr(0, 160));
    if (row.verdict() == "INCOMPLETE") {
      const FirstFailure& open = f.by.empty() && !f.in_time ? f : row.fixed;
      say("  {}\n", open.in_time ? "without a verdict: " + open.not_measured + f.not_measured
                                 : fmt::format("the time was up after {} cases", open.cases));
    }
    if (!row.fixed.by.empty()) say("  the repaired form: {}; {}\n", row.fixed.by, row.fixed.replay);
  }
  std::fflush(stdout);
}

void print_summary(const HistoryBench& b) {
  double slowest = 0;
  std::uint64_t most = 0, silent = 0;
  for (const HistoryRow& r : b.rows)
    if (r.verdict() == "found")
      slowest = std::max(slowest, r.faulty.seconds), most = std::max(most, r.faulty.cases), ++silent;
  say("\n{}found {} of {} bugs, the last after {} cases, the slowest in {:.2f} s; {} repaired forms and {} "
      "of {} controls silent "
      "in {} cases of each law from case {} on; {} not expressed; seed {}, double\n",
      b.complete ? "" : "interrupted: ", b.count("found"),
      std::count_if(b.rows.begin(), b.rows.end(), [](auto& r) { return r.bug->kind == HistoryKind::bug; }),
      most, slowest, silent, b.count("silent"),
      std::count_if(b.rows.begin(), b.rows.end(),
                    [](auto& r) { return r.bug->kind == HistoryKind::control; }),
      b.cases, b.from, b.count("not expressed"), b.seed);
}

int run(const HistoryFlags& f) {
  if (f.list) {
    say("{}", history_table());
    return within_budget;
  }
  const auto rows = history_rows(f.bench.names);
  const Robot robot = built_in_robot();
  stop_on_signals();
  HistoryBench bench = f.bench;
  say("{:<25} {:<14}{:>6}{:>8}  {:<13}{:<60} {}\n", "history:", "", "cases", "s", "digits lost", "found by",
      "first failing input: liecheck replay ...");
  for (const HistoricBug* bug : rows) {
    HistoryRow row = measure(*bug, bench, robot);
    if (stop_requested) break;
    print_row(row);
    bench.rows.push_back(std::move(row));
  }
  bench.complete = bench.rows.size() == rows.size();
  do_both([&] { write_record_of(f.json, bench); }, [&] { print_summary(bench); });
  if (!bench.complete) return incomplete;
  return !bench.passed() ? property_failed : bench.measured() ? within_budget : incomplete;
}

}  // namespace

Command history_command(CLI::App& lab) {
  CommandWith<HistoryFlags> a(
      lab, "history",
      "measure how soon the laws find bugs that were reported against real libraries. Check that the "
      "repaired forms and the controls pass. Exit code 0 if so; 1 if a bug is not found or a "
      "repaired form fails; 2 for bad input; 3 if stopped, or if a case has no verdict");
  HistoryBench& b = a->bench;
  a.list("NAME", b.names, "NAME", "a row of fixtures/history/README.md, repeatable; default all");
  a.toggle("--list", a->list, "print the rows in Markdown, and run nothing");
  a.number("--cases", b.cases, 1, 1000000000, "cases of each law, for each form that does not fail before");
  a.number("--from", b.from, 0, 1000000000000, "index of the first case, to run many cases in pieces");
  a.duration("--for-each", b.seconds, "at most this time for each form: 30s, 5m; default 60s");
  a.seed(b.seed, "seed of the cases");
  a.json(a->json, "write the table to FILE");
  return a.runs(run);
}

}  // namespace liecheck::properties
