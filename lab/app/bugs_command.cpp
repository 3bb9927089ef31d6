#include <fmt/format.h>
#include <algorithm>
#include <bugs/causes.hpp>
#include <bugs/known_bugs.hpp>
#include <bugs/weak_tests.hpp>
#include <history/first_failure.hpp>
#include <map>
#include <results/bench.hpp>
#include <support/say.hpp>
#include <support/stop.hpp>
#include "lab_commands.hpp"

namespace liecheck::properties {

namespace {

struct BugsFlags {
  BugBench bench;  ///< seed, scalar and seconds; a look-alike gets a tenth of the seconds and cases
  std::uint64_t cases = 0;
  bool causes = false;
  std::string json;
  RobotFlags robot;
};

/// Runs the subject until a case fails.
void hunt_down(BugRow& bug, const BugBench& bench, std::uint64_t cases, const Robot& robot) {
  const std::uint64_t most = cases ? cases : std::numeric_limits<std::uint64_t>::max();
  const FirstFailure f = first_failure({{{bug.name}, {}, {bench.scalar}},
                                        bench.seed,
                                        0,
                                        bug.alike() ? std::max<std::uint64_t>(most / 10, 1) : most,
                                        bug.alike() ? bench.seconds_each / 10 : bench.seconds_each},
                                       robot);
  bug.by = f.by, bug.cases = f.cases, bug.seconds = f.seconds, bug.killed = !f.by.empty();
  if (bug.alike() && !bug.killed) bug.not_measured = f.cases == 0 ? "no case" : f.not_measured;
}

void print_header() {
  say("{:<34} {:<10}{:>9}{:>9}  {:<52}", "known bug", "", "cases", "s", "killed by");
  for (const WeakStyle& w : weak_styles()) say("{:>14}", w.name);
  say("\n");
}

void print_row(const BugRow& bug) {
  std::string marks;
  for (const auto& [name, seen] : bug.weaker_styles) marks += fmt::format("{:>14}", seen ? "killed" : "-");
  const char* verdict = bug.alike() ? (bug.killed                 ? "REFUSED"
                                       : bug.not_measured.empty() ? "passes"
                                                                  : "INCOMPLETE")
                                    : (bug.killed ? "killed" : "SURVIVES");
  say("{:<34} {:<10}{:>9}{:>9.3f}  {:<52}{}\n", bug.name, verdict, bug.cases, bug.seconds,
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
  if (!b.complete) say("\ninterrupted after {} of {} subjects", b.rows.size(), known_bug_table().size());
  say("\nkilled {} of {} bugs, the slowest in {:.2f} s of {} s each; {} of {} look-alikes refused; seed {}, "
      "{}\n",
      b.count(false, true), b.count(false), slowest, b.seconds_each, b.count(true, true), b.count(true),
      b.seed, b.scalar);
  for (std::size_t i = 0; i < weak_styles().size(); ++i)
    say("{:<14} kills {:>3} of {}\n", weak_styles()[i].name,
        std::count_if(b.rows.begin(), b.rows.end(),
                      [i](const BugRow& bug) { return !bug.alike() && bug.weaker_styles[i].second; }),
        b.count(false));
}

/// Prints the bench of causes: each form, then a table by cause.
int run_causes(const BugsFlags& f) {
  stop_on_signals();
  std::map<std::string, std::map<Named, std::size_t>> table;
  for (const CauseRow& row : bench_of_causes(f.bench.seed)) {
    say("{:<42} {:<10} {}{}\n", row.form, named_words[static_cast<std::size_t>(row.named)], row.where,
        row.guess.empty() ? "" : "; perhaps " + row.guess);
    ++table[row.cause][row.named], ++table["all"][row.named];
  }
  say("\n{:<36}", "cause");
  for (const char* word : named_words) say("{:>11}", word);
  for (const auto& [cause, counts] : table) {
    say("\n{:<36}", cause);
    for (std::size_t i = 0; i < std::size(named_words); ++i)
      say("{:>11}", counts.contains(Named(i)) ? counts.at(Named(i)) : 0);
  }
  say("\n");
  return stop_requested ? incomplete : within_budget;
}

int run(const BugsFlags& f) {
  if (f.causes) return run_causes(f);
  const Robot robot = f.robot.read();
  stop_on_signals();
  BugBench bench = f.bench;
  const auto tested = typed_subjects<double>();
  print_header();
  for (const KnownBug& known : known_bug_table()) {
    if (stop_requested) break;
    BugRow bug;
    bug.name = known.name, bug.fault = known.fault, bug.origin = known.origin;
    hunt_down(bug, bench, f.cases, robot);
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

Command bugs_command(CLI::App& lab) {
  CommandWith<BugsFlags> a(lab, "bugs",
                       "measure how soon the laws find each known bug, beside four weaker styles of test. "
                       "Exit code 0 if all bugs are found and every look-alike passes; 1 otherwise; 2 for "
                       "bad input; 3 if stopped, or if a case of a look-alike has no verdict");
  BugBench& b = a->bench;
  b.scalar = "double";
  a.choice("--scalar", b.scalar, {"float", "double"}, "SCALAR", "float or double").with_default_in_help();
  a.seed(b.seed, "seed of the cases");
  a.duration("--for-each", b.seconds_each,
             "time for each bug: 30s, 5m; default 60s; each look-alike gets a tenth of it");
  a.number("--cases", a->cases, 1, 1000000000,
           "cases of each law for each bug, at most; each look-alike gets a tenth");
  a.toggle("--causes", a->causes, "in place of that, how often a finding names the cause of a faulty form");
  a.json(a->json, "write the table to FILE");
  a->robot.add(a);
  return a.runs(run);
}

}  // namespace liecheck::properties
