// The liecheck program: list, campaign, hard-cases, hunt, sweep, bench, replay, report, and what to do with stores.

#include <fcntl.h>
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <app/arguments.hpp>
#include <app/bench_command.hpp>
#include <app/campaign_table.hpp>
#include <app/cost_command.hpp>
#include <app/hard_cases_command.hpp>
#include <app/hunt_command.hpp>
#include <app/robot_command.hpp>
#include <app/scene_command.hpp>
#include <app/scene_sweep_command.hpp>
#include <app/store_commands.hpp>
#include <app/sweep_command.hpp>
#include <atomic>
#include <campaign/campaign.hpp>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <record/campaign.hpp>
#include <reports/report.hpp>
#include <set>
#include <support/files.hpp>
#include <support/stop.hpp>
#include <support/text.hpp>
#include <thread>
#include <timing/kernels.hpp>

namespace {

using namespace liecheck::properties;

/// Once: finish the chunk. Twice: at once. Two within 0.3 s, longer than a busy machine delays one and shorter than a
/// second thought, are one: `timeout` sends its own to the program and then to the program's whole group.
extern "C" void on_signal(int number) {
  static std::atomic<long> stopped_at{-1};  // [ms]
  timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  const long now = t.tv_sec * 1000 + t.tv_nsec / 1000000;
  long first = -1;
  if (!stopped_at.compare_exchange_strong(first, now) && now - first > 300)
    std::signal(number, SIG_DFL), std::raise(number);
  stop_requested = true;
}

struct Flags {
  std::vector<std::string> subjects, properties, scalars;
  std::string robot, root = "free-flyer", json, duration, id, out = "liecheck-report";
  std::vector<std::string> records, files;
  bool no_hard_cases = false, no_cost = false, no_scenes = false, verbose = false;
  std::uint64_t seed = 42, cases = 1000;
  unsigned jobs = std::max(1u, std::thread::hardware_concurrency());
  StoreFlags store;
};

/// Read once: it may be a pipe.
const Robot& robot_of(const Flags& f) {
  static const Robot robot = f.robot.empty() ? built_in_robot() : load_robot(f.robot, f.root == "fixed");
  return robot;
}

/// Before anything runs. The exit is a line, not an empty table.
void check_not_empty(const Selection& selection, const Robot& robot) {
  if (select(selection, robot).empty())
    throw std::invalid_argument(
        "nothing to run: no selected subject offers a selected property in that scalar");
}

/// liecheck in float and double unless told; "all" is everything.
Selection selection_of(const Flags& f) {
  Selection s{f.subjects, f.properties, f.scalars};
  if (f.subjects.empty()) {
    s.subjects = {"liecheck"};
    if (f.scalars.empty()) s.scalars = {"float", "double"};
  } else if (std::erase(s.subjects, "all") > 0) {
    check_subjects(s.subjects);
    s.subjects.clear();
  }
  return s;
}

/// Not before the robot is read: that may wait for a pipe. nohup's choice stands.
void stop_on_signals() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(number, on_signal) == SIG_IGN) std::signal(number, SIG_IGN);
}

std::optional<StoredRun> campaign(const Flags& f, const Selection& selection) {
  CampaignOptions options;
  options.selection = selection;
  options.seed = f.seed;
  options.cases = f.cases;
  options.jobs = f.jobs;
  if (!f.duration.empty()) options.seconds = parse_duration(f.duration);
  const Robot& robot = robot_of(f);
  stop_on_signals();
  return run_stored_campaign(options, robot, f.store);
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
      "  textbook:1e-1 ... textbook:1e-12: variants with their cutoff there, run where they are named\n"
      "  bug:NAME, alike:NAME: known bugs and look-alikes, as 'liecheck bench bugs' names them; likewise\n");
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

/// Returns why it could not be written, to be told after the table: neither is lost with the other.
std::string write_record(const std::filesystem::path& path, const StoredRun& run,
                         const std::vector<HardRow>& hard_cases, const SweepResult* swept = nullptr,
                         const CostResult* cost = nullptr, const SceneSweepResult* scenes = nullptr) try {
  auto record = record_of(run.result, run.counterexamples, run.environment);
  add_hard_cases(record, hard_cases);
  if (swept) add_sweep(record, *swept);
  if (cost) add_cost(record, *cost);
  if (scenes) add_scene_sweep(record, *scenes);
  write_whole(path, record.dump(1) + "\n");
  return "";
} catch (const std::exception& e) {
  return e.what();
}

int run_campaign_command(const Flags& f) {
  if (!f.json.empty()) check_writable(f.json);
  const Selection selection = selection_of(f);
  check_not_empty(selection, robot_of(f));
  check_store_flags(f.store, !f.duration.empty());
  stop_on_signals();
  // Of a campaign in shards the first one replays the hard cases.
  const auto hard_cases = f.store.first_shard() ? hard_cases_of(f, selection) : std::vector<HardRow>{};
  if (!f.no_hard_cases && f.store.first_shard())
    print_hard_case_summary(hard_cases, 3), fmt::print("\n"), std::fflush(stdout);
  if (stop_requested) {
    std::fputs("interrupted in the hard cases: no case was run\n", stderr);
    return incomplete;
  }
  const auto done = campaign(f, selection);
  if (!done) return within_budget;
  const CampaignResult& result = done->result;
  const std::string lost = f.json.empty() ? "" : write_record(f.json, *done, hard_cases);
  print_counterexamples(done->counterexamples);
  const int code = print_campaign(result, f.verbose);
  print_how_to_go_on(result, f.store);
  if (!lost.empty()) throw std::runtime_error(lost);
  if (any_failed(hard_cases)) fmt::print("hard cases failed: see the first section\n");
  return code == within_budget && any_failed(hard_cases) ? property_failed : code;
}

int run_hard_cases_command(const Flags& f) {
  if (!f.json.empty()) check_writable(f.json);
  StoredRun run;
  CampaignResult& result = run.result;
  result.options.cases = 0;
  result.robot = robot_of(f);
  const auto cases = corpus_with(f.files);
  stop_on_signals();
  const auto rows = run_hard_cases(selection_of(f), result.robot, cases, f.jobs);
  result.incomplete = stop_requested;
  if (rows.empty() && !stop_requested)
    throw std::invalid_argument("nothing to run: no selected subject offers a hard case's property");
  const std::string lost = f.json.empty() ? "" : write_record(f.json, run, rows);
  print_hard_case_table(rows);
  print_hard_case_summary(rows, rows.size());
  if (!lost.empty()) throw std::runtime_error(lost);
  if (stop_requested) std::fputs("interrupted: the rows that were done\n", stderr);
  return stop_requested ? incomplete : any_failed(rows) ? property_failed : within_budget;
}

int run_replay(const Flags& f) {
  const CaseId id = CaseId::parse(f.id);
  const Robot robot = robot_of(f);
  const auto found = select({{id.subject}, {id.property}, {id.scalar}}, robot);
  if (found.empty())
    throw std::invalid_argument(
        fmt::format("{} in {} does not offer {}", id.subject, id.scalar, id.property));
  const Series& series = *found.front();
  if (series.robot == "none" && id.robot != "none")
    throw std::invalid_argument(fmt::format(
        "case ID '{}' names robot {}, but {} takes no robot: expected none", f.id, id.robot, id.property));
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
  const Robot& robot = robot_of(f);
  stop_on_signals();
  return run_hunt(h, robot);
}

int run_bench_command(const Flags& f, BenchFlags b, bool speed) {
  b.seed = f.seed;
  if (!f.duration.empty()) b.seconds = parse_duration(f.duration);
  if (!f.json.empty()) check_writable(f.json);
  b.json = f.json;
  const Robot& robot = robot_of(f);
  stop_on_signals();
  return speed ? run_speed_bench(b, robot) : run_bench(b, robot);
}

int run_sweep_flags(const Flags& f, SweepFlags s) {
  s.jobs = f.jobs;
  s.json = f.json;
  stop_on_signals();
  return run_sweep_command(s);
}

int run_cost_flags(const Flags& f, CostFlags c) {
  c.options.seed = f.seed;
  c.json = f.json;
  if (!f.duration.empty()) c.options.seconds = parse_duration(f.duration);
  stop_on_signals();
  return run_cost_command(c);
}

int run_report(const Flags& f) {
  const auto given = with_records_of_stores(f.records, f.out);
  std::vector<std::filesystem::path> records(given.begin(), given.end());
  if (records.empty()) {
    std::error_code error;
    std::filesystem::create_directories(f.out, error);
    if (error)
      throw std::runtime_error(fmt::format("--out {}: cannot be created: {}", f.out, error.message()));
    const std::filesystem::path path = std::filesystem::path(f.out) / "campaign.json";
    check_writable(path);
    const auto hard_cases = hard_cases_of(f, {});
    const StoredRun run = campaign(f, {}).value();
    if (run.result.incomplete) std::fputs("interrupted: the report holds what was done\n", stderr);
    std::optional<SweepResult> swept;
    if (!stop_requested) {
      swept = run_sweep({{}, "", f.jobs});
      if (stop_requested) std::fputs("interrupted in the sweep: the report holds what was done\n", stderr);
    }
    std::optional<CostResult> cost;
    if (!stop_requested && !f.no_cost) {
      CostFlags c;
      c.options.seed = f.seed;
      c.options.seconds = 30;
      c.options.flags = has_kernels();
      cost = run_cost(c);
      if (stop_requested) std::fputs("interrupted in the times: the report holds what was done\n", stderr);
    }
    std::optional<SceneSweepResult> scenes;
    if (!stop_requested && !f.no_scenes) {
      SceneSweepFlags s;
      s.options.order_scenes = 3;
      s.flips = 3;
      s.options.order_seconds = 6;
      s.options.longest = 0.004;
      s.options.seconds = 12;
      s.options.repetitions = 7;
      scenes = run_scene_sweep(s);
      if (stop_requested) std::fputs("interrupted in the scenes: the report holds what was done\n", stderr);
    }
    const std::string lost = write_record(path, run, hard_cases, swept ? &*swept : nullptr,
                                          cost ? &*cost : nullptr, scenes ? &*scenes : nullptr);
    if (!lost.empty()) throw std::runtime_error(lost);
    records.push_back(path);
  }
  const auto files = liecheck::reports::write_report(records, f.out);
  fmt::print("{}\n", std::filesystem::absolute(files.html).string());
  return stop_requested ? incomplete : within_budget;
}

/// The exit code once everything printed is out; bad_input where some of it is lost.
int finish(int code) {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.flush()) return code;
  // Not fmt::print, which throws where stderr is lost too.
  std::fprintf(stderr, "liecheck: standard output: cannot be written%s%s\n", errno ? ": " : "",
               errno ? std::strerror(errno) : "");
  return bad_input;
}

int refuse(const std::string& why) {
  std::fprintf(stderr, "liecheck: %s\n", printable(why).c_str());
  return finish(bad_input);
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);  // a reader who left is a failed write
  // No file that is opened later may take the place of a closed standard stream.
  for (int fd = 0; fd < 3; ++fd)
    if (::fcntl(fd, F_GETFD) < 0 && ::open("/dev/null", O_RDONLY) != fd) return bad_input;
  CLI::App app{"liecheck " LIECHECK_VERSION
               ": finds the numerical bugs in SE(3) and floating-base code before a robot does."};
  app.require_subcommand(1);
  // A limit on file size is an error of the write, as a full disk is, not the end of the program.
  std::signal(SIGXFSZ, SIG_IGN);
  app.set_version_flag("--version", LIECHECK_VERSION);
  Flags f;
  const auto robot_flag = [&](CLI::App* c, const char* help) {
    auto* robot = filled(c->add_option("--robot", f.robot, help), "URDF");
    filled(c->add_option("--root", f.root, "how the robot stands in the world: free-flyer or fixed")
               ->capture_default_str()
               ->check(CLI::IsMember({"free-flyer", "fixed"})),
           "ROOT")
        ->needs(robot);
    return robot;
  };
  const char* robot_help = "robot for configuration properties; built in: mixed_joints";
  const auto jobs_flag = [&](CLI::App* c) {
    return add_number(*c, "-j,--jobs", f.jobs, 1, 1024, "threads; the digests do not depend on it");
  };
  const auto selection_flags = [&](CLI::App* c) {
    filled(c->add_option("--subject", f.subjects,
                         "a subject, repeatable, or 'all'; default liecheck in float and double"),
           "NAME");
    filled(c->add_option("--property", f.properties, "a property, repeatable; default every one"), "NAME");
    filled(c->add_option("--scalar", f.scalars, "float, double or float128, repeatable"), "SCALAR");
    filled(c->add_option("--json", f.json, "write the record to FILE"), "FILE");
  };
  const auto wrong = [](const std::string& text) -> std::string {
    try {
      parse_duration(text);
      return "";
    } catch (const std::exception& e) {
      return e.what();
    }
  };
  const auto time_flag = [&](CLI::App* c, const char* help, CLI::Option* other) {
    return filled(c->add_option("--for", f.duration, help)->excludes(other), "DURATION")->check(wrong, "");
  };
  const auto budget_flags = [&](CLI::App* c) {
    auto* cases = add_number(*c, "--cases", f.cases, 1, std::uint64_t(1) << 40,
                             "cases per property x subject x scalar");
    return std::vector<CLI::Option*>{
        robot_flag(c, robot_help), add_number(*c, "--seed", f.seed, 0, UINT64_MAX, "seed of the campaign"),
        cases, time_flag(c, "run for a time instead: 30s, 5m, 1h", cases), jobs_flag(c)};
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
  filled(
      hard->add_option("--file", f.files, "more hard cases, in the form of fixtures/hard_cases, repeatable"),
      "FILE");
  jobs_flag(hard);
  run->add_flag("--verbose", f.verbose, "show how often each class and band of inputs came up");
  HuntFlags h;
  auto* hunt = app.add_subcommand("hunt",
                                  "search for the worst input of an operation. Exit 0 within budget, 1 "
                                  "beyond it, 2 bad input, 3 incomplete");
  filled(hunt->add_option("--subject", h.subject, "the subject"), "NAME")->required();
  filled(hunt->add_option("--op", h.options.operation, "the operation, as failures and reports name it"),
         "NAME")
      ->required();
  filled(hunt->add_option("--block", h.options.block, "one block of its result; default each"), "NAME");
  filled(hunt->add_option("--property", h.property, "one law that measures it; default each"), "NAME");
  filled(hunt->add_option("--scalar", h.scalar, "float, double or float128")->capture_default_str(),
         "SCALAR");
  hunt->add_flag("--excess", h.options.excess, "maximise error / kappa, beyond half a turn too");
  add_number(*hunt, "--seed", f.seed, 0, UINT64_MAX, "seed of the search");
  auto* evaluations = add_number(*hunt, "--evaluations", h.options.evaluations, 1, std::uint64_t(1) << 40,
                                 "how many measurements instead: the same search on every machine");
  evaluations->default_str("");
  time_flag(hunt, "how long: 30s, 5m, 1h; default 30s", evaluations);
  hunt->add_flag("--versus-random", h.versus_random, "also sample as many inputs uniformly, and compare");
  filled(
      hunt->add_option("--corpus", h.corpus, "append what is found to FILE, as lines of fixtures/hard_cases"),
      "FILE");
  robot_flag(hunt, robot_help);
  add_store_flags(*run, f.store);
  f.store.jobs = run->get_option("--jobs");
  f.store.command = command_line(argc, argv);
  BenchFlags b;
  auto* bench = app.add_subcommand("bench", "what the harness is worth");
  bench->require_subcommand(1);
  auto* bugs = bench->add_subcommand(
      "bugs",
      "how soon the laws kill each known bug, beside four weaker styles of test. "
      "Exit 0 all killed and no look-alike refused, 1 otherwise, 2 bad input, 3 stopped");
  filled(bugs->add_option("--scalar", b.scalar, "float or double")
             ->capture_default_str()
             ->check(CLI::IsMember({"float", "double"})),
         "SCALAR");
  add_number(*bugs, "--seed", f.seed, 0, UINT64_MAX, "seed of the cases");
  filled(
      bugs->add_option("--for-each", f.duration,
                       "how long for each bug, and a tenth of it for each look-alike: 30s, 5m; default 60s"),
      "DURATION")
      ->check(wrong, "");
  filled(bugs->add_option("--json", f.json, "write the table to FILE"), "FILE");
  auto* speed = bench->add_subcommand("speed",
                                      "cases a second against an oracle, on one core: exp6 beside rc::check "
                                      "with an oracle of 50 digits, every law, and "
                                      "two jobs beside one. Exit 0, 2 bad input, 3 stopped");
  add_number(*speed, "--seed", f.seed, 0, UINT64_MAX, "seed of the cases");
  filled(speed->add_option("--for-each", f.duration,
                           "how long each of the five rounds of a row takes; default 0.5s"),
         "DURATION")
      ->check(wrong, "");
  filled(speed->add_option("--json", f.json, "write the table to FILE"), "FILE");
  robot_flag(bugs, robot_help);
  SweepFlags s;
  auto* swept = app.add_subcommand("sweep",
                                   "an upper bound of the error of every scalar coefficient over every "
                                   "float. Exit 0 the documented bounds "
                                   "hold, 1 one does not, 2 bad input, 3 stopped");
  filled(swept->add_option("--coefficient", s.coefficients, "a coefficient, repeatable; default all"),
         "NAME");
  add_number(*swept, "--stride", s.stride, 1, 1u << 30, "only every Nth float: a lower bound, sooner");
  jobs_flag(swept);
  filled(swept->add_option("--json", f.json, "write the bounds to FILE"), "FILE");
  RobotFlags robot;
  auto* listed =
      app.add_subcommand("robot", "what a URDF becomes: joints, offsets, warnings. Exit 0, 2 bad input");
  filled(listed->add_option("FILE", robot.file, "the URDF"), "URDF")->required();
  listed->add_option("--root", robot.root, "how its root is connected to the world")
      ->check(CLI::IsMember({"fixed", "free-flyer", "planar", "spherical", "translation"}));
  listed->add_flag("--mimic", robot.tied, "mimic joints have no numbers of their own");
  listed->add_flag("--strict", robot.strict, "a warning is an error");
  CostFlags c;
  auto* cost =
      app.add_subcommand("cost",
                         "time beside error, of every operation of every subject on the same inputs. "
                         "Exit 0, 2 bad input, 3 stopped");
  filled(cost->add_option("--op", c.options.operations, "an operation, repeatable; default all"), "NAME");
  filled(cost->add_option("--subject", c.options.subjects,
                          "a subject, repeatable; default those of a campaign and liecheck's own variants"),
         "NAME");
  filled(cost->add_option("--scalar", c.options.scalars,
                          fmt::format("{}, repeatable; default all", fmt::join(cost_scalars(), ", "))),
         "SCALAR");
  cost->add_flag("--flags", c.options.flags, "also liecheck in double as other compilers and flags make it");
  add_number(*cost, "--seed", f.seed, 0, UINT64_MAX, "seed of the inputs");
  filled(cost->add_option("--for", f.duration, "about how long all timing takes: 30s, 5m; default 60s"),
         "DURATION")
      ->check(wrong, "");
  filled(cost->add_option("--json", f.json, "write times and errors to FILE"), "FILE");
  SceneFlags scene;
  auto* scenes = app.add_subcommand("scene", "a motion, described by a file: fixtures/scenes/README.md");
  scenes->require_subcommand(1);
  auto* scene_run = scenes->add_subcommand(
      "run", "simulate it. Exit 0, 2 bad input, 3 it diverged or was stopped: what was done is kept");
  filled(scene_run->add_option("FILE", scene.file, "the scene"), "SCENE")->required();
  filled(scene_run->add_option("--csv", scene.csv, "write the samples to FILE, not where the scene says"),
         "FILE");
  filled(scene_run->add_option("--json", scene.json, "write samples and figures to FILE, likewise"), "FILE");
  auto* scene_explain = scenes->add_subcommand("explain",
                                               "its plan: what is computed, what was left out and why, and "
                                               "what each stage costs. Exit 0, 2 bad input");
  filled(scene_explain->add_option("FILE", scene.file, "the scene"), "SCENE")->required();
  SceneSweepFlags ss;
  auto* scene_sweep = scenes->add_subcommand(
      "sweep",
      "integrators x steps: error against the exact motion, order, "
      "drift, time, beside other simulators. Exit 0, 1 an "
      "order is not what was promised, 2 bad input, 3 stopped, or every run of a scene diverges");
  filled(scene_sweep->add_option("FILE", ss.files, "scenes; default the built-in ones, and long spins"),
         "SCENE");
  filled(scene_sweep->add_option("--integrator", ss.options.integrators,
                                 "an integrator, repeatable; default all"),
         "NAME");
  scene_sweep
      ->add_option_function<std::vector<std::string>>(
          "--steps",
          [&ss](const std::vector<std::string>& all) {
            for (const std::string& n : all)
              ss.options.steps.push_back(long(decimal("--steps", n, 4, 1u << 30)));
          },
          "steps over the whole duration, multiples of 4, repeatable; default from coarse to the floor of "
          "rounding")
      ->type_name("N")
      ->allow_extra_args(false);
  scene_sweep->add_flag("--no-orders", ss.no_orders, "do not measure orders");
  scene_sweep->add_flag("--no-times", ss.no_times, "do not measure times");
  scene_sweep->add_flag("--no-peers", ss.no_peers, "leave out other simulators");
  filled(
      scene_sweep->add_option("--for", f.duration, "about how long all timing takes: 30s, 5m; default 20s"),
      "DURATION")
      ->check(wrong, "");
  filled(scene_sweep->add_option("--json", ss.json, "write errors, orders, drift and times to FILE"), "FILE");
  auto* scene_keys = scenes->add_subcommand("keys", "every key that a scene may have. Exit 0");
  auto* replay = app.add_subcommand("replay",
                                    "run one case again and print its residuals, bit for bit. Exit 0 within "
                                    "budget, 1 failed, 2 bad input");
  replay->add_option("ID", f.id, "the case's address, as a failure or a report prints it")->required();
  robot_flag(replay, "the robot that the ID names");
  auto* report = app.add_subcommand(
      "report",
      "write the accuracy report of records, or of a campaign over every subject. Exit 0 when it is written, "
      "whatever its verdict, 2 bad input, 3 its campaign was interrupted");
  auto* records = filled(
      report->add_option("RECORD", f.records,
                         "stores, or records that campaign --json wrote; none: run the campaign first"),
      "FILE");
  filled(report->add_option("--out", f.out, "folder of report.html, report.json and report.csv")
             ->capture_default_str(),
         "DIR");
  report->add_flag("--no-cost", f.no_cost, "leave out the times, which take about 35 s")->excludes(records);
  report->add_flag("--no-scenes", f.no_scenes, "leave out the scenes, which take about 40 s")
      ->excludes(records);
  for (auto* option : budget_flags(report)) option->excludes(records);
  const StoreCommands store_commands(app);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return e.get_exit_code() == 0 ? finish(app.exit(e)) : refuse(usage_error(app, e));
  }
  try {
    if (run->parsed()) return finish(run_campaign_command(f));
    if (hard->parsed()) return finish(run_hard_cases_command(f));
    if (bugs->parsed()) return finish(run_bench_command(f, b, false));
    if (speed->parsed()) {
      b.seconds = 0.5;
      return finish(run_bench_command(f, b, true));
    }
    if (swept->parsed()) return finish(run_sweep_flags(f, s));
    if (listed->parsed()) return finish(run_robot_command(robot));
    if (cost->parsed()) return finish(run_cost_flags(f, c));
    if (scene_run->parsed()) {
      stop_on_signals();
      return finish(run_scene_command(scene));
    }
    if (scene_sweep->parsed()) {
      if (!f.duration.empty()) ss.options.seconds = parse_duration(f.duration);
      stop_on_signals();
      return finish(run_scene_sweep_command(ss));
    }
    if (scene_explain->parsed()) return finish(explain_scene_command(scene));
    if (scene_keys->parsed()) return finish(scene_keys_command());
    if (hunt->parsed()) return finish(run_hunt_command(f, h));
    if (replay->parsed()) return finish(run_replay(f));
    if (report->parsed()) return finish(run_report(f));
    if (const auto code = store_commands.run()) return finish(*code);
    return finish(run_list());
  } catch (const std::exception& e) {
    return std::ferror(stdout) ? finish(bad_input) : refuse(e.what());
  }
}
