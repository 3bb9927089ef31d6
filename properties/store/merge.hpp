#pragma once
// Operations on stored campaigns: canonical text (export), merge, comparison.

#include <array>
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

/// A cell that is worse in a later campaign.
struct Change {
  std::array<std::string, 6>
      name;  ///< subject, scalar, property, operation, block, band; the last three may be ""
  std::string what;
  std::string worst_case;  ///< of the cell in the later campaign: a case ID, or ""
  std::string text() const;
};

/// The command that runs the worst case again, and below it, as a comment, its input if that has few numbers; "" if there
/// is no worst case. A store does not know how an adapter was started, so the command then has "--adapter ADAPTER".
std::string replay_of(const Change& change);

/// Returns what is worse in b than in a.
///
/// Throws std::invalid_argument if a subject was judged by different limits files.
///
/// If the inputs are the same, every difference comes from the program. Then a new failing, unresolved,
/// ill-posed or unmeasured case is worse, and so is a maximum that grew by more than 10 % and by more than
/// 0.5 eps. (A smaller change may come from another order of operations or from the rounding of the result.)
/// If the inputs differ, a maximum depends on the sample, and so does a failure that occurs once. Then only what
/// chance would cause less than once in 1e9 is worse (sampling.hpp), in one band or in all bands together.
std::vector<Change> changes(const StoredCampaign& a, const StoredCampaign& b);
/// A line for each change.
std::vector<std::string> worse(const StoredCampaign& a, const StoredCampaign& b);
/// What got worse and what got better, as a comment on a pull request, in Markdown. `picture` is the name of the file
/// with the picture (picture.hpp), or "".
std::string in_markdown(const StoredCampaign& a, const StoredCampaign& b, const std::string& picture = "");

/// The number of cells with a verdict in both campaigns. If it is 0, nothing was compared.
std::size_t cells_in_both(const StoredCampaign& a, const StoredCampaign& b);

}  // namespace liecheck::properties
