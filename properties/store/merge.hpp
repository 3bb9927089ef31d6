#pragma once
// What is done with stored campaigns: one canonical text, several into one, one against another.

#include <store/stored_campaign.hpp>

namespace liecheck::properties {

/// The canonical export: JSON lines, sorted; no time, chunk, path, machine or shard in it, so that the same
/// cases give the same bytes however they were run. The campaign, its series, its cells, its failures.
std::string export_text(const StoredCampaign& campaign);

/// Shards into one campaign. Each case once: the same part twice with the same content counts once, anything
/// else that overlaps, lacks a range (unless `partial`) or belongs to another campaign throws
/// std::invalid_argument naming files and ranges. The order of the files does not matter.
StoredCampaign merge(const std::vector<std::string>& files, bool partial);

/// Merges into a file: beside it first, then renamed. Where it exists, its other campaigns are kept.
void merge_into(const std::string& out, const std::vector<std::string>& files, bool partial);

/// What got worse from a to b, a line each.
///
/// Over the same inputs every difference is the program's, not the sample's: a new failing, unresolved,
/// ill-posed or unmeasured case is worse, and so is a maximum that grew by more than 10 % and by more than
/// 0.5 eps (less is another order of operations, or the half ulp by which a correctly rounded result may move).
/// Over other inputs a maximum is the sample's: failures and the like count where there were none, and errors
/// whose median or 99 % point grew as much, where chance would do so once in 1e9.
std::vector<std::string> worse(const StoredCampaign& a, const StoredCampaign& b);

}  // namespace liecheck::properties
