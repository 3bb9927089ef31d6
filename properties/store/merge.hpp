#pragma once
// Operations on stored campaigns: canonical text (export), merge.

#include <store/stored_campaign.hpp>

namespace liecheck::properties {

/// The canonical text of a campaign, its series, cells and failures, as sorted JSON lines. It contains no
/// time, chunk, path, machine or shard. So the same cases give the same bytes, however they were run.
std::string export_text(const StoredCampaign& campaign);

/// Merges shards into one campaign, in any order. A shard that is given twice is merged once. Throws
/// std::invalid_argument with files and ranges if different shards overlap, lack a range of cases (unless
/// `partial`) or belong to different campaigns.
StoredCampaign merge(const std::vector<std::string>& files, bool partial);

/// Writes the merged campaign to a new file and renames it to `out`. Other campaigns of `out` are preserved.
/// Until then, no other process can write to `out`; throws if one has created or replaced it.
void merge_into(const std::string& out, const std::vector<std::string>& files, bool partial);

}  // namespace liecheck::properties
