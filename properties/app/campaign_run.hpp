#pragma once
// A campaign with or without a store, in one process or over the ranks of mpirun.

#include <app/command.hpp>
#include <campaign/campaign.hpp>
#include <failures/findings.hpp>
#include <nlohmann/json_fwd.hpp>
#include <store/stored_run.hpp>

namespace liecheck::properties {

/// Which cases a campaign runs: --cases, --robot, --root, --seed, --for and --jobs.
struct CaseFlags {
  RobotFlags robot;
  CampaignOptions options;
  Flag jobs_flag;

  /// Adds the flags. Returns all except --root.
  std::vector<Flag> add(Arguments& arguments);
};

/// --store, --resume and --shard.
struct StoreFlags {
  std::string store, shard;
  bool resume = false;
  std::string typed_line;  ///< the whole command line, quoted for a shell

  void add(Arguments& arguments);
  /// Whether this is the first shard or rank, which replays the hard cases and earlier counterexamples.
  bool first_shard() const;
  /// Throws for a wrong --shard, for --shard with --for, and for a store that cannot be used. Runs nothing.
  void check(bool timed) const;
};

/// What a store keeps of the probe of adapters and of the hard cases.
BesideCases beside_of(const std::vector<ProbedOperation>& probed, const std::vector<HardRow>& hard_cases);

/// Runs a campaign into its store. Under mpirun, all ranks take part and only the first returns a result.
std::optional<StoredRun> run_stored_campaign(const Selection& selection, const Robot& robot,
                                             const CaseFlags& cases, const StoreFlags& store,
                                             const BesideCases& beside = {});

/// Prints the section on counterexamples of earlier runs, each if `all`.
void print_counterexamples(const Counterexamples& counterexamples, bool all);

/// Prints a line for each operation and block that failed, worst first, and the worst one in full; if `all`, each.
void print_failures(const CampaignResult& result, bool all);

/// The findings of a campaign, and the lines of the first ten, or of all.
struct ToldFindings {
  std::vector<FailedBlock> failed;  ///< to which the findings point
  std::vector<Finding> findings;
  std::vector<std::string> texts;
};
ToldFindings told_findings(const CampaignResult& result, const std::vector<HardRow>& hard_cases, bool all);
void print(const ToldFindings& findings);
/// Prints the line of a limits file that expects the first failure, or those of all.
void print_how_to_accept(const ToldFindings& findings, bool all);

/// Prints the operations of the only subject that have no finding.
void print_without_finding(const CampaignResult& result, const ToldFindings& told);
/// Prints what was measured, in one line.
void print_measured(const CampaignResult& result, const std::vector<HardRow>& hard_cases);

/// Prints how to resume an interrupted campaign.
void print_how_to_resume(const CampaignResult& result, const StoreFlags& flags);

/// The record of a campaign with the numbers of its worst cases and the maps of the error.
nlohmann::json full_record_of(const StoredRun& run);

void add_findings(nlohmann::json& record, const ToldFindings& findings);

/// Writes the record of a campaign with its hard cases, unless `file` is empty.
void write_campaign_record(const std::string& file, const StoredRun& run,
                           const std::vector<HardRow>& hard_cases, const ToldFindings& findings = {});

}  // namespace liecheck::properties
