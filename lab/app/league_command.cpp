#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <league/findings.hpp>
#include <league/found.hpp>
#include <league/league.hpp>
#include <league/measure.hpp>
#include <nlohmann/json.hpp>
#include <reports/league.hpp>
#include <stdexcept>
#include <support/files.hpp>
#include <support/folder.hpp>
#include <support/json.hpp>
#include <support/names.hpp>
#include <support/own_process.hpp>
#include <support/progress.hpp>
#include <support/say.hpp>
#include <support/stop.hpp>
#include "lab_commands.hpp"

namespace liecheck::properties {

namespace {

using nlohmann::json;

struct LeagueFlags {
  std::string question, out, record, adapters, before, after, adapter, found, library;
  bool run_recorded = false;
  RobotFlags robot;
  bool all = false;
  std::vector<std::string> only;
  league::MeasureOptions options;
};

std::string today() {
  const std::time_t now = std::time(nullptr);
  char text[16];
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::strftime(text, sizeof text, "%Y-%m-%d", &utc);
  return text;
}

json new_record(const league::MeasureOptions& o) {
  return {{"league", 1},
          {"version", LIECHECK_VERSION},
          {"date", today()},
          {"seed", o.seed},
          {"cases", o.cases},
          {"verdict", "incomplete"},
          {"libraries", json::array()},
          {"absent", json::array()},
          {"failed", json::array()}};
}

/// The record in the file, if it is of the same version, seed and cases, to be continued; otherwise a new one.
json begun(const LeagueFlags& f) {
  json record = new_record(f.options);
  if (f.record.empty() || !std::filesystem::exists(f.record)) return record;
  const json earlier = league::read_league(f.record);
  for (const char* same : {"version", "seed", "cases"})
    if (earlier.value(same, json()) != record[same])
      throw std::invalid_argument(fmt::format(
          "--record {}: has another {} than this run: {}, not {}. Give the new record another name", f.record,
          same, dumped(earlier.value(same, json())), dumped(record[same])));
  record["libraries"] = earlier["libraries"];
  record["date"] = earlier.value("date", record["date"]);
  return record;
}

bool has(const json& record, const league::Entry& e) {
  return std::ranges::any_of(record["libraries"], [&](const json& l) { return l["adapter"] == e.adapter; });
}

std::vector<league::Entry> chosen(const LeagueFlags& f) {
  auto all = league::read_roster(f.adapters.empty() ? league::built_in_roster() : f.adapters);
  check_known(f.only, names_of(all, &league::Entry::name), "--only", "library");
  if (!f.only.empty())
    std::erase_if(all,
                  [&](const league::Entry& e) { return std::ranges::find(f.only, e.name) == f.only.end(); });
  return all;
}

/// Measures what the record does not have. Each library runs in a process of its own, so that none can end the league.
void measure_all(const std::vector<league::Entry>& entries, const LeagueFlags& f, json& record) {
  Progress progress("league");
  std::size_t done = 0;
  for (const league::Entry& e : entries) {
    progress.show(static_cast<double>(done++) / static_cast<double>(entries.size()), e.name);
    if (e.adapter.empty()) {
      record["absent"].push_back({{"name", e.name}, {"language", e.language}, {"get", e.get}});
      continue;
    }
    if (has(record, e)) continue;
    try {
      std::vector<std::string> words{"league",
                                     "measure",
                                     e.adapter,
                                     "--cases",
                                     std::to_string(f.options.cases),
                                     "--seed",
                                     std::to_string(f.options.seed),
                                     "--jobs",
                                     std::to_string(f.options.jobs)};
      if (!e.limits.empty()) words.insert(words.end(), {"--limits", e.limits});
      if (!e.robot.empty()) words.insert(words.end(), {"--robot", e.robot, "--root", e.root});
      const auto text = output_of_own_process(words, stop_requested);
      if (!text || stop_requested) return;
      json library = parsed(*text);
      library["language"] = e.language, library["adapter"] = e.adapter, library["run"] = e.run,
      library["get"] = e.get;
      if (e.repaired) library["repaired"] = true;
      record["libraries"].push_back(library);
    } catch (const std::exception& problem) {
      if (stop_requested) return;
      warn(fmt::format("liecheck: {}: not measured: {}\n", e.name, problem.what()));
      record["failed"].push_back({{"name", e.name}, {"why", problem.what()}});
    }
    if (!f.record.empty()) write_record(f.record, record);
  }
  if (record["failed"].empty()) record["verdict"] = "complete";
}

void print_league(const json& record, const std::string& question) {
  say("{:<22}{:<14}{:<12}{:<8}{:<7}{:>12}{:>12}{:>5}  {}\n", "library", "version", "language", "scalar",
      "grade", "worst [eps]", "ns a call", "of", "worst operation");
  for (const league::Answer& a : league::answers(record, question))
    say("{:<22}{:<14}{:<12}{:<8}{:<7}{:>12.3g}{:>12.0f}{:>5}  {}\n", a.library, a.version, a.language,
        a.scalar, a.grade, a.eps, a.ns, a.operations, a.worst_operation);
  say("\ngrade{}: A within 64 eps, B at most 1e4 eps, C at most 1e8 eps, D more, F a result that is NaN, on "
      "a wrong "
      "branch or missing; errors are the largest found, a lower bound\n",
      question.empty() ? "" : " for " + question);
  for (const json& a : record["absent"])
    say("absent: {}; to get it: {}\n", a["name"].get<std::string>(), a["get"].get<std::string>());
}

int run(const LeagueFlags& f) {
  const auto entries = chosen(f);
  if (!f.out.empty()) check_writable(f.out);
  if (!f.record.empty()) check_writable(f.record);
  if (same_file(f.out, f.record)) throw std::invalid_argument("--out and --record name the same file");
  json record = begun(f);
  stop_on_signals();
  measure_all(entries, f, record);
  if (stop_requested)
    std::fputs("interrupted: what was measured is kept; the same command continues it if it has --record\n",
               stderr);
  do_both(
      [&] {
        if (!f.record.empty()) write_record(f.record, record);
        if (!f.out.empty()) write_whole(f.out, reports::league_page(record));
      },
      [&] { print_league(record, f.question); });
  return record["verdict"] == "complete" ? within_budget : incomplete;
}

int measure(const LeagueFlags& f) {
  if (!f.found.empty()) {
    say("{}\n", dumped(league::measured_found(f.found, f.library, f.adapter)));
    return within_budget;
  }
  league::MeasureOptions o = f.options;
  o.robot = f.robot.file, o.fixed = f.robot.root == "fixed";
  say("{}\n", dumped(league::measure(f.adapter, o)));
  return within_budget;
}

league::Trust trust_of(const LeagueFlags& f) {
  return {league::read_roster(f.adapters.empty() ? league::built_in_roster() : f.adapters), f.record,
          f.run_recorded};
}

/// Measures the defects of a record again, and writes the record and the page.
int found(const LeagueFlags& f) {
  const json record = league::read_found(f.record);
  const league::Trust trust = trust_of(f);
  stop_on_signals();
  const league::FoundAgain again = league::found_again(record, trust, f.out);
  if (stop_requested) return incomplete;
  write_whole(file_in(f.out, "found.json"), dumped(again.record, 1) + "\n");
  write_whole(file_in(f.out, "found.md"), league::found_page(again.record));
  say_text(again.text);
  return again.same ? within_budget : property_failed;
}

int findings(const LeagueFlags& f) {
  if (league::is_found(f.record)) return found(f);
  const json record = league::read_league(f.record);
  const league::Trust trust = trust_of(f);
  stop_on_signals();
  say_text(league::write_findings(record, trust, f.out).text);
  return stop_requested ? incomplete : within_budget;
}

int changed(const LeagueFlags& f) {
  say_text(league::changes(league::read_league(f.before), league::read_league(f.after)));
  return within_budget;
}

}  // namespace

Command league_command(CLI::App& program) {
  CommandWith<LeagueFlags> a(
      program, "league",
      "measure all libraries that have an adapter, side by side. Exit code 0; 2 for bad input; 3 if "
      "stopped, or if a library could not be measured");
  a.choice("--for", a->question, league::questions, "WHERE",
           "sort by what holds there: near-zero, near-pi, 1e-8, off-unit or 1kHz");
  a.output("--out", a->out, "FILE.html", "write the page");
  a.updated("--record", a->record, "FILE.json",
            "write the record after each library; one that exists is continued");
  a.list("--only", a->only, "NAME", "measure this library alone, repeatable");
  a.text("--adapters", a->adapters, "FILE.json", "list of adapters; default: the one that the build wrote");
  a.number("--cases", a->options.cases, 1, 100000000, "cases of each law and scalar");
  a.seed(a->options.seed, "seed of the cases");
  a.jobs(a->options.jobs);
  return a.runs(run);
}

Command league_measure_command(CLI::App& league) {
  CommandWith<LeagueFlags> a(league, "measure",
                       "measure one library and print its part of the record, for the command league");
  a.text("ADAPTER", a->adapter, "", "as --adapter of a campaign takes it").required();
  a.text("--limits", a->options.limits, "FILE", "a limits file whose expected failures do not count");
  const Flag library = a.text("--library", a->library, "NAME", "of the defects of --found, the library");
  a.text("--found", a->found, "FILE", "measure the defects of fixtures/league/found.json instead")
      .needs(library);
  a.number("--cases", a->options.cases, 1, 100000000, "cases of each law and scalar");
  a.seed(a->options.seed, "seed of the cases");
  a.jobs(a->options.jobs);
  a->robot.add(a, "robot of the operations on trees; default: random trees only");
  return a.runs(measure);
}

Command league_findings_command(CLI::App& league) {
  CommandWith<LeagueFlags> a(
      league, "findings",
      "run the program of each failing cell of a record, and write a Markdown file for each defect that its "
      "output confirms. Exit code 0; 1 if a defect of fixtures/league/found.json is another one now; 2 for "
      "bad input; 3 if stopped");
  a.text("RECORD", a->record, "FILE",
         "the record that league --record wrote; or fixtures/league/found.json, to measure its defects again "
         "and write their page, found.md")
      .required();
  a.text("--out", a->out, "DIR", "folder of the findings").required();
  a.text("--adapters", a->adapters, "FILE.json",
         "list of adapters, whose commands the record must have; default: the one that the build wrote");
  a.toggle(
      "--run-recorded", a->run_recorded,
      "run the commands and programs of the record, whatever they are; only for a record that you trust");
  return a.runs(findings);
}

Command league_changes_command(CLI::App& league) {
  CommandWith<LeagueFlags> a(league, "changes",
                       "print in Markdown what changed between two records. Exit code 0; 2 for bad input");
  a.text("BEFORE", a->before, "FILE", "the earlier record").required();
  a.text("AFTER", a->after, "FILE", "the later record").required();
  return a.runs(changed);
}

}  // namespace liecheck::properties
