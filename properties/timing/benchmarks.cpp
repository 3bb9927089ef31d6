#include <timing/benchmarks.hpp>

#include <benchmark/benchmark.h>
#include <linux/perf_event.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>
#include <mutex>

namespace liecheck::properties {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Counts the instructions that this thread retires in user space, if Linux offers a hardware counter.
class InstructionCounter {
 public:
  InstructionCounter() {
    perf_event_attr a{};
    a.size = sizeof a;
    a.type = PERF_TYPE_HARDWARE;
    a.config = PERF_COUNT_HW_INSTRUCTIONS;
    a.disabled = a.exclude_kernel = a.exclude_hv = 1;
    a.read_format = PERF_FORMAT_TOTAL_TIME_ENABLED | PERF_FORMAT_TOTAL_TIME_RUNNING;
    file_ = static_cast<int>(::syscall(SYS_perf_event_open, &a, 0, -1, -1, 0));
    if (file_ < 0) absent_ = std::string("perf_event_open: ") + std::strerror(errno);
  }
  ~InstructionCounter() {
    if (file_ >= 0) ::close(file_);
  }
  InstructionCounter(const InstructionCounter&) = delete;
  InstructionCounter& operator=(const InstructionCounter&) = delete;
  /// Why there is no counter ("perf_event_open: ..."); empty if there is one.
  const std::string& absent() const { return absent_; }
  void start() {
    if (file_ < 0) return;
    ::ioctl(file_, PERF_EVENT_IOC_RESET, 0);
    ::ioctl(file_, PERF_EVENT_IOC_ENABLE, 0);
  }
  /// The instructions since start(); 0 if there is no counter, or if it did not run all the time.
  std::uint64_t stop() {
    if (file_ < 0) return 0;
    ::ioctl(file_, PERF_EVENT_IOC_DISABLE, 0);
    struct {
      std::uint64_t count, enabled, running;
    } read{};
    if (::read(file_, &read, sizeof read) != sizeof read || read.running < read.enabled) return 0;
    return read.count;
  }

 private:
  int file_ = -1;
  std::string absent_;
};

/// One repetition, and how long the reference loop took before or after it.
struct Repetition {
  bool run = false;
  double reference = 0;  ///< the longer time of the two [s]
  double ns = 0, instructions = 0;
};
using Repetitions = std::vector<std::vector<Repetition>>;  ///< by row

/// The processor time of this thread [s].
double processor_time() {
  timespec t{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Thrown by a repetition to end a run that was asked to stop. Tens of thousands of repetitions may be left,
/// which take half a minute even if they are empty.
struct StopRun {};

/// Stores the processor time of each repetition. The name of a benchmark is the index of its row.
class Collector final : public benchmark::BenchmarkReporter {
 public:
  Collector(const std::vector<Timed>& all, Repetitions& into) : all_(all), into_(into) {}
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    std::size_t repetition = 0;
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration) continue;
      const std::size_t i = std::stoul(run.run_name.function_name);
      into_.at(i).at(repetition++).ns =
          run.cpu_accumulated_time * 1e9 /
          (static_cast<double>(run.iterations) * static_cast<double>(all_[i].calls));
    }
  }

 private:
  const std::vector<Timed>& all_;
  Repetitions& into_;
};

/// The time of a loop that is limited by the execution units [s]. The time doubles while another program uses
/// them.
double reference_time() {
  static double in[64] = {1, 2, 3}, out[64];
  const auto start = Clock::now();
  for (int i = 0; i < 200; ++i) {
    for (int j = 0; j < 64; ++j) out[j] = in[j] * in[63 - j] + in[j ^ 1];
    asm volatile("" : : "r"(out) : "memory");
  }
  return seconds_since(start);
}

/// Keeps the repetitions whose reference time is at most 1.1 times the 1 % quantile of all reference times.
/// Keeps at least eight of each row, if there are so many. The choice does not depend on the measured times.
void keep_undisturbed(std::vector<Timed>& all, const Repetitions& repetitions) {
  std::vector<double> references;
  for (const auto& row : repetitions)
    for (const Repetition& r : row)
      if (r.run) references.push_back(r.reference);
  if (references.empty()) return;
  const auto fast = references.begin() + static_cast<std::ptrdiff_t>(references.size() / 100);
  std::nth_element(references.begin(), fast, references.end());
  const double limit = *fast * 1.1;
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::vector<Repetition> run;
    for (const Repetition& r : repetitions[i])
      if (r.run) run.push_back(r);
    std::sort(run.begin(), run.end(),
              [](const Repetition& a, const Repetition& b) { return a.reference < b.reference; });
    for (std::size_t k = 0; k < run.size() && (k < 8 || run[k].reference <= limit); ++k) {
      all[i].ns.push_back(run[k].ns);
      if (run[k].instructions > 0) all[i].instructions.push_back(run[k].instructions);
    }
  }
}

/// Runs the pass with its stack frame moved down by `bytes`. The distance from inputs to results, modulo the
/// page size, is random in each process and changes the time of small operations by a fifth.
[[gnu::noinline]] void run_below(std::size_t bytes, const std::function<void()>& pass) {
  void* const room = __builtin_alloca(bytes + 16);
  asm volatile("" : : "r"(room) : "memory");
  pass();
  asm volatile("" : : "r"(room) : "memory");  // no tail call
}

void initialize() {
  char name[] = "cost", interleave[] = "--benchmark_enable_random_interleaving=true";
  char* arguments[] = {name, interleave, nullptr};
  int n = 2;
  benchmark::Initialize(&n, arguments);
}

/// The number of passes that take `seconds`. A first pass fills the caches.
std::int64_t passes_in(double seconds, const Timed& row) {
  row.pass();
  const auto start = Clock::now();
  row.pass();
  return static_cast<std::int64_t>(std::clamp(seconds / std::max(seconds_since(start), 1e-8), 1.0, 1e7));
}

}  // namespace

std::string run_interleaved(std::vector<Timed>& all, const Interleaving& how) {
  static std::once_flag initialized;
  std::call_once(initialized, initialize);
  InstructionCounter counter;
  const auto start = Clock::now();
  const auto stopped = [&] { return how.stop && *how.stop; };
  const std::size_t total = all.size() * how.repetitions;
  const double each = how.seconds / static_cast<double>(std::max<std::size_t>(1, total));
  std::size_t done = 0;
  Repetitions repetitions(all.size());
  benchmark::ClearRegisteredBenchmarks();
  for (std::size_t i = 0; i < all.size() && !stopped(); ++i) {
    const auto passes = passes_in(each, all[i]);
    benchmark::RegisterBenchmark(std::to_string(i).c_str(),
                                 [&, i, passes](benchmark::State& state) {
                                   const Timed& row = all[i];
                                   if (stopped()) throw StopRun();
                                   // 128 repetitions shift the stack over one page, 32 bytes each.
                                   const std::size_t shift = 32 * ((repetitions[i].size() * 37) % 128);
                                   Repetition& r = repetitions[i].emplace_back();
                                   r.run = seconds_since(start) <= 1.3 * how.seconds + 1;
                                   if (!r.run) {  // after SkipWithError, the library's statistics would abort
                                     for (auto _ : state) {
                                     }
                                     return;
                                   }
                                   r.reference = reference_time();
                                   const double calls =
                                       static_cast<double>(passes) * static_cast<double>(row.calls);
                                   const double before = processor_time();
                                   counter.start();
                                   for (auto _ : state) run_below(shift, row.pass);
                                   r.instructions = static_cast<double>(counter.stop()) / calls;
                                   r.ns = (processor_time() - before) * 1e9 / calls;  // until the report
                                   r.reference = std::max(r.reference, reference_time());
                                   how.progress(static_cast<double>(++done) / static_cast<double>(total));
                                 })
        ->Iterations(passes)
        ->Repetitions(static_cast<int>(how.repetitions));
  }
  Collector collector(all, repetitions);
  try {
    if (!stopped()) benchmark::RunSpecifiedBenchmarks(&collector, "all");
  } catch (const StopRun&) {  // Google Benchmark has reported nothing: the times are our own
  }
  benchmark::ClearRegisteredBenchmarks();
  keep_undisturbed(all, repetitions);
  return counter.absent();
}

}  // namespace liecheck::properties
