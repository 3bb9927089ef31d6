#include <fmt/format.h>
#include <algorithm>
#include <app/command.hpp>
#include <cstdio>
#include <stdexcept>
#include <support/stop.hpp>
#include <timing/batch_bench.hpp>

namespace liecheck::properties {

namespace {

struct Flags {
  std::vector<long> columns;
  std::vector<std::string> operations;
  unsigned threads = 1;
  double seconds = 0.003;
};

int run(const Flags& f) {
  BatchBenchOptions options;
  options.columns = f.columns.empty() ? std::vector<long>{64, 1000, 10000, 100000, 1000000} : f.columns;
  for (const std::string& name : options.operations = f.operations)
    if (const auto all = batch_operations(); std::ranges::count(all, name) == 0)
      throw std::invalid_argument(
          fmt::format("--operation: unknown operation '{}'; there are: {}", name, fmt::join(all, ", ")));
  options.threads = int(f.threads), options.seconds = f.seconds;
  stop_on_signals();
  fmt::print("ns per column, median of {} rounds, +- half the distance of the quartiles; {} thread{}\n",
             options.rounds, f.threads, f.threads == 1 ? "" : "s");
  fmt::print(
      "copy: as many bytes read and written as by the operation; /loop: times faster than the loop; "
      "/copy: time over that of the copy\n\n");
  fmt::print("{:<18}{:<7}{:>8}{:>14}{:>14}", "operation", "scalar", "columns", "loop", "copy");
  for (const auto& [name, instructions] : supportedInstructions()) {
    options.instructions.push_back(instructions);
    fmt::print("{:>16}{:>7}{:>7}", name, "/loop", "/copy");
  }
  fmt::print("\n");
  time_batches(options, [](const BatchRow& row) {
    const auto time = [](const BatchTime& t) {
      return fmt::format("{:.2f} +-{:.0f}%", t.median, 100 * t.spread);
    };
    fmt::print("{:<18}{:<7}{:>8}{:>14}{:>14}", row.operation, row.scalar, row.columns, time(row.loop),
               time(row.copy));
    for (const BatchTime& t : row.batch)
      fmt::print("{:>16}{:>7.1f}{:>7.2f}", time(t), row.loop.median / t.median, t.median / row.copy.median);
    fmt::print("\n");
    std::fflush(stdout);
  });
  return stop_requested ? incomplete : within_budget;
}

}  // namespace

Command bench_batches_command(CLI::App& bench) {
  CommandWith<Flags> a(bench, "batches",
                       "time batches of poses, and of states of the built-in quadruped, beside the loop "
                       "over single ones and a copy of memory, "
                       "in each set of instructions of the processor, in float and double. Exit "
                       "code 0; 2 for bad input; 3 if stopped");
  a.numbers("--columns", a->columns, 1, 10'000'000,
            "poses in a batch, repeatable; default 64, 1000, 10000, 100000, 1000000");
  a.list("--operation", a->operations, "OP",
         "one of " + fmt::format("{}", fmt::join(batch_operations(), ", ")) + ", repeatable; default all");
  a.number("--threads", a->threads, 1, 1024, "threads of a batch; the loop and the copy have one");
  a.duration("--for-each", a->seconds,
             "how long each of the nine measurements of a time takes; default 0.003s");
  return a.runs(run);
}

}  // namespace liecheck::properties
