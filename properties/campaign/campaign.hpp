#pragma once
// A campaign runs every selected series over a range of cases, on several threads.

#include <campaign/beside_cases.hpp>
#include <campaign/robots.hpp>
#include <campaign/selection.hpp>
#include <map>
#include <optional>
#include <set>

namespace liecheck::properties {

struct CampaignOptions {
  Selection selection;
  std::uint64_t seed = 42;
  std::uint64_t cases = 1000;      ///< per property x subject x scalar
  std::optional<double> seconds;   ///< duration; replaces `cases`
  unsigned shard = 1, shards = 1;  ///< this run does part `shard` of the cases of each series
  unsigned jobs = 1;
  double checkpoint_seconds = 0.5;  ///< between two checkpoints; a killed run loses about this much time
  bool quiet = false;
  bool every_kappa = false;  ///< Series::every_kappa
  BesideCases beside = {};   ///< what was found before the first case

  std::optional<Range> range_override;  ///< replaces the shard's range

  /// The cases of every series. The range has no end if only the time is given.
  Range range() const;
};

struct SeriesResult {
  std::unique_ptr<Series> series;
  Tally tally;
};

/// A call of the probe of an adapter that is wrong, of an operation that no law finds wrong.
struct WrongCall {
  std::string subject, sentence;
};

struct CampaignResult {
  CampaignOptions options;
  Robot robot;
  std::vector<SeriesResult> series;
  bool incomplete = false;  ///< interrupted: cases are missing
  bool failed = false;      ///< a row failed, a cliff was found (cliffs.hpp), or the oracles disagree
  bool measured = true;     ///< every series measured what it must (coverage_report.hpp)
  std::vector<WrongCall> wrong_calls = {};
  std::string inputs_digest, results_digest;
  std::uint64_t total_cases = 0;
  double elapsed = 0;  ///< s
  /// Computes the digests, the total and the verdict from the series.
  void summarize();
  bool fails() const { return failed || !wrong_calls.empty(); }
  /// Whether the verdict is neither "pass" nor "fail". What was not measured hides no failure.
  bool undecided() const { return incomplete || (!fails() && !measured); }
};

/// The interface through which a campaign saves its progress, so that it can be resumed.
class Checkpoint {
 public:
  using ChangedRows = std::map<std::size_t, std::set<Rows::Cell>>;  ///< by the index of their series
  virtual ~Checkpoint() = default;
  /// Called once, before the first case: fills in the tallies of the cases that an earlier run has done.
  virtual void restore(CampaignResult& campaign) = 0;
  /// Saves the series and rows that changed since the last call. Called by one thread at a time. The campaign
  /// stops if this throws.
  virtual void save(const std::vector<SeriesResult>& series, const ChangedRows& changed) = 0;
};

/// Runs the cases of a campaign that its checkpoint does not have yet. Progress goes to stderr: a bar on a
/// terminal, plain lines elsewhere. Threads take chunks of cases from each series in turn; the time of a
/// chunk sets the size of the next. After stop_requested the cases in progress are finished, and their
/// chunks end there. The checkpoint is saved every checkpoint_seconds and at the end.
CampaignResult run_campaign(const CampaignOptions& options, const Robot& robot,
                            Checkpoint* checkpoint = nullptr);

}  // namespace liecheck::properties
