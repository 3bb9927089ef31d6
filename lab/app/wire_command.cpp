#include <fmt/format.h>
#include <adapters/subjects.hpp>
#include <algorithm>
#include <atomic>
#include <campaign/robots.hpp>
#include <campaign/selection.hpp>
#include <campaign/series.hpp>
#include <chrono>
#include <results/bench.hpp>
#include <subjects/subject.hpp>
#include <support/progress.hpp>
#include <support/say.hpp>
#include <support/stop.hpp>
#include <support/threads.hpp>
#include "lab_commands.hpp"

namespace liecheck::properties {

namespace {

using Clock = std::chrono::steady_clock;

struct WireFlags {
  std::vector<std::string> adapters;
  std::uint64_t seed = 42, rounds = 7;
  unsigned jobs = 1;
  double seconds = 0.5;  ///< duration of one round of a row
  std::string json;
};

/// exp6 of one subject alone, in double, by the law exp_oracle.
struct Row {
  std::string name;
  std::unique_ptr<Series> series;
  std::vector<double> rates = {};  ///< of each round [cases/s]
  std::uint64_t failed = 0;
};

Row row_of(const std::string& name, const std::string& subject) {
  const auto all = subjects(oracles::scalar_of<double>);
  const auto own = std::ranges::find(all, subject, &Subject::name);
  if (own == all.end() || !(*own)->operations[op::exp6])
    throw std::invalid_argument(fmt::format("'{}' offers no exp6 in double", name));
  Subject* const only_exp6 = new Subject{**own};  // to the end
  only_exp6->operations = {};
  only_exp6->operations[op::exp6] = (*own)->operations[op::exp6];
  return {name, series_of("exp_oracle", *only_exp6, built_in_robot())};
}

/// Together of `jobs` threads, each with an adapter of its own, which it starts before its time begins.
double rate(const WireFlags& f, Row& row, std::uint64_t round) {
  constexpr std::uint64_t chunk = 1024, far = 1ULL << 32;
  std::atomic<std::uint64_t> next_thread{0}, failed{0};
  std::atomic<double> sum{0};
  run_on_threads(f.jobs, stop_requested, [&] {
    std::uint64_t next = (round * f.jobs + next_thread++) * far;
    Tally tally;
    const auto& series = *row.series;
    next = series.run(f.seed, {next, next + 2}, tally, stop_requested);
    const auto begin = Clock::now();
    const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
    const std::uint64_t first = next;
    while (!stop_requested && elapsed() < f.seconds)
      next = series.run(f.seed, {next, next + chunk}, tally, stop_requested);
    sum += static_cast<double>(next - first) / elapsed();
    for (const auto& [cell, of] : tally.rows) failed += of.failed;
  });
  row.failed += failed;
  return sum;
}

WireBench measured(const WireFlags& f) {
  std::vector<Row> rows;
  rows.push_back(row_of("in the program", "liecheck"));
  for (std::size_t i = 0; i < f.adapters.size(); ++i)
    rows.push_back(
        row_of(f.adapters[i], adapters::register_adapter(f.adapters[i], fmt::format("wire{}", i + 1))));
  stop_on_signals();
  Progress progress("wire");
  WireBench b;
  b.seed = f.seed, b.jobs = f.jobs;
  for (std::uint64_t round = 0; round < f.rounds && !stop_requested; ++round)
    for (Row& row : rows) {
      progress.show(static_cast<double>(round) / static_cast<double>(f.rounds),
                    fmt::format("round {}: {}", round + 1, row.name));
      const double found = rate(f, row, round);
      if (stop_requested) break;
      row.rates.push_back(found);
    }
  b.complete = !stop_requested;
  for (const Row& row : rows) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < row.rates.size(); ++i) ratios.push_back(row.rates[i] / rows[0].rates[i]);
    if (ratios.empty()) continue;
    std::ranges::sort(ratios);
    b.rows.push_back(
        {row.name, std::ranges::max(row.rates), ratios[ratios.size() / 2], ratios.front(), ratios.back()});
    b.failed += row.failed;
  }
  return b;
}

int run(const WireFlags& f) {
  const WireBench b = measured(f);
  do_both([&] { write_record_of(f.json, b); },
          [&] {
            say("exp6 in double, {} {}\n{:>10}  {:>7}  {:<11}  {}\n", f.jobs, f.jobs == 1 ? "job" : "jobs",
                "cases/s", "ratio", "all rounds", "called");
            for (const WireBench::Row& r : b.rows)
              say("{:>10.0f}  {:>7.2f}  {:.2f} - {:.2f}  {}\n", r.rate, r.ratio, r.least, r.most, r.name);
            if (b.failed) say("{} results failed: their rates mean nothing\n", b.failed);
            if (!b.complete) say("stopped: of the rounds that were done\n");
          });
  return !b.complete ? incomplete : b.failed ? property_failed : within_budget;
}

}  // namespace

Command wire_command(CLI::App& lab) {
  CommandWith<WireFlags> a(
      lab, "wire",
      "measure what a call through an adapter costs. Prints cases per second of exp6 in the program and of "
      "each adapter that offers it, in turns, and the ratio of both: the best and the median of the rounds. "
      "Exit code 0; 1 if a result "
      "failed; 2 for bad input; 3 if stopped");
  a.list("--adapter", a->adapters, "ADAPTER", "a command, or a shared library (docs/start.md), repeatable")
      .required();
  a.number("--rounds", a->rounds, 1, 1000, "how often all rows are measured");
  a.duration("--for-each", a->seconds, "how long each round of a row takes; default 0.5s");
  a.seed(a->seed, "seed of the cases");
  a.number("--jobs,-j", a->jobs, 1, 1024, "threads, each with its own adapter");
  a.json(a->json, "write the table to FILE");
  return a.runs(run);
}

}  // namespace liecheck::properties
