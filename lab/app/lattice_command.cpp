#include <fmt/format.h>
#include <algorithm>
#include <campaign/robots.hpp>
#include <cstdio>
#include <lattice/lattice.hpp>
#include <map>
#include <results/bench.hpp>
#include <support/say.hpp>
#include "lab_commands.hpp"

namespace liecheck::properties {

namespace {

struct LatticeFlags {
  LatticeOptions options;
  unsigned percent = 0;
  bool conditions = false;
  std::string json;
};

/// The verdicts on the faults of one operation with one family of triggers.
struct Cell {
  std::size_t faults = 0, within[3] = {}, granted = 0, missed = 0, unfired = 0;
  std::uint64_t slowest = 0;

  void add(const LatticeRow& row) {
    ++faults;
    const FaultVerdict& v = row.verdict;
    for (std::size_t i = 0, cases = 1000; i < std::size(within); ++i, cases *= 10)
      within[i] += row.found_within(cases);
    slowest = std::max(slowest, v.cases);
    granted += !row.counts();
    missed += v.found == Found::unseen;
    unfired += v.found == Found::unfired;
  }
};

void print_line(const std::string& operation, const std::string& family, const Cell& c) {
  say("{:<32}{:<20}{:>7}{:>8}{:>8}{:>8}{:>9}{:>9}{:>8}{:>8}\n", operation, family, c.faults, c.within[0],
      c.within[1], c.within[2], c.slowest ? std::to_string(c.slowest) : "-", c.granted, c.missed, c.unfired);
}

void print_table(const LatticeResult& r) {
  say("{:<32}{:<20}{:>7}{:>8}{:>8}{:>8}{:>9}{:>9}{:>8}{:>8}\n", "operation", "trigger", "faults", "in 10^3",
      "in 10^4", "in 10^5", "slowest", "granted", "unseen", "unfired");
  const auto position = [](const std::string& operation) {
    const auto& all = all_operations();
    return std::find_if(all.begin(), all.end(), [&](auto* o) { return o->name == operation; }) - all.begin();
  };
  const auto family_position = [](const std::string& family) {
    const auto& all = triggers();
    return std::find_if(all.begin(), all.end(), [&](auto& t) { return t.family == family; }) - all.begin();
  };
  std::map<std::pair<std::ptrdiff_t, std::ptrdiff_t>, std::pair<const LatticeRow*, Cell>> cells;
  Cell total;
  for (const LatticeRow& row : r.rows) {
    auto& [first, cell] = cells[{position(row.operation), family_position(row.family)}];
    first = &row;
    cell.add(row), total.add(row);
  }
  for (const auto& [where, cell] : cells) print_line(cell.first->operation, cell.first->family, cell.second);
  print_line("all", "", total);
}

/// What was not found, by trigger, with the operations in which it was not.
void print_holes(const LatticeResult& r) {
  std::map<std::string, std::map<std::string, std::size_t>> holes;
  for (const LatticeRow& row : r.rows)
    if (row.counts() && row.verdict.found != Found::found) {
      const std::string what = row.verdict.share > 0 ? row.trigger + ", " + row.change : row.trigger;
      ++holes[fmt::format("{}: {}", found_words[static_cast<std::size_t>(row.verdict.found)], what)]
             [fmt::format("{} ({:.2g} %)", row.operation, 100 * row.verdict.share)];
    }
  if (!holes.empty()) say("\nnot found (with the share of a law's cases in which the trigger fired):\n");
  for (const auto& [what, operations] : holes) {
    std::string list;
    for (const auto& [operation, count] : operations) list += (list.empty() ? "" : ", ") + operation;
    say("  {}: {}\n", what, list);
  }
}

/// How often a finding would tell where a fault acts, and each that it would not tell rightly.
void print_told(const LatticeResult& r, bool each) {
  std::map<Told, std::size_t> told;
  for (const LatticeRow& row : r.rows) ++told[row.verdict.told];
  const std::size_t asked = told[Told::right] + told[Told::other] + told[Told::silent];
  if (asked == 0) return;
  for (const LatticeRow& row : r.rows)
    if (each && (row.verdict.told == Told::other || row.verdict.told == Told::silent))
      say("told of {} {} {}, {}, where {}: {}\n", row.subject, row.operation, row.block, row.change,
          row.trigger, row.verdict.told == Told::silent ? "nothing" : row.verdict.condition);
  say("of {} found faults whose trigger is no angle, the condition is told rightly of {}, as another one of "
      "{}, and not of "
      "{}\n",
      asked, told[Told::right], told[Told::other], told[Told::silent]);
}

int run(const LatticeFlags& f) {
  const Robot robot = built_in_robot();
  stop_on_signals();
  LatticeOptions options = f.options;
  options.least_share = f.percent / 100.0;
  const LatticeResult r = run_lattice(options, robot);
  print_table(r);
  print_holes(r);
  say("\n");
  print_told(r, f.conditions);
  for (const auto& [subject, share] : r.failures_of_base)
    if (share > 0)
      say("base {} fails {:.2g} % of its cases without a fault; they were left out\n", subject, 100 * share);
  say("{} faults{}; of {} with a trigger in 1 % of a law's cases, {} found within 1000 cases; seed {}, {}\n",
      r.rows.size(), r.complete ? "" : " (interrupted)", r.common(), r.common_found(), f.options.seed,
      f.options.scalar);
  write_record_of(f.json, r);
  return !r.complete ? incomplete : r.passed() ? within_budget : property_failed;
}

}  // namespace

Command lattice_command(CLI::App& lab) {
  CommandWith<LatticeFlags> a(
      lab, "lattice",
      "plant thousands of small faults in correct subjects. Each is active only under a "
      "condition on the arguments; count the cases until a law finds it. Exit code 0 if "
      "99 % of those whose condition holds in 1 % of the cases are found within 1000 cases; 1 "
      "otherwise; 2 for bad input; 3 if stopped");
  LatticeOptions& o = a->options;
  a.list("--subject", o.subjects, "NAME",
         "a correct subject to plant faults in, repeatable; default liecheck, liecheck:fast, look-alikes, "
         "eigen, textbook");
  a.list("--operation", o.operations, "OP", "an operation, repeatable; default every one");
  a.choice("--scalar", o.scalar, {"float", "double"}, "SCALAR", "float or double").with_default_in_help();
  a.seed(o.seed, "seed of the cases and of the faults");
  a.number("--cases", o.cases, 1, 100000,
           "cases of each law; beyond 1000 only for rarer triggers, and a tenth for trees");
  a.number("--faults", o.faults, 1, 1000000, "a random sample of N faults; default all");
  a.number("--percent", a->percent, 1, 100, "only triggers that fire in N % of the cases of a law");
  a.toggle("--conditions", a->conditions,
           "print what a finding would say of where a fault acts, if that is not right");
  a.duration("--for", o.seconds, "stop after this time: 30s, 5m");
  a.updated("--resume", o.resume, "FILE", "append each verdict to FILE, and continue what FILE contains");
  a.json(a->json, "write the table to FILE");
  return a.runs(run);
}

}  // namespace liecheck::properties
