#pragma once
// Campaigns that run on a store: earlier counterexamples first, each checkpoint a transaction.

#include <store/store.hpp>

namespace liecheck::properties {

/// The result of a campaign and of the counterexamples of earlier runs, which count in no total and no digest.
struct StoredRun {
  CampaignResult result;  ///< `failed` also where a counterexample still fails
  Counterexamples counterexamples;
  std::string environment;  ///< JSON, of the run where that was another one; empty: this machine
};

/// Runs the campaign, or what the store lacks of it. The first shard runs the store's counterexamples first. Without
/// `resume` the store must not hold this campaign yet. Throws std::invalid_argument naming what differs.
StoredRun run_stored(const CampaignOptions& options, const Robot& robot, Store& store, bool resume);

/// A stored campaign with the laws and subjects of this program. Throws where it lacks one.
StoredRun result_of(const StoredCampaign& campaign, const std::string& name);

}  // namespace liecheck::properties
