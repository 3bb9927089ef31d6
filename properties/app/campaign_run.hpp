#pragma once
// A campaign with or without a store, in one process or over the ranks of mpirun.

#include <app/shared_flags.hpp>
#include <campaign/campaign.hpp>
#include <store/stored_run.hpp>

namespace liecheck::properties {

/// --store, --resume and --shard.
struct StoreFlags {
  std::string store, shard;
  bool resume = false;
  std::string typed_line;  ///< the whole command line, quoted for a shell

  void add(Arguments& arguments);
  /// Is this the part that replays the hard cases and earlier counterexamples: the first shard, or the first rank?
  bool first_shard() const;
  /// Before anything runs: throws for a wrong --shard, for --shard with --for, and for a store that cannot be used.
  void check(bool timed) const;
};

/// Runs a campaign into its store, over the ranks of mpirun where that started the program. Nothing on the ranks that
/// leave the result to the first one.
std::optional<StoredRun> run_stored_campaign(const Selection& selection, const Robot& robot,
                                             const CaseFlags& cases, const StoreFlags& store);

/// The section of earlier counterexamples.
void print_counterexamples(const Counterexamples& counterexamples);

/// How an interrupted campaign is resumed.
void print_how_to_resume(const CampaignResult& result, const StoreFlags& flags);

}  // namespace liecheck::properties
