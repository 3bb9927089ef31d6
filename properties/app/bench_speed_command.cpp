#include <rapidcheck.h>

#include <fmt/format.h>
#include <algorithm>
#include <app/bench_command.hpp>
#include <app/store_commands.hpp>
#include <campaign/campaign.hpp>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <generators/rapidcheck.hpp>
#include <invariants/tree_laws.hpp>
#include <iostream>
#include <nlohmann/json.hpp>
#include <oracles/closed_forms.hpp>
#include <oracles/error.hpp>
#include <sstream>
#include <support/environment.hpp>
#include <support/files.hpp>
#include <support/progress.hpp>
#include <support/stop.hpp>

namespace liecheck::properties {
namespace {

using Clock = std::chrono::steady_clock;

/// The best rate of five rounds [cases/s].
struct Timed {
  std::string name;
  std::function<double()> round;  ///< its rate
  double best = 0;
};

/// Runs steps, each of which returns its number of cases, for that long.
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

/// Chunks of one series, as a campaign runs them.
struct Chunks {
  const Series* series;
  std::uint64_t seed, next = 0;
  Tally tally;
  std::uint64_t operator()() {
    constexpr std::uint64_t chunk = 4096;
    for (std::uint64_t i = 0; i < chunk; ++i) series->run(seed, next++, tally);
    return chunk;
  }
};

/// exp6 as a careful author tests it with RapidCheck: the law's generator, the closed form at 50 digits and the law's
/// budgets, for angles to half a turn, where they need no condition number. Adds to `falsified` where rc::check does.
std::uint64_t check_exp6(const Subject<double>& subject, std::uint64_t cases, int& falsified) {
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
    const Pose<double> T = subject.operations.exp6(xi);
    RC_ASSERT(rotation_error<double>(exact_matrix<3, 3, Real>(T.R), exact.Q) <= rotation);
    RC_ASSERT(orthogonality_defect<double>(exact_matrix<3, 3, Real>(T.R)) <= defect);
    RC_ASSERT(vector_error<double>(exact_vector<3, Real>(T.p), exact.p) <= translation);
  });
  if (buffer) std::cerr.rdbuf(buffer);
  return run;
}

}  // namespace

int run_speed_bench(const BenchFlags& f, const Robot& robot) {
  const auto tested = subjects<double>();
  const Subject<double>& liecheck =
      **std::find_if(tested.begin(), tested.end(), [](const auto* s) { return s->name == "liecheck"; });
  Subject<double> only_exp6 = liecheck;
  only_exp6.operations = {};
  only_exp6.operations.exp6 = liecheck.operations.exp6;
  const auto exp6 = series_of("exp_oracle", only_exp6, robot);
  const auto all = select({{"liecheck"}, {}, {"float", "double"}}, robot);

  int falsified = 0;
  std::vector<Timed> rows;
  const auto chunks = [&](const Series& s) {
    return [&f, run = std::make_shared<Chunks>(Chunks{&s, f.seed, 0, {}})] { return rate(f.seconds, *run); };
  };
  rows.push_back({"exp6 double", chunks(*exp6)});
  rows.push_back({"exp6 double, rc::check, 50 digits",
                  [&] { return rate(f.seconds, [&] { return check_exp6(only_exp6, 1000, falsified); }); }});
  for (const auto& s : all) rows.push_back({s->property + " " + s->scalar, chunks(*s)});
  std::vector<std::string> plain;
  for (const auto& s : all)
    if (!is_tree_law(s->property)) plain.push_back(s->property);
  const auto campaign = [&](unsigned jobs) {
    return [&, jobs] {
      CampaignOptions o;
      o.selection = {{"liecheck"}, plain, {"float", "double"}};
      o.seed = f.seed, o.jobs = jobs, o.quiet = true;
      o.cases = static_cast<std::uint64_t>(std::max(1.0, 20000 * f.seconds));
      return rate(0, [&] { return run_campaign(o, robot).total_cases; });
    };
  };
  rows.push_back({"campaign, 1 job", campaign(1)});
  rows.push_back({"campaign, 2 jobs", campaign(2)});

  constexpr int rounds = 5;
  const auto all_steps = static_cast<double>(rounds * rows.size());
  double steps = 0;
  {
    Progress progress("bench speed");
    for (int round = 0; round < rounds && !stop_requested; ++round)
      for (Timed& row : rows) {
        if (stop_requested) break;
        progress.show(steps++ / all_steps,
                      [&](double) { return fmt::format("round {}: {}", round + 1, row.name); });
        row.best = std::max(row.best, row.round());
      }
  }
  if (stop_requested) {
    std::fputs("interrupted: a rate is the best of five rounds, which were not run\n", stderr);
    return incomplete;
  }

  nlohmann::json table = nlohmann::json::array();
  fmt::print("{:<40}{:>14}\n", "best of five rounds, one core", "cases/s");
  for (const Timed& row : rows) {
    fmt::print("{:<40}{:>14.0f}\n", row.name, row.best);
    table.push_back({{"name", row.name}, {"cases_per_second", row.best}});
  }
  // A case of a law of trees is a model, its Data and its dynamics: a figure of its own.
  const auto mean_of = [&](bool trees) {
    double seconds = 0, laws = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (is_tree_law(all[i]->property) == trees) seconds += 1 / rows[2 + i].best, ++laws;
    return laws / seconds;
  };
  const double mean = mean_of(false), trees = mean_of(true), over = rows[0].best / rows[1].best,
               jobs = rows.back().best / rows[rows.size() - 2].best;
  fmt::print(
      "\nall laws but those of trees, as many cases of each: {:.0f} cases/s; of trees {:.0f}; exp6 {:.1f} "
      "times "
      "rc::check; 2 jobs {:.2f} times 1\n",
      mean, trees, over, jobs);
  if (!f.json.empty())
    write_whole(f.json, nlohmann::json({{"version", LIECHECK_VERSION},
                                        {"verdict", falsified ? "fail" : "pass"},
                                        {"seed", f.seed},
                                        {"environment", nlohmann::json::parse(environment_text())},
                                        {"rows", table},
                                        {"all_laws", mean},
                                        {"tree_laws", trees},
                                        {"exp6_over_rapidcheck", over},
                                        {"two_jobs_over_one", jobs}})
                                .dump(1) +
                            "\n");
  if (falsified)
    fmt::print("rc::check found exp6 beyond its budget {} times: its lines say nothing of speed\n",
               falsified);
  return falsified ? property_failed : within_budget;
}

}  // namespace liecheck::properties
