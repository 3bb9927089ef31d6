#pragma once
// Operations on stored campaigns: canonical text (export), merge, comparison.

#include <store/stored_campaign.hpp>

namespace liecheck::properties {

/// The canonical text of a campaign, its series, cells and failures: sorted JSON lines without time, chunk, path,
/// machine or shard, so that the same cases give the same bytes however they were run.
std::string export_text(const StoredCampaign& campaign);

/// Merges shards into one campaign, in any order. The same shard given twice counts once; shards that otherwise overlap,
/// leave out a range (unless `partial`) or belong to different campaigns throw std::invalid_argument naming files and
/// ranges.
StoredCampaign merge(const std::vector<std::string>& files, bool partial);

/// Merges into a store, which is written beside `out` and renamed. Other campaigns of an existing `out` are kept.
void merge_into(const std::string& out, const std::vector<std::string>& files, bool partial);

/// Returns a line for each cell of b that is worse than in a.
///
/// Over the same inputs every difference comes from the program: a new failing, unresolved, ill-posed or unmeasured case
/// is worse, and so is a maximum that grew by more than 10 % and by more than 0.5 eps (a smaller change may come from
/// another order of operations, or be the half ulp of a correctly rounded result). Over different inputs a maximum
/// depends on the sample: worse are failures where there were none, and a median or 99 % quantile that grew as much,
/// where chance alone would cause that once in 1e9.
std::vector<std::string> worse(const StoredCampaign& a, const StoredCampaign& b);

}  // namespace liecheck::properties
