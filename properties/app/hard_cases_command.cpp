#include <app/commands.hpp>
#include <app/hard_cases_table.hpp>
#include <app/record_file.hpp>
#include <app/shared_flags.hpp>
#include <app/signals.hpp>
#include <memory>
#include <stdexcept>
#include <store/stored_run.hpp>
#include <support/files.hpp>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

struct Flags {
  SelectionFlags selection;
  std::vector<std::string> files;
  unsigned jobs = default_jobs();
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

int run(const Flags& f) {
  const std::string& json = f.selection.json;
  if (!json.empty()) check_writable(json);
  StoredRun no_cases;
  no_cases.result.options.cases = 0;
  no_cases.result.robot = built_in_robot();
  const auto cases = corpus_with(f.files);
  stop_on_signals();
  const auto rows = run_hard_cases(f.selection.selection(), no_cases.result.robot, cases, f.jobs);
  no_cases.result.incomplete = stop_requested;
  if (rows.empty() && !stop_requested)
    throw std::invalid_argument("nothing to run: no selected subject offers a hard case's property");
  const std::string lost = try_write_record(json, no_cases, {.hard_cases = &rows});
  print_hard_case_table(rows);
  print_hard_case_summary(rows, rows.size());
  if (!lost.empty()) throw std::runtime_error(lost);
  if (stop_requested) std::fputs("interrupted: the table has only the rows that were done\n", stderr);
  return stop_requested ? incomplete : any_failed(rows) ? property_failed : within_budget;
}

}  // namespace

Command hard_cases_command(CLI::App& program) {
  const auto f = std::make_shared<Flags>();
  Arguments a(program, "hard-cases",
              "a verdict on every hard case. Exit 0 none failed, 1 some did, 2 bad input, 3 stopped");
  f->selection.add(a);
  a.list("--file", f->files, "FILE", "more hard cases, in the form of fixtures/hard_cases, repeatable");
  add_jobs(a, f->jobs);
  return a.command([f] { return run(*f); });
}

}  // namespace liecheck::properties
