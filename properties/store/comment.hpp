#pragma once
// A comparison as a comment on a pull request.

#include <store/compare.hpp>
#include <store/times.hpp>

namespace liecheck::properties {

/// The command that runs the worst case again, and below it, as a comment, its input if that has few numbers; "" if there
/// is no worst case. A store does not know how an adapter was started, so the command then has "--adapter ADAPTER".
std::string replay_of(const Change& change);

/// Of each block the most important cell, whose band is then "theta 1e-8..1e-7 and 12 more".
std::vector<Change> by_block(const std::vector<Change>& changes);

/// "2 cells are worse, 1 cell is better, 14 cells differ by less"; "nothing is worse" alone if nothing differs.
/// First what is `open`: why the comparison is incomplete. What is measured on one side only follows what is worse.
std::string summary_of(const Comparison& comparison, std::size_t compared_cells,
                       const std::vector<std::string>& open);

struct CommentParts {
  std::size_t cells = 0;               ///< that were compared
  std::string picture;                 ///< the name of the file with the picture (picture.hpp), or ""
  const TimeChanges* times = nullptr;  ///< or null
  std::vector<std::string> open = {};  ///< of summary_of()
};
/// Markdown of at most 60000 bytes, since GitHub takes 65536 characters: what got worse, its replays, times, what got
/// better, and all else, each the most important first; it says how much it leaves out.
std::string in_markdown(const Comparison& comparison, const CommentParts& parts);

}  // namespace liecheck::properties
