#include <timing/benchmarks.hpp>

#include <linux/perf_event.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>
#include <limits>
#include <random>

namespace liecheck::properties {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Counts instructions or cycles of this thread in user space, if Linux offers a hardware counter.
class Counter {
 public:
  explicit Counter(std::uint64_t what) {
    perf_event_attr a{};
    a.size = sizeof a;
    a.type = PERF_TYPE_HARDWARE;
    a.config = what;
    a.disabled = a.exclude_kernel = a.exclude_hv = 1;
    a.read_format = PERF_FORMAT_TOTAL_TIME_ENABLED | PERF_FORMAT_TOTAL_TIME_RUNNING;
    file_ = static_cast<int>(::syscall(SYS_perf_event_open, &a, 0, -1, -1, 0));
    if (file_ < 0) absent_ = std::string("perf_event_open: ") + std::strerror(errno);
  }
  ~Counter() {
    if (file_ >= 0) ::close(file_);
  }
  Counter(const Counter&) = delete;
  Counter& operator=(const Counter&) = delete;
  /// Why there is no counter ("perf_event_open: ..."); empty if there is one.
  const std::string& absent() const { return absent_; }
  void start() {
    if (file_ < 0) return;
    ::ioctl(file_, PERF_EVENT_IOC_RESET, 0);
    ::ioctl(file_, PERF_EVENT_IOC_ENABLE, 0);
  }
  /// The count since start(); 0 if there is no counter, or if it did not run all the time.
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

/// The processor time of this thread [s].
double processor_time() {
  timespec t{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// The time of a pass of a loop that is limited by the execution units [ns]: the fastest of three runs of 100
/// passes, so that an interrupt does not count. It doubles while another program uses the execution units.
double reference_ns() {
  alignas(64) static double in[64] = {1, 2, 3}, out[64];
  double fastest = std::numeric_limits<double>::infinity();
  for (int run = 0; run < 3; ++run) {
    const auto start = Clock::now();
    for (int i = 0; i < 100; ++i) {
      for (int j = 0; j < 64; ++j) out[j] = in[j] * in[63 - j] + in[j ^ 1];
      asm volatile("" : : "r"(out) : "memory");
    }
    fastest = std::min(fastest, seconds_since(start));
  }
  return fastest * 1e9 / 100;
}

/// Runs passes with their stack frames moved down by `bytes`. The distance from inputs to results, modulo the
/// page size, is random in each process and changes the time of small operations by a fifth.
[[gnu::noinline]] void run_below(std::size_t bytes, const std::function<void()>& pass, std::size_t passes) {
  void* const room = __builtin_alloca(bytes + 16);
  asm volatile("" : : "r"(room) : "memory");
  for (std::size_t i = 0; i < passes; ++i) pass();
  asm volatile("" : : "r"(room) : "memory");  // no tail call
}

/// The number of passes that take `seconds`, from a pass with cold caches. Elsewhere, the first pass also pays for the way.
std::size_t passes_in(double seconds, const Timed& row) {
  const auto start = Clock::now();
  row.elsewhere ? void(row.elsewhere(1)) : row.pass();
  const double pass = row.elsewhere ? row.elsewhere(8) / 8e9 : seconds_since(start);
  return static_cast<std::size_t>(std::clamp(seconds / std::max(pass, 1e-8), 1.0, 1e7));
}

}  // namespace

std::vector<std::vector<Repetition>> run_interleaved(const std::vector<Timed>& all, const Interleaving& how) {
  Counter instructions(PERF_COUNT_HW_INSTRUCTIONS), cycles(PERF_COUNT_HW_CPU_CYCLES);
  std::mt19937_64 random{std::random_device()()};
  const auto stopped = [&] { return how.stop && *how.stop; };
  const std::size_t total = all.size() * how.repetitions;
  // Beside each repetition, the reference takes a part of its time.
  const double each =
      std::max(how.seconds / static_cast<double>(std::max<std::size_t>(1, total)) - 20e-6, 20e-6);
  std::vector<std::size_t> passes(all.size()), order;
  for (std::size_t i = 0; i < all.size() && !stopped(); ++i) {
    if (!all[i].pass && !all[i].elsewhere) continue;
    passes[i] = passes_in(each, all[i]);
    order.insert(order.end(), how.repetitions, i);
  }
  std::shuffle(order.begin(), order.end(), random);
  std::vector<std::vector<Repetition>> repetitions(all.size());
  const auto start = Clock::now();
  const auto over = [&] { return stopped() || seconds_since(start) > 1.3 * how.seconds + 1; };
  for (std::size_t done = 0; done < order.size() && !over(); ++done) {
    const std::size_t i = order[done];
    const double calls = static_cast<double>(passes[i] * all[i].calls);
    const std::size_t shift = 32 * (random() % 128);  // within a page
    const double reference = reference_ns(), before = processor_time();
    Repetition r;
    if (all[i].elsewhere) {
      r.ns = all[i].elsewhere(passes[i]) / calls;
    } else {
      instructions.start(), cycles.start();
      run_below(shift, all[i].pass, passes[i]);
      r.cycles = static_cast<double>(cycles.stop()) / calls;
      r.instructions = static_cast<double>(instructions.stop()) / calls;
      r.ns = (processor_time() - before) * 1e9 / calls;
    }
    const double after = reference_ns();
    r.reference_ns = (reference + after) / 2, r.slowest_ns = std::max(reference, after);
    repetitions[i].push_back(r);
    how.progress(static_cast<double>(done + 1) / static_cast<double>(total));
  }
  return repetitions;
}

std::string no_counter() {
  return Counter(PERF_COUNT_HW_INSTRUCTIONS).absent();
}

}  // namespace liecheck::properties
