#pragma once
// The findings of a campaign: the failures that one cause explains.

#include <failures/blocks.hpp>
#include <hard_cases/hard_cases.hpp>
#include <set>

namespace liecheck::properties {

/// Bands of a block in which its cause explains nothing: it passes there or, if `of_outcome`, has not the same outcome in place of
/// an error.
struct Beside {
  const FailedBlock* block;
  std::set<std::size_t> bands;
  bool of_outcome;
};

/// Failures with one cause: blocks of an operation in each scalar, and of those that call it.
struct Finding {
  std::string subject, operation;
  std::vector<const FailedBlock*>
      own;  ///< blocks of the operation that is wrong, worst first; empty if only hard cases fail
  std::vector<const FailedBlock*> others;  ///< of operations that fail in the same way
  std::vector<std::string> partly;         ///< operations of which it explains some bands, not all
  std::vector<Beside> beside;
  std::vector<const HardRow*> hard_rows;    ///< hard cases that fail in one of these blocks
  std::vector<const HardCell*> hard_cells;  ///< of `hard_rows`, one each
  std::vector<std::string> used;            ///< spatial operations that fail and that it may use
  double ordinary = 0;  ///< the share of ordinary inputs that fail, times the share of digits that they lose
};

/// The findings, those first that cost the most digits of the most ordinary inputs. All pointers are into `failed` and `hard_cases`.
/// In `failed`, the bands of a block that another finding explains no longer fail.
std::vector<Finding> findings_of(const CampaignResult& campaign, std::vector<FailedBlock>& failed,
                                 const std::vector<HardRow>& hard_cases);

/// Lines for a finding: what fails and how badly, where, perhaps why, what else is wrong because of it, and an input that a
/// person would have written, if one fails.
std::string text_of(const Finding& finding, std::size_t number, const CampaignResult& campaign);

}  // namespace liecheck::properties
