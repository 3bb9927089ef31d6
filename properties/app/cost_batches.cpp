#include <fmt/format.h>
#include <algorithm>
#include <app/cost_batches.hpp>
#include <cstdio>
#include <stdexcept>
#include <support/say.hpp>
#include <support/stop.hpp>
#include <timing/batch_bench.hpp>

namespace liecheck::properties {

int run_batches(const BatchFlags& f, const std::vector<std::string>& operations) {
  BatchBenchOptions options;
  options.columns = f.columns.empty() ? std::vector<long>{64, 1000, 10000, 100000, 1000000} : f.columns;
  for (const std::string& name : options.operations = operations)
    if (const auto all = batch_operations(); std::ranges::count(all, name) == 0)
      throw std::invalid_argument(
          fmt::format("--op: unknown operation '{}'; there are: {}", name, fmt::join(all, ", ")));
  options.threads = int(f.threads), options.seconds = f.seconds;
  stop_on_signals();
  say("ns per column, median of {} rounds, +- half the distance of the quartiles; {} thread{}\n",
      options.rounds, f.threads, f.threads == 1 ? "" : "s");
  say("copy: as many bytes read and written as by the operation; /loop: times faster than the loop; "
      "/copy: time over that of the copy\n\n");
  say("{:<18}{:<7}{:>8}{:>14}{:>14}", "operation", "scalar", "columns", "loop", "copy");
  for (const auto& [name, instructions] : supportedInstructions()) {
    options.instructions.push_back(instructions);
    say("{:>16}{:>7}{:>7}", name, "/loop", "/copy");
  }
  say("\n");
  time_batches(options, [](const BatchRow& row) {
    const auto time = [](const BatchTime& t) {
      return fmt::format("{:.2f} +-{:.0f}%", t.median, 100 * t.spread);
    };
    say("{:<18}{:<7}{:>8}{:>14}{:>14}", row.operation, row.scalar, row.columns, time(row.loop),
        time(row.copy));
    for (const BatchTime& t : row.batch)
      say("{:>16}{:>7.1f}{:>7.2f}", time(t), row.loop.median / t.median, t.median / row.copy.median);
    say("\n");
    std::fflush(stdout);
  });
  return stop_requested ? incomplete : within_budget;
}

std::vector<Flag> BatchFlags::add(Arguments& a) {
  return {a.numbers("--columns", columns, 1, 10'000'000,
                    "columns of a batch, repeatable; default 64, 1000, 10000, 100000, 1000000"),
          a.number("--threads", threads, 1, 1024, "threads of a batch; the loop and the copy have one"),
          a.duration("--for-each", seconds,
                     "how long each of the nine measurements of a time of a batch takes; default 0.003s")};
}

}  // namespace liecheck::properties
