#include <app/bench_command.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <app/store_commands.hpp>
#include <campaign/campaign.hpp>
#include <chrono>
#include <hard_cases/hard_cases.hpp>
#include <nlohmann/json.hpp>
#include <search/weak_tests.hpp>
#include <subjects/known_bugs.hpp>
#include <support/files.hpp>
#include <support/stop.hpp>

namespace liecheck::properties {
namespace {

struct Kill {
  bool killed = false;
  std::string by;  ///< law, operation, block
  std::uint64_t cases = 0;
  double seconds = 0;
};

/// The hard cases first, as in every campaign; then rounds of cases over all laws, until one fails.
Kill hunt_down(const std::string& subject, const BenchFlags& f, double seconds, const Robot& robot) {
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  Kill kill;
  const auto finish = [&](std::string by) {
    kill.killed = true, kill.by = std::move(by), kill.seconds = elapsed();
    return kill;
  };
  const auto all = select({{subject}, {}, {f.scalar}}, robot);
  constexpr std::uint64_t round = 64;
  for (std::uint64_t from = 0; elapsed() < seconds && !stop_requested; from += round) {
    for (const auto& s : all) {
      Tally tally;
      for (std::uint64_t i = from; i < from + round; ++i) s->run(f.seed, i, tally);
      kill.cases += round;
      for (const auto& [cell, row] : tally.rows)
        if (row.failed > 0) {
          const Output& o = s->outputs.at(static_cast<std::size_t>(cell.first));
          return finish(fmt::format("{}: {}, {}", s->property, o.operation, o.block));
        }
    }
    if (from == 0) {
      const auto rows = run_hard_cases({{subject}, {}, {f.scalar}}, robot);
      kill.cases += rows.size();
      for (const HardRow& row : rows)
        for (const HardCell& cell : row.cells)
          if (cell.failed)
            return finish(fmt::format("hard case {}: {}, {}", row.entry->name, cell.operation, cell.block));
    }
  }
  kill.seconds = elapsed();
  return kill;
}

}  // namespace

int run_bench(const BenchFlags& f, const Robot& robot) {
  const auto tested = subjects<double>();
  nlohmann::json rows = nlohmann::json::array();
  std::size_t bugs = 0, killed = 0, alikes = 0, false_alarms = 0;
  double slowest = 0;
  std::vector<std::size_t> weak_kills(weak_styles().size(), 0);
  fmt::print("{:<34} {:<10}{:>9}{:>9}  {:<52}", "known bug", "", "cases", "s", "killed by");
  for (const WeakStyle& w : weak_styles()) fmt::print("{:>14}", w.name);
  fmt::print("\n");
  for (const KnownBug& bug : known_bug_table()) {
    if (stop_requested) break;
    const bool alike = bug.name.rfind("alike:", 0) == 0;
    const Kill kill = hunt_down(bug.name, f, alike ? f.seconds / 10 : f.seconds, robot);
    if (stop_requested && !kill.killed) break;  // it was not given its time
    const auto subject =
        std::find_if(tested.begin(), tested.end(), [&](const auto* s) { return s->name == bug.name; });
    nlohmann::json weak = nlohmann::json::object();
    std::string marks;
    for (std::size_t i = 0; i < weak_styles().size(); ++i) {
      const bool seen = weak_styles()[i].kills((*subject)->operations);
      if (!alike) weak_kills[i] += seen;
      weak[weak_styles()[i].name] = seen;
      marks += fmt::format("{:>14}", seen ? "killed" : "-");
    }
    (alike ? alikes : bugs) += 1;
    (alike ? false_alarms : killed) += kill.killed;
    if (!alike) slowest = std::max(slowest, kill.seconds);
    fmt::print("{:<34} {:<10}{:>9}{:>9.3f}  {:<52}{}\n", bug.name,
               alike ? (kill.killed ? "REFUSED" : "passes") : (kill.killed ? "killed" : "SURVIVES"),
               kill.cases, kill.seconds, kill.by.empty() ? "-" : kill.by, marks);
    std::fflush(stdout);
    rows.push_back({{"name", bug.name},
                    {"fault", bug.fault},
                    {"origin", bug.origin},
                    {"killed", kill.killed},
                    {"by", kill.by},
                    {"cases", kill.cases},
                    {"seconds", kill.seconds},
                    {"weaker_styles", weak}});
  }
  if (stop_requested)
    fmt::print("\ninterrupted after {} of {} subjects", bugs + alikes, known_bug_table().size());
  fmt::print(
      "\nkilled {} of {} bugs, the slowest in {:.2f} s of {} s each; {} of {} look-alikes refused; seed {}, "
      "{}\n",
      killed, bugs, slowest, f.seconds, false_alarms, alikes, f.seed, f.scalar);
  for (std::size_t i = 0; i < weak_styles().size(); ++i)
    fmt::print("{:<14} kills {:>3} of {}\n", weak_styles()[i].name, weak_kills[i], bugs);
  if (!f.json.empty())
    write_whole(f.json, nlohmann::json({{"version", LIECHECK_VERSION},
                                        {"seed", f.seed},
                                        {"scalar", f.scalar},
                                        {"seconds_each", f.seconds},
                                        {"verdict", stop_requested                        ? "incomplete"
                                                    : killed == bugs && false_alarms == 0 ? "pass"
                                                                                          : "fail"},
                                        {"bugs", rows}})
                                .dump(1) +
                            "\n");
  if (stop_requested) return incomplete;
  return killed == bugs && false_alarms == 0 ? within_budget : property_failed;
}

}  // namespace liecheck::properties
