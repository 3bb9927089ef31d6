#include <fmt/format.h>
#include <adapters/subjects.hpp>
#include <algorithm>
#include <app/campaign_run.hpp>
#include <app/command.hpp>
#include <app/lab.hpp>
#include <failures/wrong_calls.hpp>
#include <filesystem>
#include <functional>
#include <hard_cases/hard_cases.hpp>
#include <nlohmann/json.hpp>
#include <record/record.hpp>
#include <reports/report.hpp>
#include <set>
#include <stdexcept>
#include <store/store_path.hpp>
#include <support/files.hpp>
#include <support/folder.hpp>
#include <support/say.hpp>
#include <support/stop.hpp>
#include <support/text.hpp>
#include <timing/cost.hpp>
#include <timing/kernels.hpp>

namespace liecheck::properties {

namespace {

namespace fs = std::filesystem;

struct ReportFlags {
  std::vector<std::string> records;
  std::string out = "liecheck-report";
  bool no_cost = false, no_scenes = false;
  CaseFlags cases;
  SelectionFlags selection;
};

/// The adapters whose calls can be timed.
std::vector<std::string> timed_of(const std::vector<std::string>& given) {
  std::vector<std::string> timed;
  for (const std::string& adapter : given)
    if (adapters::can_be_timed(adapter))
      timed.push_back(adapter);
    else
      warn(fmt::format("warning: '{}' is a command that does not time itself: it is not timed\n", adapter));
  return timed;
}

/// The files of the records. If one is a store, its record is written into `folder`.
std::vector<fs::path> record_files(const std::vector<std::string>& records, const std::string& folder) {
  std::vector<fs::path> all;
  std::set<std::string> names;
  for (const std::string& record : records) {
    if (!is_store(stored_file(record))) {
      all.push_back(record);
      continue;
    }
    const StoredRun run = result_of(load_campaign(record), record);
    make_folder("--out", folder);
    std::string name = file_name(fs::path(record).stem().string());
    const auto is_record = [&](const std::string& other) {
      return same_file(other, (fs::path(folder) / (name + ".json")).string());
    };
    while (std::ranges::any_of(records, is_record) || !names.insert(name).second) name += "_";
    all.push_back(file_in(folder, name + ".json"));
    write_record(all.back(), full_record_of(run));
  }
  return all;
}

void print_interrupted(const char* where) {
  std::fprintf(stderr, "interrupted%s: the report contains what was done\n", where);
}

/// Runs everything that a report shows and writes the record.
fs::path run_campaign_of_report(const ReportFlags& f) {
  const bool everything = f.selection.subjects.empty() && f.selection.adapters.adapters.empty();
  Selection selection = everything ? f.selection.limits.judging({}) : f.selection.selection();
  const Differences found = f.selection.adapters.withhold_others();
  const std::vector<std::string>& differ = found.conventions;
  leave_out_withheld(selection, found);
  for (const std::string& text : differ) warn("not judged: " + text + "\n");
  const Robot robot = f.cases.robot.read();
  CostOptions times;
  times.seed = f.cases.options.seed, times.seconds = 30, times.flags = everything && has_kernels();
  if (!f.no_cost && !everything) {
    times.adapters = timed_of(f.selection.adapters.adapters);
    times.subjects = f.selection.subjects;
    std::erase(times.subjects, "all");
    for (const std::string& adapter : times.adapters)
      add_subjects(times, {adapters::description_of(adapter)->name});
    if (times.adapters.empty() && times.subjects.size() == 1) add_forms(times);
  }
  const bool timed = !f.no_cost && (everything || !f.selection.subjects.empty() || !times.adapters.empty());
  stop_on_signals();
  make_folder("--out", f.out);
  const fs::path file = file_in(f.out, "campaign.json");
  check_writable(file);
  const auto hard_cases = run_hard_cases(selection, robot, built_in_corpus(), f.cases.options.jobs);
  StoredRun run = run_stored_campaign(selection, robot, f.cases, {}).value();
  run.result.measured = run.result.measured && differ.empty();
  std::vector<std::string> remarks;
  run.result.wrong_calls = wrong_calls_beside(run.result, found.probed, remarks);
  print_warnings(remarks);
  for (const WrongCall& call : run.result.wrong_calls)
    warn(fmt::format("wrong: {}: {}\n", call.subject, call.sentence));
  if (run.result.incomplete) print_interrupted("");
  nlohmann::json record = full_record_of(run);
  if (!stop_requested) add_findings(record, told_findings(run.result, hard_cases, false));
  add_hard_cases(record, hard_cases, run.result.incomplete);
  // The record is written after each part, so that whatever ends the program later does not lose it.
  write_record(file, record);
  const auto add = [&](const char* during, const std::function<void()>& part) {
    if (stop_requested) return;
    part();
    write_record(file, record);
    if (stop_requested) print_interrupted(during);
  };
  const bool lab = !lab_program().empty();
  const auto measured_in_lab = [&](const char* key, const std::vector<std::string>& arguments) {
    const nlohmann::json part = record_of_lab(arguments, file_in(f.out, std::string(key) + ".json").string());
    if (part.is_null() && !stop_requested)
      warn(fmt::format("the report has no part '{}': liecheck-lab ended without a record of it\n", key));
    add_part(record, key, part);
  };
  const std::string jobs = std::to_string(f.cases.options.jobs);
  if (everything && !lab)
    warn(
        "the report has no sweep of every float, no proofs and no scenes: the laboratory, liecheck-lab, is "
        "not built\n");
  if (everything && lab) {
    add(" during the sweep", [&] { measured_in_lab("sweep", {"sweep", "--jobs", jobs}); });
    add(" during the proofs", [&] {
      measured_in_lab("bounds", {"bounds", "--boxes", "30000", "--jobs", jobs});
    });
  }
  if (timed)
    add(" during the timing", [&] {
      if (everything && lab) {  // which also has scalars wider than double
        std::vector<std::string> arguments = {"cost", "--seed", std::to_string(times.seed), "--for", "30s"};
        if (times.flags) arguments.push_back("--flags");
        return measured_in_lab("cost", arguments);
      }
      try {
        record["cost"] = record_of(run_cost(times));
      } catch (const std::runtime_error& e) {  // code of an adapter ended it
        if (times.adapters.empty()) throw;
        warn(fmt::format("warning: the report has no times: {}\n", e.what()));
      }
    });
  if (everything && lab && !f.no_scenes)
    add(" during the scenes", [&] { measured_in_lab("scenes", {"scene", "sweep", "--for-report"}); });
  return file;
}

int run(const ReportFlags& f) {
  std::vector<fs::path> records = record_files(f.records, f.out);
  if (records.empty()) records.push_back(run_campaign_of_report(f));
  const bool interrupted = stop_requested;  // a signal that comes later interrupts nothing
  const auto files = reports::write_report(records, f.out);
  say("{}\n", fs::absolute(files.html).string());
  return interrupted ? incomplete : within_budget;
}

}  // namespace

Command report_command(CLI::App& program) {
  CommandWith<ReportFlags> a(
      program, "report",
      "write the accuracy report, an HTML page. It is of records, or of a campaign over every "
      "subject or the chosen ones. Exit code 0 if it is "
      "written, whatever its verdict; 2 for bad input; 3 if its campaign was interrupted");
  const Flag records =
      a.list("RECORD", a->records, "FILE",
             "stores, or records that campaign --json wrote, and beside them those of "
             "environments and of the laboratory's horizons and rounding; default: run a campaign first");
  a.list("--subject", a->selection.subjects, "NAME",
         "a library under test, as 'liecheck list' names it, repeatable, or 'all'; default all, or the "
         "adapters")
      .excludes(records);
  a->selection.adapters.add(a).excludes(records);
  a.text("--out", a->out, "DIR", "folder of report.html, report.json and report.csv").with_default_in_help();
  a.toggle("--no-cost", a->no_cost, "leave out the times, which take about 35 s").excludes(records);
  a.toggle("--no-scenes", a->no_scenes, "leave out the scenes of liecheck, which take about 40 s")
      .excludes(records);
  for (const Flag& flag : a->cases.add(a)) flag.excludes(records);
  for (const Flag& flag : a->selection.limits.add(a)) flag.excludes(records);
  return a.runs(run);
}

}  // namespace liecheck::properties
