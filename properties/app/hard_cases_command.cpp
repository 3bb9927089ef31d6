#include <fmt/format.h>
#include <algorithm>
#include <app/campaign_run.hpp>
#include <app/command.hpp>
#include <array>
#include <failures/result.hpp>
#include <hard_cases/hard_cases.hpp>
#include <hard_cases/shared.hpp>
#include <map>
#include <set>
#include <stdexcept>
#include <support/files.hpp>
#include <support/folder.hpp>
#include <support/say.hpp>
#include <support/stop.hpp>
#include <support/text.hpp>
#include <tuple>

namespace liecheck::properties {

namespace {

struct HardCasesFlags {
  SelectionFlags selection;
  std::vector<std::string> files;
  unsigned jobs = 1;
  std::string share;
};

/// The built-in hard cases and those in `files`.
std::vector<HardCase> corpus_with(const std::vector<std::string>& files) {
  std::vector<HardCase> all = built_in_corpus();
  for (const std::string& path : files) {
    const auto more = read_corpus(path);
    all.insert(all.end(), more.begin(), more.end());
  }
  check_names_differ(all);
  return all;
}

/// Subject and scalar of a column; sorted by the subject's name and the scalar's width.
struct Column {
  std::string subject;
  int width;
  std::string scalar;
  auto operator<=>(const Column&) const = default;
};

Column column_of(const HardCell& c) {
  return {c.subject, c.scalar == "float" ? 0 : c.scalar == "double" ? 1 : 2, c.scalar};
}
std::set<Column> columns_of(const std::vector<HardRow>& rows) {
  std::set<Column> all;
  for (const HardRow& r : rows)
    for (const HardCell& c : r.cells) all.insert(column_of(c));
  return all;
}

constexpr Verdict verdicts[] = {Verdict::stable,       Verdict::refused,    Verdict::ill_posed,
                                Verdict::unmeasured,   Verdict::unresolved, Verdict::inaccurate,
                                Verdict::wrong_branch, Verdict::not_finite, Verdict::bad_call};

void print_failure(const HardRow& r, const HardCell& c) {
  const HardCase& e = *r.entry;
  say("\n{}  {}, {}: hard case {} ({})\n", c.failed ? "FAILED" : "NO VERDICT", c.operation, c.block, e.name,
      e.hard_class);
  say("  reason    {}\n", e.reason);
  say("  subject   {} in {}: {}\n", c.subject, c.scalar, name_of(c.verdict));
  say("  where     {}: {}, block {}, band {}\n", r.property, c.operation, c.block, c.band);
  if (c.verdict == Verdict::inaccurate)
    say("  error     {:.4g} eps{}\n", c.error, c.kappa > 0 ? fmt::format(", kappa {:.3g}", c.kappa) : "");
  else
    say("  error     {}{}\n", name_of(c.verdict), c.refusal.empty() ? "" : ": " + c.refusal);
  say("  budget    {:g} {}\n", c.budget, c.excess ? "eps kappa" : "eps");
  say("  input     {}\n  origin    {} ({})\n", e.input, e.origin, e.place());
  say("  replay    {}\n", replay_words(c.id.text(), c.flags));
}

/// What the limit is compared with.
double score_of(const HardCell& c) {
  return c.excess && c.kappa > 0 ? c.error / c.kappa : c.error;
}

/// How bad a verdict is, and then how far the error is over its limit.
std::pair<Verdict, double> severity(const HardCell& c) {
  return {c.verdict, score_of(c) / c.budget};
}

std::string what(const HardCell& c) {
  if (c.verdict != Verdict::inaccurate) return name_of(c.verdict);
  const double eps = c.scalar == "float" ? 0x1p-23 : c.scalar == "double" ? 0x1p-52 : 0x1p-112;
  const std::string digits = digits_lost(score_of(c), eps);
  return digits.empty() ? fmt::format("{:.3g} eps", score_of(c)) : digits;
}

/// Prints a line for each block of an operation that fails in the same way, worst first, and then the worst case.
void print_failures_by_block(const std::vector<HardRow>& rows) {
  struct Group {
    std::size_t failed = 0;
    const HardRow* row = nullptr;
    const HardCell* worst = nullptr;
  };
  std::map<std::tuple<std::string, std::string, std::string, std::string, Verdict>, Group> groups;
  for (const HardRow& r : rows)
    for (const HardCell& c : r.cells)
      if (c.failed || c.open) {
        Group& g = groups[{c.subject, c.scalar, c.operation, c.block, c.verdict}];
        if (++g.failed == 1 || severity(*g.worst) < severity(c)) g.row = &r, g.worst = &c;
      }
  std::vector<Group> all;
  for (const auto& [key, group] : groups) all.push_back(group);
  std::ranges::stable_sort(
      all, [](const Group& a, const Group& b) { return severity(*b.worst) < severity(*a.worst); });
  std::vector<std::array<std::string, 5>> lines{
      {"hard cases that fail, worst first", "", "worst of them", "failing", "the worst"}};
  for (const auto& [failed, row, worst] : all)
    lines.push_back({worst->operation + " " + worst->block, worst->subject + " in " + worst->scalar,
                     what(*worst), std::to_string(failed), row->entry->name});
  say("\n");
  for (const auto& line : lines)
    say("{:<34}  {:<24}  {:<26}{:>7}  {}\n", line[0], line[1], line[2], line[3], line[4]);
  print_failure(*all.front().row, *all.front().worst);
  std::set<std::string> subjects;
  for (const Group& g : all)
    subjects.insert(g.worst->flags.empty() ? " --subject " + g.worst->subject : g.worst->flags);
  say("\n{} prints each in full\n", as_typed(fmt::format("hard-cases{}", fmt::join(subjects, ""))));
}

/// Prints a line for each case, with a letter for each subject and scalar.
void print_hard_case_table(const std::vector<HardRow>& rows) {
  const auto columns = columns_of(rows);
  std::size_t width = 0, law = 0;
  std::vector<std::string> classes;  // in the order of the corpus
  for (const HardRow& r : rows) {
    width = std::max(width, r.entry->name.size() + 3);
    law = std::max(law, r.property.size() + 1);
    if (std::find(classes.begin(), classes.end(), r.entry->hard_class) == classes.end())
      classes.push_back(r.entry->hard_class);
  }
  std::size_t i = 0;
  for (const Column& column : columns) {
    say("{:>{}} {} in {}\n", i + 1, width + law + 2 * i + 1, column.subject, column.scalar);
    ++i;
  }
  for (const std::string& hard_class : classes) {
    say("{}\n", hard_class);
    for (const HardRow& r : rows) {
      if (r.entry->hard_class != hard_class) continue;
      say("{:<{}}{:<{}}", "  " + r.entry->name, width, r.property, law);
      for (const auto& [subject, rank, scalar] : columns) {
        const auto cell = std::find_if(r.cells.begin(), r.cells.end(), [&](const HardCell& c) {
          return c.subject == subject && c.scalar == scalar;
        });
        say("{} ", cell == r.cells.end() ? '-' : letter_of(cell->verdict));
      }
      say("\n");
    }
  }
  for (const Verdict v : verdicts) say("{} {}   ", letter_of(v), name_of(v));
  say("- not offered, not for this scalar, or outside the domain\n\n");
}

/// Writes the cases as JSON for other programs.
int share(const std::vector<HardCase>& cases, const std::string& folder) {
  stop_on_signals();
  const SharedCorpus corpus = shared_corpus(cases);
  if (stop_requested) {
    std::fputs("interrupted: nothing was written\n", stderr);
    return incomplete;
  }
  make_folder("--share", folder);
  std::size_t bytes = 0;
  for (const auto& [operation, text] : corpus.files) file_in(folder, operation + ".json");
  for (const auto& [operation, text] : corpus.files) {
    write_whole(file_in(folder, operation + ".json"), text);
    bytes += text.size();
  }
  say("{} cases of {} operations, from {} hard cases, {} kB; {} without a result of the oracles are left "
      "out\n",
      corpus.cases, corpus.files.size(), corpus.names, bytes / 1000, corpus.unresolved);
  return within_budget;
}

int run(const HardCasesFlags& f) {
  if (!f.share.empty()) return share(corpus_with(f.files), f.share);
  StoredRun no_cases;
  no_cases.result.options.cases = 0;
  no_cases.result.robot = built_in_robot();
  const auto cases = corpus_with(f.files);
  const Selection selection = f.selection.selection();
  stop_on_signals();
  const auto rows = run_hard_cases(selection, no_cases.result.robot, cases, f.jobs);
  const bool interrupted = stop_requested;  // a signal that comes later interrupts nothing
  no_cases.result.incomplete = interrupted;
  if (rows.empty() && !interrupted)
    throw std::invalid_argument("nothing to run: no selected subject offers a hard case's property");
  do_both([&] { write_campaign_record(f.selection.json, no_cases, rows); },
          [&] {
            print_hard_case_table(rows);
            print_hard_case_summary(rows, true);
          });
  if (interrupted) {
    std::fputs("interrupted: the table has only the rows that were done\n", stderr);
    return incomplete;
  }
  return any_failed(rows) ? property_failed : any_open(rows) ? incomplete : within_budget;
}

}  // namespace

void print_hard_case_summary(const std::vector<HardRow>& rows, bool in_full) {
  if (rows.empty()) {
    say("hard cases: the selected properties have none\n");
    return;
  }
  std::map<Column, std::map<Verdict, std::size_t>> counts;
  std::set<Verdict> seen{Verdict::stable};
  std::size_t failures = 0;
  for (const HardRow& r : rows)
    for (const HardCell& c : r.cells)
      ++counts[column_of(c)][c.verdict], seen.insert(c.verdict), failures += c.failed || c.open;
  say("{:<24} {:<8}{:>6}", "hard cases", "scalar", "cells");
  for (const Verdict v : seen) say("  {:>12}", name_of(v));
  say("\n");
  for (auto& [column, of] : counts) {
    std::size_t cells = 0;
    for (const auto& [verdict, n] : of) cells += n;
    say("{:<24} {:<8}{:>6}", column.subject, column.scalar, cells);
    for (const Verdict v : seen) say("  {:>12}", of[v]);
    say("\n");
  }
  if (in_full) {
    for (const HardRow& r : rows)
      for (const HardCell& c : r.cells)
        if (c.failed || c.open) print_failure(r, c);
  } else if (failures) {
    print_failures_by_block(rows);
  }
}

Command hard_cases_command(CLI::App& program) {
  CommandWith<HardCasesFlags> a(
      program, "hard-cases",
      "run every hard case, and print a verdict on each. Exit code 0 if none failed; 1 if "
      "any did; 2 for bad input; 3 if "
      "stopped, or if a case has no verdict");
  std::vector<Flag> others = a->selection.add(a);
  a.list("--file", a->files, "FILE", "more hard cases, in the form of fixtures/hard_cases, repeatable");
  const Flag share =
      a.text("--share", a->share, "DIR",
             "instead, write the cases with their exact results to JSON files that other programs read");
  others.push_back(a.jobs(a->jobs));
  for (const Flag& other : others) share.excludes(other);
  return a.runs(run);
}

}  // namespace liecheck::properties
