#include <timing/benchmarks.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <timing/instructions.hpp>

namespace liecheck::properties {
namespace {

/// Each repetition's processor time, into the row that its name numbers; `ran` says which of them were run.
class Collector final : public benchmark::BenchmarkReporter {
 public:
  Collector(std::vector<Timed>& all, const std::vector<std::vector<bool>>& ran) : all_(all), ran_(ran) {}
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    std::size_t repetition = 0;
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration) continue;
      const std::size_t i = std::stoul(run.run_name.function_name);
      if (!ran_.at(i).at(repetition++)) continue;
      all_[i].ns.push_back(run.cpu_accumulated_time * 1e9 /
                           (static_cast<double>(run.iterations) * static_cast<double>(all_[i].calls)));
    }
  }

 private:
  std::vector<Timed>& all_;
  const std::vector<std::vector<bool>>& ran_;
};

/// The pass, its frames so many bytes further down the stack: where results lie relative to inputs modulo a page moves
/// small operations by a fifth, and is chance in every process.
[[gnu::noinline]] void run_below(std::size_t bytes, const std::function<void()>& pass) {
  void* const room = __builtin_alloca(bytes + 16);
  asm volatile("" : : "r"(room) : "memory");
  pass();
  asm volatile("" : : "r"(room) : "memory");  // no tail call
}

void initialize_once() {
  static const bool done = [] {
    char name[] = "cost", interleave[] = "--benchmark_enable_random_interleaving=true";
    char* arguments[] = {name, interleave, nullptr};
    int n = 2;
    benchmark::Initialize(&n, arguments);
    return true;
  }();
  static_cast<void>(done);
}

/// As many passes as take that long, after one that warms up.
std::int64_t passes_in(double seconds, const Timed& row) {
  using Clock = std::chrono::steady_clock;
  row.pass();
  const auto start = Clock::now();
  row.pass();
  const double one = std::chrono::duration<double>(Clock::now() - start).count();
  return static_cast<std::int64_t>(std::clamp(seconds / std::max(one, 1e-8), 1.0, 1e7));
}

}  // namespace

std::string run_interleaved(std::vector<Timed>& all, const Interleaving& how) {
  initialize_once();
  InstructionCounter counter;
  const auto start = std::chrono::steady_clock::now();
  const auto stopped = [&] { return how.stop && *how.stop; };
  const auto late = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() >
           1.3 * how.seconds + 1;
  };
  const std::size_t total = all.size() * how.repetitions;
  const double each = how.seconds / static_cast<double>(std::max<std::size_t>(1, total));
  std::size_t done = 0;
  std::vector<std::vector<bool>> ran(all.size());
  benchmark::ClearRegisteredBenchmarks();
  for (std::size_t i = 0; i < all.size() && !stopped(); ++i) {
    const auto passes = passes_in(each, all[i]);
    benchmark::RegisterBenchmark(
        std::to_string(i).c_str(),
        [&, i, passes](benchmark::State& state) {
          const bool run = !stopped() && !late();
          ran[i].push_back(run);
          if (!run) {  // SkipWithError ends the statistics of the library with an abort
            for (auto _ : state) {
            }
            return;
          }
          Timed& row = all[i];
          counter.start();
          // Over the repetitions all of a page, in steps of a cache line and then of half of one.
          const std::size_t shift = 32 * ((ran[i].size() * 37) % 128);
          for (auto _ : state) run_below(shift, row.pass);
          const auto n = counter.stop();
          if (n > 0)
            row.instructions.push_back(static_cast<double>(n) /
                                       (static_cast<double>(passes) * static_cast<double>(row.calls)));
          how.progress(static_cast<double>(++done) / static_cast<double>(total));
        })
        ->Iterations(passes)
        ->Repetitions(static_cast<int>(how.repetitions));
  }
  Collector collector(all, ran);
  if (!stopped()) benchmark::RunSpecifiedBenchmarks(&collector, "all");
  benchmark::ClearRegisteredBenchmarks();
  return counter.absent();
}

}  // namespace liecheck::properties
