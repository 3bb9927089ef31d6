#pragma once
// A campaign: every selected series over a range of cases, on some threads, to one record.

#include <atomic>
#include <campaign/series.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>

namespace liecheck::properties {

struct CampaignOptions {
  Selection selection;
  std::uint64_t seed = 42;
  std::uint64_t cases = 1000;      ///< per property x subject x scalar
  std::optional<double> seconds;   ///< instead of `cases`
  unsigned shard = 1, shards = 1;  ///< the part of the cases of every series that this run does
  unsigned jobs = 1;
  double keep_seconds = 0.5;  ///< between transactions of a store; a kill loses about as much
  bool quiet = false;

  std::optional<Range> range_of_store;  ///< instead of the shard's

  /// The cases of every series. Without an end where only the time is given.
  Range range() const;
};

struct SeriesResult {
  std::unique_ptr<Series> series;
  Tally tally;
};

/// Failing inputs of earlier runs, run again: beside the counted cases and their digests.
struct Counterexamples {
  struct Failing {
    std::string operation, block, id;
  };
  std::size_t replayed = 0;
  std::size_t skipped = 0;  ///< of another robot or outside the selection
  std::vector<Failing> failing;
};

struct CampaignResult {
  CampaignOptions options;
  Robot robot;
  std::vector<SeriesResult> series;
  bool incomplete = false;
  bool failed = false;
  bool covered = true;  ///< every class and band that so many cases must reach was reached
  std::string inputs_digest, results_digest;
  std::uint64_t total_cases = 0;
  double elapsed = 0;  ///< s
  Counterexamples counterexamples;
  std::string environment;  ///< JSON, of the run where that was another one; empty: this machine
  /// Digests, total and verdict from the series.
  void summarize();
};

class Store;

/// Set by Ctrl-C, SIGTERM and SIGHUP: the chunks in flight are finished, nothing new is begun.
extern std::atomic<bool> stop_requested;

/// Runs it, or what is missing of it. Progress on stderr: a bar on a terminal, plain lines elsewhere.
///
/// Threads take chunks of cases sized to time, round all series. A store gets what was done about every half
/// second, in one transaction; its earlier counterexamples are run first (by the first shard). Without
/// `resume` the store must not hold this campaign yet.
CampaignResult run_campaign(const CampaignOptions& options, const Robot& robot, Store* store = nullptr,
                            bool resume = false);

/// The record that `--json` writes and the report reads; documented in the README.
nlohmann::json record_of(const CampaignResult& result);
std::string environment_text();  ///< this machine and program, as JSON

/// One failure as text: law, subject, scalar, block, error, kappa, shrunk input, replay command.
std::string describe_failure(const Series& series, std::uint64_t seed, int output, int band, const Row& row,
                             const Robot& robot);

}  // namespace liecheck::properties
