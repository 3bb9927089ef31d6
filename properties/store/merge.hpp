#pragma once
// Operations on stored campaigns: canonical text (export), merge, comparison.

#include <store/stored_campaign.hpp>

namespace liecheck::properties {

/// The canonical text of a campaign, its series, cells and failures, as sorted JSON lines. It has no time,
/// chunk, path, machine or shard, so that the same cases give the same bytes however they were run.
std::string export_text(const StoredCampaign& campaign);

/// Merges shards into one campaign, in any order. A shard that is given twice counts once. Throws
/// std::invalid_argument with files and ranges if different shards overlap, leave out a range (unless
/// `partial`) or belong to different campaigns.
StoredCampaign merge(const std::vector<std::string>& files, bool partial);

/// Merges into the store `out`, by a new file that is renamed. Other campaigns of `out` are preserved.
void merge_into(const std::string& out, const std::vector<std::string>& files, bool partial);

/// Returns a line for each cell of b that is worse than in a.
///
/// If the inputs are the same, every difference comes from the program. Then a new failing, unresolved,
/// ill-posed or unmeasured case is worse, and so is a maximum that grew by more than 10 % and by more than
/// 0.5 eps. (A smaller change may come from another order of operations or from the rounding of the result.)
/// If the inputs differ, a maximum depends on the sample. Then failures are worse if there were none before,
/// and so is a median or 99 % quantile that grew by as much, if chance would cause that only once in 1e9.
std::vector<std::string> worse(const StoredCampaign& a, const StoredCampaign& b);

}  // namespace liecheck::properties
