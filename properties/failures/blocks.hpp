#pragma once
// The failures of a campaign by operation and block: where, how bad, how often, and what the cause may be.

#include <campaign/campaign.hpp>

namespace liecheck::properties {

/// One output of one law in one band.
struct BandOf {
  const Series* series;
  std::size_t output, band;
  const Row* row;
  bool fails;             ///< beyond what a limits file expects
  bool expected = false;  ///< as a limits file expects
};

/// One block of one operation of a subject in a scalar, of all laws that measure it.
struct FailedBlock {
  std::string subject, scalar, operation, block;
  std::vector<BandOf> bands;  ///< those with cases, in the order of the angle
  const BandOf*
      worst;  ///< the failing one with the worst outcome or the largest error, of ordinary angles if one is
  double score = 0;  ///< the largest error or excess of such a band [eps]; 0 if none has an error
  std::uint64_t failed = 0, cases = 0;  ///< of the failing bands
  FailedBlock() = default;
  FailedBlock(const FailedBlock&) = delete;  // `worst` points into `bands`
  FailedBlock(FailedBlock&&) = default;
  FailedBlock& operator=(FailedBlock&&) = default;
};

/// Those that fail, worst first: without a result, NaN or Inf, a wrong branch, other outcomes, then by the error.
std::vector<FailedBlock> failed_blocks(const CampaignResult& campaign);

/// Angles of 1e-8 to 2 pi that are no closer than 1e-8 to pi, 0, pi, and inputs without an angle.
bool is_ordinary(const Band& band);

/// Finds the worst band again, and the figures that follow from it, after `fails` of a band has changed; none may fail.
void find_worst(FailedBlock& block);

/// The outcomes of a row without an error in eps, with their numbers of cases, worst first.
std::vector<std::pair<std::uint64_t, const char*>> outcomes(const Row& row);

/// The error or excess of a band by the rule of its limit, of the cases that have one.
double score_of(const BandOf& band);

/// How many cases of a row had which outcome without an error in eps, worst first; "" if none had.
std::string outcomes_of(const Row& row);

/// The worst outcome of a row without an error in eps; "" if there is none. NaN or Inf counts only where it is three quarters of
/// the failures, unless `even_if_rare`: the others have an error, by which most readers will meet the fault.
std::string worst_outcome(const Row& row, bool even_if_rare = false);

/// Whether both fail in a band, or in adjacent ones, in the same scalar.
bool fail_together(const FailedBlock& a, const FailedBlock& b);
/// Whether a block passes in most bands in which most cases of another one are far from right: then it is not made of that one.
bool passes_where_most_fail(const FailedBlock& f, const FailedBlock& other);
/// Whether half of the bands in which either fails are bands in which both do.
bool share_bands(const FailedBlock& a, const FailedBlock& b);

/// The share of ordinary inputs that fail, times the share of digits that they lose.
double ordinary_loss(const FailedBlock& failed);

/// What happened: "NaN or Inf" or "7.4 of 15.7 digits lost".
std::string what_of(const FailedBlock& failed);

/// Whether a band fails in another way than the worst one: with another outcome, or with an error where that has none.
bool fails_otherwise(const FailedBlock& failed, const BandOf& band);

/// Where: "theta 1e-9 to 1e-7, pi - theta < 1e-6", or "everywhere".
std::string where_of(const FailedBlock& failed);

/// Where, and how many cases fail there: by bands of the angle if most cases in them fail, else by a condition on one
/// or two other features of the call, if one separates the cases that fail from those that pass.
std::string where_and_how_often(const FailedBlock& failed, const CampaignResult& campaign);

/// One sentence on the cause if the error over the bands, or the results at moderate angles, tell it; or "".
std::string guess_of(const FailedBlock& failed);

}  // namespace liecheck::properties
