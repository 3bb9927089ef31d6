#include <rapidcheck.h>

#include <fmt/format.h>
#include <algorithm>
#include <campaign/campaign.hpp>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <generators/rapidcheck.hpp>
#include <invariants/tree_laws.hpp>
#include <iostream>
#include <memory>
#include <oracles/closed_forms.hpp>
#include <oracles/error.hpp>
#include <results/bench.hpp>
#include <sstream>
#include <subjects/typed.hpp>
#include <support/progress.hpp>
#include <support/say.hpp>
#include <support/stop.hpp>
#include "lab_commands.hpp"

namespace liecheck::properties {

namespace {

using Clock = std::chrono::steady_clock;

struct SpeedFlags {
  std::uint64_t seed = 42;
  double seconds = 0.5;  ///< duration of one round of a row
  std::string json;
};

/// A row of the table: its result is the best rate of five rounds [cases/s].
struct Timed {
  std::string name;
  std::function<double()> round;  ///< returns its rate
  double best = 0;
};

/// Calls step() for `seconds` and returns the rate [cases/s]. step() returns the number of cases that it ran.
template <class F>
double rate(double seconds, F&& step) {
  const auto start = Clock::now();
  std::uint64_t cases = 0;
  double elapsed = 0;
  do {
    cases += step();
    elapsed = std::chrono::duration<double>(Clock::now() - start).count();
  } while (elapsed < seconds && !stop_requested);
  return static_cast<double>(cases) / elapsed;
}

/// Chunks of one series, as a campaign runs them. Polls stop_requested.
struct Chunks {
  const Series* series;
  std::uint64_t seed, next = 0;
  Tally tally;
  std::uint64_t operator()() {
    constexpr std::uint64_t chunk = 4096;
    std::uint64_t done = 0;
    for (; done < chunk && !stop_requested; ++done) series->run(seed, next++, tally);
    return done;
  }
};

/// Tests exp6 as a careful author does with RapidCheck: with the law's generator and budgets and the closed
/// form at 50 digits, up to theta = pi, where budgets need no condition number. `falsified` counts failures.
std::uint64_t check_exp6(const TypedSubject<double>& subject, std::uint64_t cases, int& falsified) {
  static const bool configured = [cases] {
    return setenv("RC_PARAMS", fmt::format("max_success={} seed=42", cases).c_str(), 1) == 0;
  }();
  const auto limit = [](const char* block) {
    return budget_of("liecheck", "exp6", block, Region::to_pi).limit;
  };
  const double rotation = limit("rotation"), defect = limit("orthogonality defect"),
               translation = limit("translation");
  std::ostringstream quiet;
  auto* const buffer = configured ? std::cerr.rdbuf(quiet.rdbuf()) : nullptr;
  std::uint64_t run = 0;
  falsified += !rc::check("exp6", [&] {
    using namespace oracles;
    const Vec<double, 6> xi = *gen::twist<double>(AngleRange::to_pi);
    ++run;
    const auto exact = closed_exp(exact_vector<6, Real>(xi));
    const Pose<double> T = subject.operations[op::exp6](xi);
    RC_ASSERT(rotation_error(scalar_of<double>, exact_matrix<3, 3, Real>(T.R), exact.Q) <= rotation);
    RC_ASSERT(orthogonality_defect(scalar_of<double>, exact_matrix<3, 3, Real>(T.R)) <= defect);
    RC_ASSERT(vector_error(scalar_of<double>, exact_vector<3, Real>(T.p), exact.p) <= translation);
  });
  if (buffer) std::cerr.rdbuf(buffer);
  return run;
}

/// Times exp6 by its law and by rc::check, every law on liecheck in float and double, and whole campaigns.
class Bench {
 public:
  explicit Bench(const SpeedFlags& f) : f_(f), robot_(built_in_robot()) {
    const auto tested = typed_subjects<double>();
    only_exp6_ =
        **std::find_if(tested.begin(), tested.end(), [](const auto* s) { return s->name == "liecheck"; });
    const auto operation = only_exp6_.operations[op::exp6];
    only_exp6_.operations = {};
    only_exp6_.operations[op::exp6] = operation;
    erased_ = erased(only_exp6_);
    exp6_ = series_of("exp_oracle", erased_, robot_);
    laws_ = select({{"liecheck"}, {}, {"float", "double"}}, robot_);
    rows_.push_back(chunks("exp6 double", *exp6_));
    rows_.push_back({"exp6 double, rc::check, 50 digits", [this] {
                       return rate(f_.seconds, [this] { return check_exp6(only_exp6_, 1000, falsified_); });
                     }});
    for (const auto& s : laws_) rows_.push_back(chunks(s->property + " " + s->scalar, *s));
    rows_.push_back({"campaign, 1 job", [this] { return campaign(1); }});
    rows_.push_back({"campaign, 2 jobs", [this] { return campaign(2); }});
  }

  /// Runs five rounds over all rows, so that disturbances affect all rows alike. Polls stop_requested.
  void run() {
    constexpr int rounds = 5;
    const auto all_steps = static_cast<double>(rounds * rows_.size());
    double steps = 0;
    Progress progress("speed");
    for (int round = 0; round < rounds; ++round)
      for (Timed& row : rows_) {
        progress.show(steps++ / all_steps,
                      [&](double) { return fmt::format("round {}: {}", round + 1, row.name); });
        const double found = row.round();
        if (!stop_requested || row.best == 0) row.best = std::max(row.best, found);
        if (stop_requested) return;  // this round was cut short: it counts only if the row has no other
      }
    complete_ = true;
  }

  SpeedBench result() const {
    SpeedBench b;
    b.seed = f_.seed;
    b.complete = complete_;
    b.falsified = falsified_;
    for (const Timed& row : rows_)
      if (row.best > 0) b.rates.emplace_back(row.name, row.best);
    if (!complete_) return b;
    b.all_laws = mean_rate(false);
    b.tree_laws = mean_rate(true);
    b.exp6_over_rapidcheck = rows_[0].best / rows_[1].best;
    b.two_jobs_over_one = rows_.back().best / rows_[rows_.size() - 2].best;
    return b;
  }

 private:
  Timed chunks(const std::string& name, const Series& s) const {
    return {name, [this, run = std::make_shared<Chunks>(Chunks{&s, f_.seed, 0, {}})] {
              return rate(f_.seconds, *run);
            }};
  }

  double campaign(unsigned jobs) const {
    CampaignOptions o;
    o.selection = {{"liecheck"}, {}, {"float", "double"}};
    for (const auto& s : laws_)
      if (!is_tree_law(s->property)) o.selection.properties.push_back(s->property);
    o.seed = f_.seed, o.jobs = jobs, o.quiet = true;
    o.cases = static_cast<std::uint64_t>(std::max(1.0, 20000 * f_.seconds));
    return rate(0, [&] { return run_campaign(o, robot_).total_cases; });
  }

  /// The rate if each law runs the same number of cases. Laws of trees have a separate rate, because each of
  /// their cases builds a model and its Data and computes dynamics.
  double mean_rate(bool trees) const {
    double seconds = 0, laws = 0;
    for (std::size_t i = 0; i < laws_.size(); ++i)
      if (is_tree_law(laws_[i]->property) == trees) seconds += 1 / rows_[2 + i].best, ++laws;
    return laws / seconds;
  }

  const SpeedFlags& f_;
  Robot robot_;
  TypedSubject<double> only_exp6_;
  Subject erased_;
  std::unique_ptr<Series> exp6_;
  std::vector<std::unique_ptr<Series>> laws_;
  std::vector<Timed> rows_;
  int falsified_ = 0;      ///< how often rc::check failed
  bool complete_ = false;  ///< all rounds were run
};

void print(const SpeedBench& b) {
  say("{:<40}{:>14}\n", "best of five rounds, one core", "cases/s");
  for (const auto& [name, rate] : b.rates) say("{:<40}{:>14.0f}\n", name, rate);
  if (!b.complete) {
    say("\ninterrupted: the best of the rounds that were done\n");
    return;
  }
  say("\nall laws together, except those of trees: {:.0f} cases/s; those of trees: {:.0f} cases/s; "
      "exp6: {:.1f} times rc::check; 2 jobs: {:.2f} times 1 job\n",
      b.all_laws, b.tree_laws, b.exp6_over_rapidcheck, b.two_jobs_over_one);
}

int run(const SpeedFlags& f) {
  Bench bench(f);
  stop_on_signals();
  bench.run();
  const SpeedBench b = bench.result();
  do_both([&] { write_record_of(f.json, b); }, [&] { print(b); });
  if (b.falsified)
    say("rc::check found exp6 beyond its budget {} times: the rates of exp6 mean nothing\n", b.falsified);
  return !b.complete ? incomplete : b.falsified ? property_failed : within_budget;
}

}  // namespace

Command speed_command(CLI::App& lab) {
  CommandWith<SpeedFlags> a(
      lab, "speed",
      "measure cases per second beside an oracle: exp6 compared with rc::check and an oracle of 50 digits, "
      "every "
      "law, and two jobs compared with one. Exit code 0; 1 if rc::check failed; 2 for bad input; 3 if "
      "stopped");
  a.seed(a->seed, "seed of the cases");
  a.duration("--for-each", a->seconds, "how long each of the five rounds of a row takes; default 0.5s");
  a.json(a->json, "write the table to FILE");
  return a.runs(run);
}

}  // namespace liecheck::properties
