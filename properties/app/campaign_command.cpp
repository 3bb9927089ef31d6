#include <fmt/format.h>
#include <app/campaign_run.hpp>
#include <app/campaign_table.hpp>
#include <app/commands.hpp>
#include <app/hard_cases_table.hpp>
#include <app/record_file.hpp>
#include <app/signals.hpp>
#include <memory>
#include <stdexcept>
#include <support/files.hpp>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

struct Flags {
  SelectionFlags selection;
  CaseFlags cases;
  StoreFlags store;
  bool no_hard_cases = false, verbose = false;
};

/// Replays the hard cases, which come first in every campaign; in the first shard only, if it has shards.
std::vector<HardRow> replay_hard_cases(const Flags& f, const Selection& selection, const Robot& robot) {
  if (f.no_hard_cases || !f.store.first_shard()) return {};
  const auto rows = run_hard_cases(selection, robot, built_in_corpus(), f.cases.jobs);
  print_hard_case_summary(rows, 3);
  fmt::print("\n");
  std::fflush(stdout);
  return rows;
}

int run(const Flags& f) {
  const std::string& json = f.selection.json;
  if (!json.empty()) check_writable(json);
  const Selection selection = f.selection.selection();
  const Robot robot = f.cases.robot.read();
  if (select(selection, robot).empty())
    throw std::invalid_argument(
        "nothing to run: no selected subject offers a selected property in that scalar");
  f.store.check(f.cases.seconds.has_value());
  stop_on_signals();
  const auto hard_cases = replay_hard_cases(f, selection, robot);
  if (stop_requested) {
    std::fputs("interrupted during the hard cases: no case of the campaign was run\n", stderr);
    return incomplete;
  }
  const auto done = run_stored_campaign(selection, robot, f.cases, f.store);
  if (!done) return within_budget;
  const std::string lost = try_write_record(json, *done, {.hard_cases = &hard_cases});
  print_counterexamples(done->counterexamples);
  const int code = print_campaign(done->result, f.verbose);
  print_how_to_resume(done->result, f.store);
  if (!lost.empty()) throw std::runtime_error(lost);
  if (any_failed(hard_cases)) fmt::print("hard cases failed: see the first section\n");
  return code == within_budget && any_failed(hard_cases) ? property_failed : code;
}

}  // namespace

Command campaign_command(CLI::App& program, const std::string& typed_line) {
  const auto f = std::make_shared<Flags>();
  f->store.typed_line = typed_line;
  Arguments a(program, "campaign",
              "run properties on subjects. Exit 0 within budget, 1 failed, 2 bad input, 3 incomplete");
  f->selection.add(a);
  a.toggle("--no-hard-cases", f->no_hard_cases, "skip the hard cases, which are replayed first");
  f->cases.add(a);
  a.toggle("--verbose", f->verbose, "show how often each class and band of inputs occurred");
  f->store.add(a);
  return a.command([f] { return run(*f); });
}

}  // namespace liecheck::properties
