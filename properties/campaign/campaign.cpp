#include <campaign/campaign.hpp>

#include <unistd.h>

#include <fmt/format.h>
#include <algorithm>
#include <campaign/coverage_report.hpp>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <thread>

namespace liecheck::properties {

std::atomic<bool> stop_requested{false};

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point t) {
  return std::chrono::duration<double>(Clock::now() - t).count();
}

std::string clock_text(double seconds) {
  const auto s = static_cast<long>(seconds + 0.5);
  return s >= 3600 ? fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60)
                   : fmt::format("{}:{:02}", s / 60, s % 60);
}

/// A bar with rate and time left on a terminal, a plain line every ten seconds elsewhere.
class Progress {
 public:
  Progress(std::uint64_t total, std::optional<double> limit, bool quiet)
      : total_(total), limit_(limit), terminal_(isatty(2) != 0), quiet_(quiet), start_(Clock::now()) {}
  void show(std::uint64_t done, bool last = false) {
    if (quiet_) return;
    const double elapsed = seconds_since(start_);
    const double period = terminal_ ? 0.2 : 10.0;
    if (!last && elapsed - shown_ < period) return;
    shown_ = elapsed;
    const double share = limit_ ? std::min(1.0, elapsed / *limit_)
                                : (total_ ? static_cast<double>(done) / static_cast<double>(total_) : 1.0);
    const double left =
        limit_ ? std::max(0.0, *limit_ - elapsed) : (share > 0 ? elapsed * (1 - share) / share : 0);
    const double rate = elapsed > 0 ? static_cast<double>(done) / elapsed : 0;
    if (terminal_) {
      const int width = 30, full = static_cast<int>(share * width);
      std::fprintf(stderr, "\r[%s%s] %3.0f %%  %llu cases  %.0f/s  left %s   ",
                   std::string(full, '#').c_str(), std::string(width - full, '.').c_str(), share * 100,
                   static_cast<unsigned long long>(done), rate, clock_text(left).c_str());
      if (last) std::fprintf(stderr, "\n");
    } else {
      std::fprintf(stderr, "%3.0f %%  %llu cases  %.0f/s  left %s\n", share * 100,
                   static_cast<unsigned long long>(done), rate, clock_text(left).c_str());
    }
    std::fflush(stderr);
  }

 private:
  std::uint64_t total_;
  std::optional<double> limit_;
  bool terminal_, quiet_;
  Clock::time_point start_;
  double shown_ = 0;
};

}  // namespace

CampaignResult run_campaign(const CampaignOptions& options, const Robot& robot) {
  CampaignResult result;
  result.options = options;
  result.robot = robot;
  for (auto& s : select(options.selection, robot)) result.series.push_back({std::move(s), {}});
  const std::size_t n = result.series.size();
  constexpr std::uint64_t chunk = 32;

  const auto start = Clock::now();
  Progress progress(options.cases * n, options.seconds, options.quiet);
  std::mutex mutex;
  std::size_t next_series = 0;
  std::uint64_t round = 0, done = 0;

  // Chunks go round all series, so that a campaign that is cut short has seen something of each.
  const auto take = [&](std::size_t& series, std::uint64_t& from, std::uint64_t& to) {
    const std::lock_guard lock(mutex);
    if (n == 0 || stop_requested) return false;
    if (next_series == n) next_series = 0, ++round;
    if (options.seconds ? (next_series == 0 && round > 0 && seconds_since(start) >= *options.seconds)
                        : round * chunk >= options.cases)
      return false;
    series = next_series++;
    from = round * chunk;
    to = options.seconds ? from + chunk : std::min(from + chunk, options.cases);
    return true;
  };
  const auto work = [&] {
    std::size_t s = 0;
    std::uint64_t from = 0, to = 0;
    while (take(s, from, to)) {
      Tally tally;
      for (std::uint64_t i = from; i < to; ++i) result.series[s].series->run(options.seed, i, tally);
      const std::lock_guard lock(mutex);
      result.series[s].tally.merge(tally);
      done += to - from;
      progress.show(done);
    }
  };
  std::vector<std::thread> threads;
  for (unsigned t = 1; t < options.jobs; ++t) threads.emplace_back(work);
  work();
  for (auto& t : threads) t.join();
  progress.show(done, true);

  SetDigest inputs, results;
  for (const auto& s : result.series) {
    inputs.merge(s.tally.inputs);
    results.merge(s.tally.results);
    result.total_cases += s.tally.cases;
    result.failed = result.failed || !s.tally.disagreed.empty();
    for (const auto& [key, row] : s.tally.rows) result.failed = result.failed || row.failed > 0;
    for (const Covered& c : coverage_of(*s.series, s.tally)) result.covered = result.covered && !c.missing();
    if (!options.seconds && s.tally.cases < options.cases) result.incomplete = true;
    if (options.seconds && stop_requested) result.incomplete = true;
  }
  result.failed = result.failed || !result.covered;
  const std::string header = fmt::format("liecheck g{} seed {}", generator_version, options.seed);
  result.inputs_digest = inputs.finish(header);
  result.results_digest = results.finish(header);
  result.elapsed = seconds_since(start);
  return result;
}

std::string describe_failure(const Series& series, std::uint64_t seed, int output, int band, const Row& row,
                             const Robot& robot) {
  const Output& o = series.outputs.at(static_cast<std::size_t>(output));
  const Band& b = series.bands()[static_cast<std::size_t>(band)];
  const Budget& budget = budget_of(o.operation, o.block, b.region);
  const CaseId id = series.id(seed, row.worst_index);
  const Shrunk s = series.shrink(id, output, 2000);
  const std::string with_robot =
      series.robot != "none" && !robot.path.empty() ? " --robot " + robot.path : "";
  std::string text;
  text += fmt::format("FAILED  {}: {}\n", series.property, series.law);
  text += fmt::format("  law       {}\n", series.equation);
  text += fmt::format("  subject   {} {} in {}\n", series.subject, series.subject_version, series.scalar);
  text += fmt::format("  where     {}, block {}, band {}\n", o.operation, o.block, b.name);
  text += fmt::format("  error     {:.4g} eps, budget {} {} ({}); {} of {} cases in the band fail\n",
                      row.worst_score, budget.limit, budget.rule == Rule::forward ? "eps" : "eps kappa",
                      budget.reason, row.failed, row.count);
  if (row.not_finite + row.wrong_branch + row.refused > 0)
    text += fmt::format("  outcomes  {} NaN or Inf, {} wrong branch, {} refused\n", row.not_finite,
                        row.wrong_branch, row.refused);
  text += fmt::format("  worst     liecheck replay {}{}\n", id.text(), with_robot);
  text += fmt::format("  shrunk    error {:.4g} eps, kappa {:.3g}\n", s.judged.residual.error,
                      s.judged.residual.kappa);
  text += fmt::format("    decimal     {}\n", fmt::join(s.decimal, ", "));
  text += fmt::format("    hexadecimal {}\n", fmt::join(s.id.input, ", "));
  text += fmt::format("  replay    liecheck replay {}{}\n", s.id.text(), with_robot);
  return text;
}

}  // namespace liecheck::properties
