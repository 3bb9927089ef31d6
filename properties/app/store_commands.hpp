#pragma once
// The commands around stores: the campaign's flags, merge, export, compare.

#include <CLI/CLI.hpp>
#include <optional>
#include <store/stored_run.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

enum Exit { within_budget = 0, property_failed = 1, bad_input = 2, incomplete = 3 };

/// Of `campaign`.
struct StoreFlags {
  std::string store, shard;
  bool resume = false;
  std::string command;  ///< the whole line as typed, quoted for a shell
  CLI::Option* jobs = nullptr;

  /// Does this run what belongs to no range: hard cases and earlier counterexamples?
  bool first_shard() const;  ///< of a campaign in shards, of mpirun's ranks: is this the first?
};
void add_store_flags(CLI::App& campaign, StoreFlags& flags);

/// The line that was typed, each argument quoted where a shell needs it.
std::string command_line(int argc, char** argv);

/// Before anything runs: throws for a wrong --shard, for --shard with --for, and for a store that cannot be used.
void check_store_flags(const StoreFlags& flags, bool timed);

/// Runs a campaign into its store, over the ranks of mpirun where it started this; nothing on the ranks that
/// leave the result to the first one.
std::optional<StoredRun> run_stored_campaign(CampaignOptions options, const Robot& robot,
                                             const StoreFlags& flags);

/// The section of earlier counterexamples, and how an interrupted campaign goes on.
void print_counterexamples(const Counterexamples& counterexamples);
void print_how_to_go_on(const CampaignResult& result, const StoreFlags& flags);

/// Merge, export and compare.
class StoreCommands {
 public:
  explicit StoreCommands(CLI::App& app);
  /// The exit code, where one of them was given.
  std::optional<int> run() const;

 private:
  CLI::App *merge_, *export_, *compare_;
  std::string out_, export_out_, store_, before_, after_;
  std::vector<std::string> in_;
  bool partial_ = false;
};

/// Stores among the records become JSON records in `folder`; the names to read instead.
std::vector<std::string> with_records_of_stores(const std::vector<std::string>& records,
                                                const std::string& folder);

}  // namespace liecheck::properties
