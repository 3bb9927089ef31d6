#include <campaign/campaign.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <campaign/cliffs.hpp>
#include <campaign/coverage_report.hpp>
#include <campaign/long_sums.hpp>
#include <campaign/series.hpp>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <support/progress.hpp>
#include <support/stop.hpp>
#include <support/text.hpp>
#include <support/threads.hpp>
#include <thread>

namespace liecheck::properties {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point t) {
  return std::chrono::duration<double>(Clock::now() - t).count();
}

}  // namespace

Range CampaignOptions::range() const {
  if (range_override) return *range_override;
  if (seconds) return {0, std::numeric_limits<std::int64_t>::max()};
  const auto at = [this](unsigned k) {
    return static_cast<std::uint64_t>(static_cast<unsigned __int128>(cases) * k / shards);
  };
  return {at(shard - 1), at(shard)};
}

void CampaignResult::summarize() {
  SetDigest inputs, results;
  const auto [first, last] = options.range();
  total_cases = 0;
  for (const auto& s : series) {
    inputs.merge(s.tally.inputs);
    results.merge(s.tally.results);
    total_cases += s.tally.cases;
    failed = failed || !s.tally.disagreed.empty() || unexpected(cliffs_of(*s.series, s.tally));
    for (const auto& [cell, row] : s.tally.rows)
      failed = failed || (row.failed > 0 && !s.series->expected(static_cast<std::size_t>(cell.first),
                                                                static_cast<std::size_t>(cell.second)));
    measured = measured && not_measured(*s.series, s.tally).empty();
    if (options.seconds ? stop_requested.load() : !s.tally.done.covers(first, last)) incomplete = true;
  }
  measured = measured && !series.empty();
  const std::string header = fmt::format("liecheck g{} seed {}", generator_version, options.seed);
  inputs_digest = inputs.finish(header);
  results_digest = results.finish(header);
}

namespace {

/// Runs a campaign on threads. Each one takes a chunk, runs it, merges its tally and may save a checkpoint.
class Engine {
 public:
  Engine(CampaignResult& result, Checkpoint* checkpoint)
      : result_(result),
        o_(result.options),
        checkpoint_(checkpoint),
        start_(Clock::now()),
        saved_(start_),
        missing_(missing()),
        progress_("", o_.quiet),
        first_chunk_(result.robot.path.empty() ? 32 : 1),
        round_size_(first_chunk_) {
    const auto [first, last] = o_.range();
    for (const auto& s : result_.series) queues_.push_back({s.tally.done.gaps(first, last), first_chunk_});
  }

  void run() {
    {
      // A chunk of an adapter that hangs takes minutes.
      const std::jthread shows([this](const std::stop_token& end) {
        std::unique_lock lock(mutex_);
        while (
            !ended_.wait_for(lock, end, std::chrono::milliseconds(500), [&] { return end.stop_requested(); }))
          show(false);
      });
      run_on_threads(o_.jobs, stop_requested, [this] { work(); });
    }
    if (error_) std::rethrow_exception(error_);
    save();
    show(true);
    result_.elapsed = seconds_since(start_);
  }

 private:
  static constexpr double chunk_seconds = 0.4;
  struct Queue {
    std::vector<Range> todo;
    std::uint64_t size;  ///< of the next chunk
  };

  std::uint64_t missing() const {
    const auto [first, last] = o_.range();
    std::uint64_t n = 0;
    if (!o_.seconds)
      for (const auto& s : result_.series) n += last - first - s.tally.done.count();
    return n;
  }

  /// Takes a chunk of each series in turn, so that a campaign that stops early has cases of every series.
  bool take(std::size_t& s, std::uint64_t& from, std::uint64_t& to) {
    const std::lock_guard lock(mutex_);
    for (std::size_t tried = 0; tried < queues_.size(); ++tried, ++next_) {
      if (stop_requested || error_) return false;
      if (next_ == queues_.size()) {
        next_ = 0;
        if (o_.seconds && !begin_round()) return false;
      }
      Queue& q = queues_[next_];
      if (q.todo.empty()) continue;
      s = next_++;
      auto& [first, last] = q.todo.front();
      const std::uint64_t share = std::max(first_chunk_, (last - first) / (2 * o_.jobs));
      from = first, to = first + std::min({o_.seconds ? round_size_ : q.size, share, last - first});
      first = to;
      if (first == last) q.todo.erase(q.todo.begin());
      return true;
    }
    return false;
  }

  /// With a time limit, each series gets the same number of cases. The rounds grow to about 5 % of the limit.
  bool begin_round() {
    const double now = seconds_since(start_), limit = *o_.seconds;
    if (now >= limit) return false;
    if (now - round_start_ < limit * 0.025 &&
        std::all_of(queues_.begin(), queues_.end(), [this](const Queue& q) { return q.size > round_size_; }))
      round_size_ *= 2;
    round_start_ = now;
    return true;
  }

  void work() {
    std::size_t s = 0;
    std::uint64_t from = 0, to = 0;
    const auto limit = std::chrono::duration<double>(o_.seconds.value_or(0) + 1);
    const GivesUp slow_calls(o_.seconds ? start_ + std::chrono::duration_cast<Clock::duration>(limit)
                                        : GivesUp::never);
    const GivesUpLongSums long_sums;
    try {
      while (take(s, from, to)) {
        const auto start = Clock::now();
        Tally tally;
        to = result_.series[s].series->run(o_.seed, {from, to}, tally, stop_requested);
        if (to == from) return;
        tally.done.add(from, to);
        const double seconds = seconds_since(start);
        const std::lock_guard lock(mutex_);
        add(s, from, to, tally);
        if (seconds < chunk_seconds && to - from >= queues_[s].size) queues_[s].size *= 2;
        if (seconds > 2 * chunk_seconds) queues_[s].size = std::max(std::uint64_t(1), queues_[s].size / 2);
        if (seconds_since(saved_) >= o_.checkpoint_seconds && !error_) save();
        show(false);
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!error_) error_ = std::current_exception();
    }
  }

  void add(std::size_t s, std::uint64_t from, std::uint64_t to, const Tally& tally) {
    result_.series[s].tally.merge(tally);
    if (checkpoint_) {
      auto& cells = changed_[s];
      for (const auto& [cell, row] : tally.rows) cells.insert(cell);
    }
    done_ += to - from;
  }

  void show(bool last) {
    const auto done = static_cast<double>(done_);
    const double share = o_.seconds ? progress_.elapsed() / *o_.seconds
                         : missing_ ? done / static_cast<double>(missing_)
                                    : 1.0;
    progress_.show(
        share,
        [&](double elapsed) {
          return fmt::format("{} cases  {:.0f}/s", done_, elapsed > 0 ? done / elapsed : 0);
        },
        last);
  }

  void save() {
    if (checkpoint_ && !changed_.empty()) checkpoint_->save(result_.series, changed_);
    changed_.clear();
    saved_ = Clock::now();
  }

  CampaignResult& result_;
  const CampaignOptions& o_;
  Checkpoint* checkpoint_;
  Clock::time_point start_, saved_;
  std::uint64_t missing_;
  Progress progress_;
  const std::uint64_t first_chunk_;  ///< a case of a large robot may take minutes
  std::mutex mutex_;
  std::condition_variable_any ended_;  ///< of the campaign
  std::vector<Queue> queues_;
  std::size_t next_ = 0;
  std::uint64_t done_ = 0, round_size_;
  double round_start_ = 0;
  Checkpoint::ChangedRows changed_;
  std::exception_ptr error_;
};

}  // namespace

CampaignResult run_campaign(const CampaignOptions& options, const Robot& robot, Checkpoint* checkpoint) {
  CampaignResult result;
  result.options = options;
  result.robot = robot;
  for (auto& s : select(options.selection, robot)) {
    s->every_kappa = options.every_kappa;
    result.series.push_back({std::move(s), {}});
  }
  if (checkpoint && !result.series.empty()) checkpoint->restore(result);
  Engine(result, checkpoint).run();
  result.summarize();
  return result;
}

}  // namespace liecheck::properties
