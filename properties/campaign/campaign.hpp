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
  std::uint64_t cases = 1000;     ///< per property x subject x scalar
  std::optional<double> seconds;  ///< instead of `cases`
  unsigned jobs = 1;
  bool quiet = false;
};

struct SeriesResult {
  std::unique_ptr<Series> series;
  Tally tally;
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
};

/// Set by Ctrl-C and SIGTERM: the chunks in flight are finished, nothing new is begun.
extern std::atomic<bool> stop_requested;

/// Runs it. Progress on stderr: a bar on a terminal, plain lines elsewhere.
CampaignResult run_campaign(const CampaignOptions& options, const Robot& robot);

/// The record that `--json` writes and the report reads; documented in the README.
nlohmann::json record_of(const CampaignResult& result);

/// One failure as text: law, subject, scalar, block, error, kappa, shrunk input, replay command.
std::string describe_failure(const Series& series, std::uint64_t seed, int output, int band, const Row& row,
                             const Robot& robot);

}  // namespace liecheck::properties
