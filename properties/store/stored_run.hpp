#pragma once
// Runs campaigns on a store: first its counterexamples, then the cases. Each checkpoint is a transaction.

#include <store/store.hpp>

namespace liecheck::properties {

/// The results of a campaign and of earlier counterexamples. Totals and digests exclude the counterexamples.
struct StoredRun {
  CampaignResult result;  ///< `failed` is also set if a counterexample still fails
  Counterexamples counterexamples;
  std::string environment;  ///< JSON of the machine of a loaded run; empty: this machine
};

/// Runs the cases of a campaign that the store does not have yet. The first shard runs the store's
/// counterexamples first. Without `resume`, the store must not hold this campaign yet. If the stored campaign
/// differs, throws std::invalid_argument with the differences.
StoredRun run_stored(const CampaignOptions& options, const Robot& robot, Store& store, bool resume);

/// Connects a stored campaign with the laws and subjects of this program. Throws if one is missing.
StoredRun result_of(const StoredCampaign& campaign, const std::string& name);

}  // namespace liecheck::properties
