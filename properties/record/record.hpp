#pragma once
// Results as records: what `--json` writes and the report reads, documented in docs/record.md. Numbers
// that are not finite are written by support/json_number.hpp.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace liecheck::scene {
struct Scene;
struct Run;
}  // namespace liecheck::scene

namespace liecheck::properties {

struct CampaignResult;
struct CostResult;
struct CostRow;
struct HardRow;
struct Spread;
struct StoredRun;

/// The verdict on a whole run.
inline const char* verdict_of(bool complete, bool passed) {
  return !complete ? "incomplete" : passed ? "pass" : "fail";
}

/// A campaign. If it was loaded from a store, its environment is the stored one, otherwise that of this run.
nlohmann::json record_of(const StoredRun& run);

/// Adds to the worst cases of these rows of the campaign's record what the subject returned and what is right. Measures
/// them again on the threads of the campaign.
void add_compared_numbers(nlohmann::json& record, const CampaignResult& campaign,
                          const std::vector<std::size_t>& rows);

/// Adds key "maps": the error over the angle and the scale of the translation.
void add_maps(nlohmann::json& record, const CampaignResult& campaign);

/// The hard cases: key "hard_cases" of a campaign's record.
nlohmann::json record_of(const std::vector<HardRow>& rows);

/// Adds hard cases to a campaign's record. Unless the campaign was interrupted, its verdict becomes "fail" if
/// a hard case failed, and "incomplete" instead of "pass" if a hard case has no verdict.
void add_hard_cases(nlohmann::json& record, const std::vector<HardRow>& rows, bool interrupted);

/// Adds a part that the laboratory measured to a campaign's record: key "sweep" or "bounds". The record's verdict becomes
/// "fail" if that of the part is.
void add_part(nlohmann::json& record, const std::string& key, nlohmann::json part);

/// Time and error of operations: key "cost" of a campaign's record.
nlohmann::json record_of(const CostResult& result);

/// Returns null if nothing was timed.
nlohmann::json record_of(const Spread& time);

/// Subject and scalar, such as "liecheck double".
std::string implementation_of(const CostRow& row);

/// The run of one scene, which `liecheck scene run --json` writes.
nlohmann::json record_of(const scene::Scene& scene, const scene::Run& run);

}  // namespace liecheck::properties
