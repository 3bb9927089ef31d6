#include <fmt/format.h>
#include <fmt/ranges.h>
#include <adapters/adapter.hpp>
#include <adapters/subjects.hpp>
#include <algorithm>
#include <app/campaign_run.hpp>
#include <app/command.hpp>
#include <campaign/cliffs.hpp>
#include <campaign/coverage_report.hpp>
#include <campaign/expected.hpp>
#include <campaign/robots.hpp>
#include <failures/blocks.hpp>
#include <failures/wrong_calls.hpp>
#include <filesystem>
#include <hard_cases/hard_cases.hpp>
#include <limits>
#include <map>
#include <record/badge.hpp>
#include <record/record.hpp>
#include <reports/report.hpp>
#include <rules/rules.hpp>
#include <set>
#include <stdexcept>
#include <support/files.hpp>
#include <support/folder.hpp>
#include <support/say.hpp>
#include <support/stop.hpp>
#include <support/terminal.hpp>
#include <support/text.hpp>
#include <tuple>

namespace liecheck::properties {

namespace {

struct CampaignFlags {
  SelectionFlags selection;
  CaseFlags cases;
  StoreFlags store;
  std::string badge, rules;
  std::string adapter, page;  ///< of `test`
  bool no_hard_cases = false, no_probe = false, verbose = false, all = false;
};

/// Prints every class and band of one series, each with the output that was measured least in it.
void print_coverage(const Series& s, const std::vector<Covered>& all, std::uint64_t cases) {
  say("{} {} in {}, {} cases\n", s.property, s.subject, s.scalar, cases);
  for (const Covered& c : all)
    say("  {:<44}{:>10}  {:>8.4f} %  {}{}\n", c.what, c.count,
        100.0 * static_cast<double>(c.count) / static_cast<double>(std::max<std::uint64_t>(1, cases)),
        c.output,
        c.missing()  ? "  NOT COVERED"
        : c.required ? ""
                     : "  not required in so few cases");
}

/// Prints the coverage of every series, and then for each property that of its least covered one.
void print_coverage(const CampaignResult& r) {
  struct Least {
    bool missing;
    std::size_t unseen;
    std::string series, line;
  };
  std::map<std::string, Least> least;
  say("\n{:<24}{:<20}{}\n", "coverage", "", "of the classes and bands that each output must be measured in");
  for (const auto& [series, tally] : r.series) {
    const auto all = coverage_of(*series, tally);
    const std::uint64_t cases = tally.coverage.cases();
    const bool missing = std::any_of(all.begin(), all.end(), [](const Covered& c) { return c.missing(); });
    const auto unseen = static_cast<std::size_t>(
        std::count_if(all.begin(), all.end(), [](const Covered& c) { return c.count == 0; }));
    const auto [it, first] = least.try_emplace(series->property);
    Least& l = it->second;
    if (first || std::tuple(missing, unseen) > std::tuple(l.missing, l.unseen))
      l = {missing, unseen, series->subject + " in " + series->scalar, coverage_line(all, tally)};
    print_coverage(*series, all, cases);
  }
  for (const auto& [property, l] : least) say("{:<23} {:<19} {}\n", property, l.series, l.line);
}

/// Prints a line with the largest error of a series as a multiple of the budget.
void print_series(const Series& series, const Tally& tally) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double worst = 0;
  bool failed = !tally.disagreed.empty();
  bool expected = false;
  std::string outcome;  // of a failure without an error in eps
  for (const auto& [cell, row] : tally.rows) {
    const Budget& b = series.budget(static_cast<std::size_t>(cell.first),
                                    series.bands()[static_cast<std::size_t>(cell.second)].region);
    // The score of an unresolved case is infinite. Then the largest measured error is printed instead.
    const double measured = b.rule == Rule::forward ? row.max_error : row.max_excess;
    worst = std::max(worst, (row.worst_score < infinity ? row.worst_score : measured) / b.limit);
    if (row.failed && row.worst_score == infinity && outcome.empty()) outcome = worst_outcome(row, true);
    failed = failed || fails(series, cell, row);
    expected = expected || row.failed > 0;
  }
  const std::size_t open = not_measured(series, tally).size();
  const std::uint64_t outside = tally.coverage.cases_outside();
  const bool cliff = unexpected(cliffs_of(series, tally));
  const char* status = failed  ? cliff ? "FAIL, CLIFF" : "FAIL"
                       : cliff ? "CLIFF"
                       : open  ? "INCOMPLETE"
                               : "pass";
  fmt::print("{:<24} {:<18} {:<7}{:>9}  {:>14}  {}{}{}{}\n", series.property, series.subject, series.scalar,
             tally.cases, outcome.empty() ? fmt::format("{:.3g}x", worst) : outcome,
             coloured(failed || cliff ? Colour::red
                      : open          ? Colour::yellow
                                      : Colour::green,
                      status),
             expected && !failed ? ", with expected failures" : "",
             (failed || cliff) && open ? ", not all measured" : "",
             outside ? fmt::format(", judged in {} cases alone, {} are outside the domain",
                                   tally.cases - outside, outside)
                     : "");
}

/// Prints each cliff, with the worst case of its band, and what became of the expected failures, at most six lines of what
/// is as expected unless `all`. Those of blocks that fail belong to their findings.
void print_cliffs(const CampaignResult& r, const std::vector<FailedBlock>& failed, bool all) {
  std::vector<std::string> expected, others;
  for (const auto& [series, tally] : r.series)
    for (const Cliff& c : cliffs_of(*series, tally)) {
      const Output& output = series->outputs[c.output];
      if (std::ranges::any_of(failed, [&](const FailedBlock& f) {
            return f.subject == series->subject && f.operation == output.operation && f.block == output.block;
          }))
        continue;
      const Row& row = tally.rows.at({static_cast<int>(c.output), static_cast<int>(c.band)});
      (c.expected ? expected : others)
          .push_back(fmt::format("{}cliff: {}\n  {} of {} in {}; worst  {}\n", c.expected ? "expected " : "",
                                 text_of(*series, c), series->property, series->subject, series->scalar,
                                 replay_words(series->id(r.options.seed, row.worst_index).text(),
                                              replay_flags(*series, r.robot))));
    }
  for (const Expectation& e : expectations_of(r))
    if (all || e.measured > 0) (e.passed() ? others : expected).push_back(text_of(e) + "\n");
  constexpr std::size_t most = 6;
  const std::size_t hidden = all || expected.size() <= most ? 0 : expected.size() - most;
  expected.resize(expected.size() - hidden);
  others.insert(others.end(), expected.begin(), expected.end());
  if (!others.empty()) say("\n{}", fmt::join(others, ""));
  if (hidden) say("and {} more that are as expected: --all lists them\n", hidden);
}

/// Prints what the series did not measure, at most six lines of each unless `all`.
void print_not_measured(const CampaignResult& r, bool all) {
  for (const auto& [series, tally] : r.series) {
    const auto lines = not_measured(*series, tally);
    if (lines.empty()) continue;
    const std::size_t shown = all ? lines.size() : 6;
    say("\nNOT MEASURED  {} of {} in {}\n", series->property, series->subject, series->scalar);
    for (std::size_t i = 0; i < std::min(shown, lines.size()); ++i) say("  {}\n", lines[i]);
    if (lines.size() > shown) say("  and {} more: --all prints them\n", lines.size() - shown);
    for (const auto& [cell, row] : tally.rows)
      if (row.failed == 0 && row.unresolved + row.unmeasured > 0) {
        say("  for example  {}\n",
            replay_words(series->id(r.options.seed, row.worst_index).text(), replay_flags(*series, r.robot)));
        break;
      }
  }
}

/// The adapters whose functions on trees are not called, since they take no trees but those of URDFs, and none is given.
std::vector<std::string> without_trees(const CampaignFlags& f) {
  std::vector<std::string> names;
  for (const std::string& adapter : f.selection.adapters.adapters)
    if (const auto* d = adapters::description_of(adapter);
        d && !d->models.contains("joints") && f.cases.robot.file.empty() && f.selection.properties.empty() &&
        (adapters::offers_trees(*d, "float") || adapters::offers_trees(*d, "double")))
      names.push_back(d->name);
  return names;
}

void print_oracles(const CampaignResult& r, bool verbose) {
  std::uint64_t fast = 0, checked = 0, disagreed = 0;
  for (const auto& [series, tally] : r.series) {
    fast += tally.fast, checked += tally.checked, disagreed += tally.disagreed.size();
    for (const std::uint64_t index : tally.disagreed)
      say("ORACLES DISAGREE: {}\n", series->id(r.options.seed, index).text());
  }
  if (!verbose) return;
  say("\noracles: ball arithmetic decided {:.2f} % of the cases, 50 and 100 digits decided the others; {} "
      "cases of ball arithmetic were measured again with 50 and 100 digits, {} disagree\n",
      r.total_cases ? 100.0 * static_cast<double>(fast) / static_cast<double>(r.total_cases) : 0.0, checked,
      disagreed);
}

/// The verdict as an exit code. What has no verdict hides no failure, but an interrupted campaign has none.
int code_of(const CampaignResult& r, const std::vector<HardRow>& hard_cases) {
  if (r.incomplete) return incomplete;
  if (r.fails() || any_failed(hard_cases)) return property_failed;
  return r.undecided() || any_open(hard_cases) ? incomplete : within_budget;
}

/// The line of the verdict, with what is not in the table of the laws.
std::string verdict_line(const CampaignResult& r, const std::vector<HardRow>& hard_cases) {
  const int code = code_of(r, hard_cases);
  std::vector<const char*> what;
  if (r.failed && !r.incomplete) what.push_back("laws failed");
  if (any_failed(hard_cases)) what.push_back("hard cases failed");
  if (!r.wrong_calls.empty()) what.push_back("calls of the probe are wrong");
  if (what.empty() && any_open(hard_cases)) what.push_back("hard cases have no verdict");
  return fmt::format("verdict {}{}{}", verdict_of(code != incomplete, code == within_budget),
                     what.empty() ? "" : ": ", fmt::join(what, "; "));
}

/// Whose limits judge a subject.
std::set<std::string> limits_of(const CampaignResult& r) {
  std::set<std::string> limits;
  for (const auto& [series, tally] : r.series) {
    if (series->profile != Profile::ours)
      limits.insert(fmt::format("profile of {}: {}\n", series->subject, name_of(series->profile)));
    if (series->own)
      limits.insert(
          fmt::format("limits of {}: {} ({})\n", series->subject, series->own->file, hash_of(*series->own)));
  }
  return limits;
}

void print_verdict(const CampaignResult& r, const std::vector<HardRow>& hard_cases, const std::string& more) {
  const int code = code_of(r, hard_cases);
  const Colour failing = code == property_failed ? Colour::red : Colour::yellow;
  fmt::print(
      "{}{}\n",
      coloured(code == within_budget ? Colour::green : failing, printable(verdict_line(r, hard_cases))),
      printable(more));
}

/// Prints the table of the laws, each row that fails, the coverage and the digests.
void print_details(const CampaignResult& r, const std::vector<HardRow>& hard_cases, const CampaignFlags& f) {
  print_hard_case_summary(hard_cases, f.all);
  say("\n{:<24} {:<18} {:<7}{:>9}  {:>14}  {}\n", "property", "subject", "scalar", "cases", "worst",
      "status");
  for (const auto& [series, tally] : r.series) print_series(*series, tally);
  say("worst: the largest error found as a multiple of its budget, a lower bound of the true maximum\n");
  print_failures(r, f.all);
  print_cliffs(r, {}, f.all);
  print_not_measured(r, f.all);
  print_coverage(r);
  say("\n{}inputs  {}\nresults {}\n", fmt::join(limits_of(r), ""), r.inputs_digest, r.results_digest);
}

/// Prints the verdict, the findings, how conventions differ, what was measured and, if verbose, details; returns the exit code.
int print_campaign(const CampaignResult& r, const std::vector<HardRow>& hard_cases, const ToldFindings& told,
                   const CampaignFlags& f, const Differences& differ) {
  std::set<std::string> subjects;
  for (const auto& [series, tally] : r.series)
    subjects.insert(series->subject + (series->subject_version.empty() ? "" : " " + series->subject_version));
  const std::size_t many = told.findings.size();
  print_verdict(
      r, hard_cases,
      fmt::format(
          "{}{}",
          subjects.size() > 3 ? fmt::format("; {} subjects", subjects.size())
                              : fmt::format("; {}", fmt::join(subjects, ", ")),
          many ? fmt::format(": {} finding{}", many, many > 1 ? "s, first what costs most" : "") : ""));
  print(told);
  if (!f.verbose) print_cliffs(r, told.failed, f.all), print_not_measured(r, f.all);
  for (const std::string& name : without_trees(f))
    fmt::print(
        "\nNOT MEASURED  the functions of {} on trees, which it takes from URDFs only: "
        "give one with --robot\n",
        name);
  const std::string differences = printable_lines(text_of(differ, r.wrong_calls, f.verbose));
  fmt::print("{}", differences);
  if (many > 0 || !differences.empty()) say("\n");
  if (f.verbose) print_details(r, hard_cases, f);
  print_oracles(r, f.verbose);
  if (many > 0) print_without_finding(r, told);
  print_measured(r, hard_cases);
  if (!f.verbose) say("--verbose shows each law, each row that fails, the coverage and the digests\n");
  print_how_to_accept(told, f.all);
  return code_of(r, hard_cases);
}

/// Replays the hard cases, which come first in every campaign. Only the first of several shards does this.
std::vector<HardRow> replay_hard_cases(const CampaignFlags& f, const Selection& selection,
                                       const Robot& robot) {
  if (f.no_hard_cases || !f.store.first_shard()) return {};
  static const std::vector<HardCase> corpus =
      f.rules.empty() ? built_in_corpus() : hard_cases_of(rules_named(f.rules));
  return run_hard_cases(selection, robot, corpus, f.cases.options.jobs);
}

int run(const CampaignFlags& f) {
  Selection selection = f.selection.selection();
  if (!f.rules.empty()) {
    check_runs(rules_named(f.rules), present_rules());
    selection.properties = laws_of(rules_named(f.rules), selection.properties);
  }
  const Robot robot = f.cases.robot.read();
  const bool quiet = !f.store.first_shard();
  Differences differ = f.no_probe ? Differences() : f.selection.adapters.withhold_others(quiet);
  differ.outside = f.selection.adapters.outside(robot);
  leave_out_withheld(selection, differ);
  if (select(selection, robot).empty())
    throw std::invalid_argument(
        differ.conventions.empty()
            ? "nothing to run: no selected subject offers a selected property in that scalar"
            : nothing_judged(differ));
  stop_on_signals();
  f.store.check(f.cases.options.seconds.has_value());
  const auto hard_cases = replay_hard_cases(f, selection, robot);
  if (stop_requested)
    std::fputs("interrupted during the hard cases: no case of the campaign is run\n", stderr);
  auto done = run_stored_campaign(selection, robot, f.cases, f.store, beside_of(differ.probed, hard_cases));
  if (!done) return within_budget;
  done->result.wrong_calls = wrong_calls_beside(done->result, differ.probed, differ.outside);
  if (!without_trees(f).empty() || !differ.conventions.empty()) done->result.measured = false;
  int code = incomplete;
  const ToldFindings told = told_findings(done->result, hard_cases, f.all);
  do_both(
      [&] {
        write_campaign_record(f.selection.json, *done, hard_cases, told);
        if (!f.badge.empty()) write_whole(f.badge, badge_of(verdicts_by_subject(done->result, hard_cases)));
      },
      [&] {
        print_counterexamples(done->counterexamples, f.all);
        code = print_campaign(done->result, hard_cases, told, f, differ);
        print_how_to_resume(done->result, f.store);
      });
  return code;
}

/// The flags that `campaign` and `test` share.
void add_flags(CommandWith<CampaignFlags>& a, const std::string& typed_line) {
  a->store.typed_line = typed_line;
  a.toggle("--no-hard-cases", a->no_hard_cases, "skip the hard cases, which are replayed first");
  a.toggle("--no-probe", a->no_probe, "judge an adapter even if its conventions differ from liecheck's");
  a->cases.add(a);
  a.toggle("--verbose", a->verbose, "show each law, each row that fails, the coverage and the digests, too");
  a.toggle("--all", a->all,
           "print every finding, the lines of a limits file that accept them and, with --verbose, each "
           "failure in full");
  a.text("--rules", a->rules, "VERSION",
         "judge by this version of the rules: its laws, inputs, limits and hard cases (docs/ci.md)");
  a.output("--badge", a->badge, "FILE.svg", "write a badge with the verdict on each subject");
}

/// The campaign of one adapter, and a page of its record.
int test(const CampaignFlags& given) {
  CampaignFlags f = given;
  f.selection.adapters.adapters = {f.adapter};
  if (f.page.empty()) return run(f);
  make_folder("--page", f.page);
  if (f.selection.json.empty()) f.selection.json = file_in(f.page, "campaign.json").string();
  check_writable(f.selection.json);
  const int code = run(f);
  say("{}\n", std::filesystem::absolute(reports::write_report({f.selection.json}, f.page).html).string());
  return code;
}

constexpr const char* exit_codes =
    "Exit code 0 if every error is within its limit; 1 if one is not; 2 for bad input; 3 if incomplete: "
    "interrupted, or a law measured less than it must";

}  // namespace

Command test_command(CLI::App& program, const std::string& typed_line) {
  CommandWith<CampaignFlags> a(
      program, "test",
      std::string("test a library: conventions, laws on random inputs, hard cases; one block of "
                  "lines for each finding. ") +
          exit_codes);
  a.text("ADAPTER", a->adapter, "",
         "a command or a shared library (*.so); for npx liecheck an ES module, for python -m liecheck "
         "MODULE:NAME")
      .required();
  a.text("--page", a->page, "DIR", "write the record and a page of it into this folder");
  a->selection.add_laws(a);
  add_flags(a, typed_line);
  return a.runs(test);
}

Command campaign_command(CLI::App& program, const std::string& typed_line) {
  CommandWith<CampaignFlags> a(
      program, "campaign",
      std::string("test libraries by the laws, with inputs that follow from a seed. ") + exit_codes);
  a->selection.add(a);
  add_flags(a, typed_line);
  a->store.add(a);
  return a.runs(run);
}

}  // namespace liecheck::properties
