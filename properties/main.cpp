// The liecheck program: list, campaign, hard-cases, hunt, replay, report, and what to do with stores.

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <campaign/campaign.hpp>
#include <campaign/coverage_report.hpp>
#include <commands_hard_cases.hpp>
#include <commands_store.hpp>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <hunt_command.hpp>
#include <nlohmann/json.hpp>
#include <reports/report.hpp>
#include <set>
#include <thread>

namespace {

using namespace liecheck::properties;

/// Once: finish the chunk. Twice: at once.
extern "C" void on_signal(int number) {
  if (stop_requested) std::signal(number, SIG_DFL), std::raise(number);
  stop_requested = true;
}

/// "30s", "5m", "1h" or plain seconds.
double parse_duration(const std::string& text) {
  std::size_t end = 0;
  double value = 0;
  try {
    value = std::stod(text, &end);
  } catch (const std::exception&) {
    throw std::invalid_argument(fmt::format("--for: not a duration: '{}' (write 30s, 5m or 1h)", text));
  }
  const std::string unit = text.substr(end);
  const double factor = unit.empty() || unit == "s" ? 1 : unit == "m" ? 60 : unit == "h" ? 3600 : 0;
  if (factor == 0 || !(value > 0) || !(value * factor <= 1e7))
    throw std::invalid_argument(fmt::format("--for: not a duration: '{}' (write 30s, 5m or 1h)", text));
  return value * factor;
}

struct Flags {
  std::vector<std::string> subjects, properties, scalars;
  std::string robot, json, duration, id, out = "liecheck-report";
  std::vector<std::string> records, files;
  bool no_hard_cases = false, verbose = false;
  std::uint64_t seed = 42, cases = 1000;
  unsigned jobs = std::max(1u, std::thread::hardware_concurrency());
  StoreFlags store;
};

Robot robot_of(const Flags& f) {
  return f.robot.empty() ? built_in_robot() : load_robot(f.robot);
}

/// liecheck in float and double unless told; "all" is everything.
Selection selection_of(const Flags& f) {
  Selection s{f.subjects, f.properties, f.scalars};
  if (f.subjects.empty()) {
    s.subjects = {"liecheck"};
    if (f.scalars.empty()) s.scalars = {"float", "double"};
  } else if (std::find(f.subjects.begin(), f.subjects.end(), "all") != f.subjects.end()) {
    s.subjects.clear();
  }
  return s;
}

/// Can the record be written? Asked before the hours, not after them.
void check_writable(const std::string& path) {
  if (path.empty()) return;
  const std::string temporary = path + ".part";
  if (std::filesystem::is_directory(path) || !std::ofstream(temporary, std::ios::binary))
    throw std::invalid_argument(fmt::format("--json: {}: cannot be written", path));
  std::filesystem::remove(temporary);
}

std::optional<CampaignResult> campaign(const Flags& f, const Selection& selection) {
  CampaignOptions options;
  options.selection = selection;
  options.seed = f.seed;
  options.cases = f.cases;
  options.jobs = f.jobs;
  if (!f.duration.empty()) options.seconds = parse_duration(f.duration);
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  return run_stored_campaign(options, robot_of(f), f.store);
}

/// A line for each property, of its series that reached least; all of it where asked for.
void print_coverage(const CampaignResult& r, bool verbose) {
  fmt::print("\n{:<24}{:<20}{}\n", "coverage", "", "of what the generator must reach");
  std::map<std::string, std::tuple<bool, std::size_t, std::string, std::string>> least;
  for (const auto& [series, tally] : r.series) {
    const auto all = coverage_of(*series, tally);
    const auto missing = std::any_of(all.begin(), all.end(), [](const Covered& c) { return c.missing(); });
    const auto unseen = static_cast<std::size_t>(
        std::count_if(all.begin(), all.end(), [](const Covered& c) { return c.count == 0; }));
    auto& l = least[series->property];
    if (std::get<3>(l).empty() || std::tuple(missing, unseen) > std::tuple(std::get<0>(l), std::get<1>(l)))
      l = {missing, unseen, series->subject + " in " + series->scalar,
           coverage_line(all, tally.coverage.cases())};
    if (!verbose) continue;
    fmt::print("{} {} in {}, {} cases\n", series->property, series->subject, series->scalar,
               tally.coverage.cases());
    for (const Covered& c : all)
      fmt::print("  {:<44}{:>10}  {:>8.4f} %{}\n", c.what, c.count,
                 100.0 * static_cast<double>(c.count) /
                     static_cast<double>(std::max<std::uint64_t>(1, tally.coverage.cases())),
                 c.missing()  ? "  NOT COVERED"
                 : c.required ? ""
                              : "  not required of so few cases");
  }
  for (const auto& [property, l] : least)
    fmt::print("{:<24}{:<20}{}\n", property, std::get<2>(l), std::get<3>(l));
}

int print_campaign(const CampaignResult& r, bool verbose) {
  constexpr int shown_failures = 6;
  int failures = 0;
  fmt::print("{:<24}{:<15}{:<10}{:>9}  {:>11}  {}\n", "property", "subject", "scalar", "cases", "worst",
             "status");
  for (const auto& [series, tally] : r.series) {
    double worst = 0;
    bool failed = false;
    std::uint64_t unresolved = 0;
    std::string limit;
    for (const auto& [key, row] : tally.rows) {
      const Output& o = series->outputs.at(static_cast<std::size_t>(key.first));
      const Budget& b =
          budget_of(o.operation, o.block, series->bands()[static_cast<std::size_t>(key.second)].region);
      worst = std::max(worst, row.worst_score / b.limit);
      failed = failed || row.failed > 0;
      unresolved += row.unresolved;
    }
    fmt::print("{:<24}{:<15}{:<10}{:>9}  {:>10.3g}x  {}{}\n", series->property, series->subject,
               series->scalar, tally.cases, worst, failed || !tally.disagreed.empty() ? "FAIL" : "pass",
               unresolved ? fmt::format(", {} unresolved", unresolved) : "");
  }
  fmt::print(
      "worst: the largest error found as a multiple of its budget, a lower bound of the true maximum\n");
  for (const auto& [series, tally] : r.series) {
    // The worst band of each output stands for it.
    std::map<int, std::pair<int, const Row*>> worst;
    for (const auto& [key, row] : tally.rows) {
      auto& w = worst[key.first];
      if (row.failed && (!w.second || row.worst_score > w.second->worst_score)) w = {key.second, &row};
    }
    for (const auto& [output, band_row] : worst) {
      if (!band_row.second) continue;
      if (failures++ < shown_failures)
        fmt::print("\n{}", describe_failure(*series, r.options.seed, output, band_row.first, *band_row.second,
                                            r.robot));
    }
  }
  if (failures > shown_failures)
    fmt::print("\n{} more operations and blocks failed; --json FILE records them all\n",
               failures - shown_failures);
  std::uint64_t fast = 0, checked = 0, disagreed = 0;
  for (const auto& [series, tally] : r.series) {
    fast += tally.fast, checked += tally.checked, disagreed += tally.disagreed.size();
    for (const std::uint64_t index : tally.disagreed)
      fmt::print("ORACLES DISAGREE: {}\n", series->id(r.options.seed, index).text());
  }
  fmt::print(
      "\noracles: {:.2f} % of the cases decided in ball arithmetic, the rest at 50 and 100 digits; {} of the "
      "decided ones measured again at those, {} disagree\n",
      r.total_cases ? 100.0 * static_cast<double>(fast) / static_cast<double>(r.total_cases) : 0.0, checked,
      disagreed);
  print_coverage(r, verbose);
  fmt::print("\nseed {}, {} cases in {:.1f} s, robot {} ({})\n", r.options.seed, r.total_cases, r.elapsed,
             r.robot.name, r.robot.hash);
  fmt::print("inputs  {}\nresults {}\n", r.inputs_digest, r.results_digest);
  fmt::print("verdict {}\n", r.incomplete ? "incomplete" : r.failed ? "fail" : "pass");
  return r.incomplete ? incomplete : r.failed ? property_failed : within_budget;
}

int run_list() {
  const auto all = select({}, built_in_robot());
  fmt::print("subjects\n");
  for (const std::string& name : subject_names()) {
    std::set<std::string> scalars;
    std::string version;
    for (const auto& s : all)
      if (s->subject == name) scalars.insert(s->scalar), version = s->subject_version;
    if (!scalars.empty()) fmt::print("  {:<12}{} in {}\n", name, version, fmt::join(scalars, ", "));
  }
  fmt::print(
      "  textbook:1e-1 ... textbook:1e-12: variants with their cutoff there, run where they are named\n");
  fmt::print("properties\n");
  std::set<std::string> seen;
  for (const auto& s : all)
    if (seen.insert(s->property).second)
      fmt::print("  {:<24}{}\n  {:<24}{}\n", s->property, s->law, "", s->equation);
  return within_budget;
}

std::vector<HardRow> hard_cases_of(const Flags& f, const Selection& selection) {
  if (f.no_hard_cases) return {};
  return run_hard_cases(selection, robot_of(f), built_in_corpus(), f.jobs);
}

void write_record(const std::string& path, const CampaignResult& result,
                  const std::vector<HardRow>& hard_cases) {
  auto record = record_of(result);
  add_hard_cases(record, hard_cases);
  write_file(path, record.dump(1) + "\n");
}

int run_campaign_command(const Flags& f) {
  check_writable(f.json);
  const Selection selection = selection_of(f);
  // Of a campaign in shards the first one replays the hard cases.
  const auto hard_cases = f.store.first_shard() ? hard_cases_of(f, selection) : std::vector<HardRow>{};
  if (!f.no_hard_cases && f.store.first_shard())
    print_hard_case_summary(hard_cases, 3), fmt::print("\n"), std::fflush(stdout);
  const auto done = campaign(f, selection);
  if (!done) return within_budget;
  const CampaignResult& result = *done;
  if (result.series.empty())
    throw std::invalid_argument(
        "nothing to run: no selected subject offers a selected property in that scalar");
  if (!f.json.empty()) write_record(f.json, result, hard_cases);
  print_counterexamples(result);
  const int code = print_campaign(result, f.verbose);
  print_how_to_go_on(result, f.store);
  if (any_failed(hard_cases)) fmt::print("hard cases failed: see the first section\n");
  return code == within_budget && any_failed(hard_cases) ? property_failed : code;
}

int run_hard_cases_command(const Flags& f) {
  check_writable(f.json);
  CampaignResult result;
  result.options.cases = 0;
  result.robot = robot_of(f);
  const auto cases = corpus_with(f.files);
  const auto rows = run_hard_cases(selection_of(f), result.robot, cases, f.jobs);
  if (rows.empty())
    throw std::invalid_argument("nothing to run: no selected subject offers a hard case's property");
  if (!f.json.empty()) write_record(f.json, result, rows);
  print_hard_case_table(rows);
  print_hard_case_summary(rows, rows.size());
  return any_failed(rows) ? property_failed : within_budget;
}

int run_replay(const Flags& f) {
  const CaseId id = CaseId::parse(f.id);
  const Robot robot = robot_of(f);
  const auto found = select({{id.subject}, {id.property}, {id.scalar}}, robot);
  if (found.empty())
    throw std::invalid_argument(
        fmt::format("{} in {} does not offer {}", id.subject, id.scalar, id.property));
  const Series& series = *found.front();
  if (series.robot != id.robot)
    throw std::invalid_argument(fmt::format(
        "case ID names robot {}, this one is {}: give its URDF with --robot", id.robot, series.robot));
  const Trial trial = series.attempt(id);
  fmt::print("{}: {}\n{} {} in {}\ninput {}\n", series.property, series.law, series.subject,
             series.subject_version, series.scalar, fmt::join(trial.input, " "));
  bool failed = false;
  if (!trial.refusal.empty()) fmt::print("refused: {}\n", trial.refusal);
  for (const Judged& j : trial.judged) {
    if (!j.failed && j.residual.outcome == Outcome::refused) continue;  // as it should
    const Output& o = series.outputs.at(j.residual.output);
    static const char* const outcomes[] = {"", "NaN or Inf", "wrong branch", "unresolved", "refused"};
    failed = failed || j.failed;
    fmt::print("{:<26}{:<22}{:<24}{:>12.5g} eps  {:<22} kappa {:<10.3g}{} {}\n", o.operation, o.block,
               series.bands()[j.residual.band].name, j.residual.error, fmt::format("{:a}", j.residual.error),
               j.residual.kappa,
               j.failed      ? "FAIL"
               : j.ill_posed ? "ill-posed"
                             : "pass",
               outcomes[static_cast<int>(j.residual.outcome)]);
  }
  return failed ? property_failed : within_budget;
}

int run_hunt_command(const Flags& f, HuntFlags h) {
  h.options.seed = f.seed;
  if (!f.duration.empty()) h.options.seconds = parse_duration(f.duration);
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  return run_hunt(h, robot_of(f));
}

int run_report(const Flags& f) {
  const auto given = with_records_of_stores(f.records, f.out);
  std::vector<std::filesystem::path> records(given.begin(), given.end());
  if (records.empty()) {
    std::filesystem::create_directories(f.out);
    const std::filesystem::path path = std::filesystem::path(f.out) / "campaign.json";
    const auto hard_cases = hard_cases_of(f, {});
    const CampaignResult result = campaign(f, {}).value();
    if (result.incomplete) fmt::print(stderr, "interrupted: the report holds what was done\n");
    write_record(path, result, hard_cases);
    records.push_back(path);
  }
  const auto files = liecheck::reports::write_report(records, f.out);
  fmt::print("{}\n", std::filesystem::absolute(files.html).string());
  return stop_requested ? incomplete : within_budget;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"liecheck " LIECHECK_VERSION
               ": finds the numerical bugs in SE(3) and floating-base code before a robot does."};
  app.require_subcommand(1);
  // A limit on file size is an error of the write, as a full disk is, not the end of the program.
  std::signal(SIGXFSZ, SIG_IGN);
  app.set_version_flag("--version", LIECHECK_VERSION);
  Flags f;
  const auto selection_flags = [&](CLI::App* c) {
    c->add_option("--subject", f.subjects,
                  "a subject, repeatable, or 'all'; default liecheck in float and double");
    c->add_option("--property", f.properties, "a property, repeatable; default every one");
    c->add_option("--scalar", f.scalars, "float, double or float128, repeatable");
    c->add_option("--json", f.json, "write the record to FILE");
  };
  const auto budget_flags = [&](CLI::App* c) {
    c->add_option("--robot", f.robot,
                  "URDF of the robot for configuration properties; built in: mixed_joints");
    c->add_option("--seed", f.seed, "seed of the campaign")->capture_default_str();
    auto* cases = c->add_option("--cases", f.cases, "cases per property x subject x scalar")
                      ->capture_default_str()
                      ->check(CLI::Range(std::uint64_t(1), std::uint64_t(1) << 40));
    c->add_option("--for", f.duration, "run for a time instead: 30s, 5m, 1h")->excludes(cases);
    c->add_option("-j,--jobs", f.jobs, "threads; the digests do not depend on it")
        ->check(CLI::Range(1u, 1024u));
  };

  app.add_subcommand("list", "the subjects and properties");
  auto* run = app.add_subcommand(
      "campaign", "run properties on subjects. Exit 0 within budget, 1 failed, 2 bad input, 3 incomplete");
  selection_flags(run);
  run->add_flag("--no-hard-cases", f.no_hard_cases, "skip the hard cases, which are replayed first");
  budget_flags(run);
  auto* hard = app.add_subcommand(
      "hard-cases", "a verdict on every hard case. Exit 0 none failed, 1 some did, 2 bad input");
  selection_flags(hard);
  hard->add_option("--file", f.files, "more hard cases, in the form of fixtures/hard_cases, repeatable");
  hard->add_option("-j,--jobs", f.jobs, "threads")->check(CLI::Range(1u, 1024u));
  run->add_flag("--verbose", f.verbose, "show how often each class and band of inputs came up");
  HuntFlags h;
  auto* hunt = app.add_subcommand("hunt",
                                  "search for the worst input of an operation. Exit 0 within budget, 1 "
                                  "beyond it, 2 bad input, 3 incomplete");
  hunt->add_option("--subject", h.subject, "the subject")->required();
  hunt->add_option("--op", h.options.operation, "the operation, as failures and reports name it")->required();
  hunt->add_option("--block", h.options.block, "one block of its result; default each");
  hunt->add_option("--property", h.property, "one law that measures it; default each");
  hunt->add_option("--scalar", h.scalar, "float, double or float128")->capture_default_str();
  hunt->add_flag("--excess", h.options.excess, "maximise error / kappa, beyond half a turn too");
  hunt->add_option("--seed", f.seed, "seed of the search")->capture_default_str();
  hunt->add_option("--for", f.duration, "how long: 30s, 5m, 1h; default 30s")
      ->excludes(hunt->add_option("--evaluations", h.options.evaluations,
                                  "how many measurements instead: the same search on every machine")
                     ->check(CLI::Range(std::uint64_t(1), std::uint64_t(1) << 40)));
  hunt->add_flag("--versus-random", h.versus_random, "also sample as many inputs uniformly, and compare");
  hunt->add_option("--corpus", h.corpus, "append what is found to FILE, as lines of fixtures/hard_cases");
  hunt->add_option("--robot", f.robot,
                   "URDF of the robot for configuration properties; built in: mixed_joints");
  add_store_flags(*run, f.store);
  f.store.jobs = run->get_option("--jobs");
  f.store.command = command_line(argc, argv);
  auto* replay = app.add_subcommand("replay", "run one case again and print its residuals, bit for bit");
  replay->add_option("ID", f.id, "the case's address, as a failure or a report prints it")->required();
  replay->add_option("--robot", f.robot, "URDF of the robot that the ID names");
  auto* report = app.add_subcommand(
      "report", "write the accuracy report of records, or of a campaign over every subject");
  report->add_option("RECORD", f.records,
                     "stores, or records that campaign --json wrote; none: run the campaign first");
  report->add_option("--out", f.out, "folder of report.html, report.json and report.csv")
      ->capture_default_str();
  budget_flags(report);
  const StoreCommands store_commands(app);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);
    fmt::print(stderr, "liecheck: {}\n", e.what());
    return bad_input;
  }
  try {
    if (run->parsed()) return run_campaign_command(f);
    if (hard->parsed()) return run_hard_cases_command(f);
    if (hunt->parsed()) return run_hunt_command(f, h);
    if (replay->parsed()) return run_replay(f);
    if (report->parsed()) return run_report(f);
    if (const auto code = store_commands.run()) return *code;
    return run_list();
  } catch (const std::exception& e) {
    fmt::print(stderr, "liecheck: {}\n", e.what());
    return bad_input;
  }
}
