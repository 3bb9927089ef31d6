#include <rapidcheck.h>

#include <fmt/format.h>
#include <algorithm>
#include <bench_command.hpp>
#include <campaign/campaign.hpp>
#include <chrono>
#include <commands_store.hpp>
#include <cstdlib>
#include <functional>
#include <generators/rapidcheck.hpp>
#include <iostream>
#include <nlohmann/json.hpp>
#include <oracles/closed.hpp>
#include <oracles/error.hpp>
#include <reports/files.hpp>
#include <sstream>

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

/// exp6 as a careful author tests it with RapidCheck: the generator's twists, the closed form at 50 digits, and the
/// two blocks' errors against the budget of the law beyond half a turn for every angle.
std::uint64_t check_exp6(const Subject<double>& subject, std::uint64_t cases) {
  static const bool configured = [cases] {
    return setenv("RC_PARAMS", fmt::format("max_success={} seed=42", cases).c_str(), 1) == 0;
  }();
  std::ostringstream quiet;
  auto* const buffer = configured ? std::cerr.rdbuf(quiet.rdbuf()) : nullptr;
  std::uint64_t run = 0;
  rc::check("exp6", [&] {
    using namespace oracles;
    const Vec<double, 6> xi = *gen::twist<double>(AngleRange::to_pi);
    ++run;
    const auto exact = closed_exp(exact_vector<6, Real>(xi));
    const Pose<double> T = subject.operations.exp6(xi);
    RC_ASSERT(rotation_error<double>(exact_matrix<3, 3, Real>(T.R), exact.Q) <= 4);
    RC_ASSERT(orthogonality_defect<double>(exact_matrix<3, 3, Real>(T.R)) <= 8);
    RC_ASSERT(vector_error<double>(exact_vector<3, Real>(T.p), exact.p) <= 4);
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

  std::vector<Timed> rows;
  const auto chunks = [&](const Series& s) {
    return [&f, run = std::make_shared<Chunks>(Chunks{&s, f.seed, 0, {}})] { return rate(f.seconds, *run); };
  };
  rows.push_back({"exp6 double", chunks(*exp6)});
  rows.push_back({"exp6 double, rc::check, 50 digits",
                  [&] { return rate(f.seconds, [&] { return check_exp6(only_exp6, 1000); }); }});
  for (const auto& s : all) rows.push_back({s->property + " " + s->scalar, chunks(*s)});
  const auto campaign = [&](unsigned jobs) {
    return [&, jobs] {
      CampaignOptions o;
      o.selection = {{"liecheck"}, {}, {"float", "double"}};
      o.seed = f.seed, o.jobs = jobs, o.quiet = true;
      o.cases = static_cast<std::uint64_t>(std::max(1.0, 20000 * f.seconds));
      return rate(0, [&] { return run_campaign(o, robot).total_cases; });
    };
  };
  rows.push_back({"campaign, 1 job", campaign(1)});
  rows.push_back({"campaign, 2 jobs", campaign(2)});

  for (int round = 0; round < 5 && !stop_requested; ++round)
    for (Timed& row : rows) {
      if (stop_requested) break;
      row.best = std::max(row.best, row.round());
    }
  if (stop_requested) {
    std::fputs("interrupted: a rate is the best of five rounds, which were not run\n", stderr);
    return incomplete;
  }

  nlohmann::json table = nlohmann::json::array();
  fmt::print("{:<40}{:>14}\n", "best of five rounds, one core", "cases/s");
  double seconds_a_case = 0;
  for (const Timed& row : rows) {
    fmt::print("{:<40}{:>14.0f}\n", row.name, row.best);
    table.push_back({{"name", row.name}, {"cases_per_second", row.best}});
  }
  for (std::size_t i = 2; i < 2 + all.size(); ++i) seconds_a_case += 1 / rows[i].best;
  const double mean = static_cast<double>(all.size()) / seconds_a_case, over = rows[0].best / rows[1].best,
               jobs = rows.back().best / rows[rows.size() - 2].best;
  fmt::print(
      "\nall laws, as many cases of each: {:.0f} cases/s; exp6 {:.1f} times rc::check; 2 jobs {:.2f} times "
      "1\n",
      mean, over, jobs);
  if (!f.json.empty())
    reports::write_whole(f.json, nlohmann::json({{"seed", f.seed},
                                                 {"rows", table},
                                                 {"all_laws", mean},
                                                 {"exp6_over_rapidcheck", over},
                                                 {"two_jobs_over_one", jobs}})
                                         .dump(1) +
                                     "\n");
  return within_budget;
}

}  // namespace liecheck::properties
