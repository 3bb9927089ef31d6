#include <fmt/format.h>
#include <algorithm>
#include <app/command.hpp>
#include <chrono>
#include <hard_cases/hard_cases.hpp>
#include <record/bench.hpp>
#include <search/weak_tests.hpp>
#include <subjects/known_bugs.hpp>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

struct Flags {
  BugBench bench;  ///< seed, scalar and seconds; a look-alike gets a tenth of the seconds
  std::string json;
  RobotFlags robot;
};

/// Runs `cases` cases of a series, from case `from` on. Sets the first failure, as "law: operation, block",
/// and the first output without a verdict.
void take_cases(BugRow& bug, const Series& s, std::uint64_t seed, std::uint64_t from, std::uint64_t cases) {
  Tally tally;
  for (std::uint64_t i = from; i < from + cases && !stop_requested; ++i) s.run(seed, i, tally);
  bug.cases += cases;
  for (const auto& [cell, row] : tally.rows) {
    const Output& o = s.outputs.at(static_cast<std::size_t>(cell.first));
    const auto set = [&](std::string& text) {
      if (text.empty()) text = fmt::format("{}: {}, {}", s.property, o.operation, o.block);
    };
    if (row.failed > 0) set(bug.by);
    if (row.unresolved + row.unmeasured > 0) set(bug.not_measured);
  }
}

void take_hard_cases(BugRow& bug, const std::vector<HardRow>& rows) {
  bug.cases += rows.size();
  for (const HardRow& row : rows)
    for (const HardCell& cell : row.cells) {
      const auto set = [&](std::string& text) {
        if (text.empty())
          text = fmt::format("hard case {}: {}, {}", row.entry->name, cell.operation, cell.block);
      };
      if (cell.failed) set(bug.by);
      if (cell.open) set(bug.not_measured);
    }
}

/// Runs rounds of cases over all laws, and the hard cases after the first round, until a case fails.
void hunt_down(BugRow& bug, const BugBench& bench, const Robot& robot) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  const double seconds = bug.alike() ? bench.seconds_each / 10 : bench.seconds_each;
  const Selection selection{{bug.name}, {}, {bench.scalar}};
  const auto all = select(selection, robot);
  constexpr std::uint64_t round = 64;
  for (std::uint64_t from = 0; bug.by.empty() && elapsed() < seconds && !stop_requested; from += round) {
    for (const auto& s : all) {
      take_cases(bug, *s, bench.seed, from, round);
      if (!bug.by.empty()) break;
    }
    if (from == 0 && bug.by.empty()) take_hard_cases(bug, run_hard_cases(selection, robot));
  }
  if (!bug.alike() || !bug.by.empty()) bug.not_measured.clear();
  if (bug.alike() && bug.cases == 0) bug.not_measured = "no case";
  bug.seconds = elapsed();
  bug.killed = !bug.by.empty();
}

void print_header() {
  fmt::print("{:<34} {:<10}{:>9}{:>9}  {:<52}", "known bug", "", "cases", "s", "killed by");
  for (const WeakStyle& w : weak_styles()) fmt::print("{:>14}", w.name);
  fmt::print("\n");
}

void print_row(const BugRow& bug) {
  std::string marks;
  for (const auto& [name, seen] : bug.weaker_styles) marks += fmt::format("{:>14}", seen ? "killed" : "-");
  const char* verdict = bug.alike() ? (bug.killed                 ? "REFUSED"
                                       : bug.not_measured.empty() ? "passes"
                                                                  : "INCOMPLETE")
                                    : (bug.killed ? "killed" : "SURVIVES");
  fmt::print("{:<34} {:<10}{:>9}{:>9.3f}  {:<52}{}\n", bug.name, verdict, bug.cases, bug.seconds,
             !bug.by.empty()            ? bug.by
             : bug.not_measured.empty() ? "-"
                                        : "not measured: " + bug.not_measured,
             marks);
  std::fflush(stdout);
}

void print_summary(const BugBench& b) {
  double slowest = 0;
  for (const BugRow& bug : b.rows)
    if (!bug.alike()) slowest = std::max(slowest, bug.seconds);
  if (!b.complete)
    fmt::print("\ninterrupted after {} of {} subjects", b.rows.size(), known_bug_table().size());
  fmt::print(
      "\nkilled {} of {} bugs, the slowest in {:.2f} s of {} s each; {} of {} look-alikes refused; seed {}, "
      "{}\n",
      b.count(false, true), b.count(false), slowest, b.seconds_each, b.count(true, true), b.count(true),
      b.seed, b.scalar);
  for (std::size_t i = 0; i < weak_styles().size(); ++i)
    fmt::print("{:<14} kills {:>3} of {}\n", weak_styles()[i].name,
               std::count_if(b.rows.begin(), b.rows.end(),
                             [i](const BugRow& bug) { return !bug.alike() && bug.weaker_styles[i].second; }),
               b.count(false));
}

int run(const Flags& f) {
  const Robot robot = f.robot.read();
  stop_on_signals();
  BugBench bench = f.bench;
  const auto tested = subjects<double>();
  print_header();
  for (const KnownBug& known : known_bug_table()) {
    if (stop_requested) break;
    BugRow bug;
    bug.name = known.name, bug.fault = known.fault, bug.origin = known.origin;
    hunt_down(bug, bench, robot);
    if (stop_requested && !bug.killed) break;  // the bug did not get all of its time
    const auto subject =
        std::find_if(tested.begin(), tested.end(), [&](const auto* s) { return s->name == bug.name; });
    for (const WeakStyle& w : weak_styles())
      bug.weaker_styles.emplace_back(w.name, w.kills((*subject)->operations));
    print_row(bug);
    bench.rows.push_back(std::move(bug));
  }
  bench.complete = !stop_requested;
  do_both([&] { write_record_of(f.json, bench); }, [&] { print_summary(bench); });
  if (!bench.complete) return incomplete;
  return !bench.passed() ? property_failed : bench.measured() ? within_budget : incomplete;
}

}  // namespace

Command bench_bugs_command(CLI::App& bench) {
  CommandWith<Flags> a(bench, "bugs",
                       "how soon the laws kill each known bug, compared with four weaker styles of test. "
                       "Exit code 0 if all bugs are killed and no look-alike is refused; 1 otherwise; 2 for "
                       "bad input; 3 if stopped, or if a case of a look-alike has no verdict");
  BugBench& b = a->bench;
  b.scalar = "double";
  a.choice("--scalar", b.scalar, {"float", "double"}, "SCALAR", "float or double").with_default_in_help();
  a.seed(b.seed, "seed of the cases");
  a.duration("--for-each", b.seconds_each,
             "time for each bug: 30s, 5m; default 60s; each look-alike gets a tenth of it");
  a.json(a->json, "write the table to FILE");
  a->robot.add(a);
  return a.runs(run);
}

}  // namespace liecheck::properties
