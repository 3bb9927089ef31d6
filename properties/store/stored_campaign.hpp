#pragma once
// A stored campaign: its options, and for each series the tally and the names of the cells.

#include <campaign/campaign.hpp>

namespace liecheck::properties {

using Cell = Rows::Cell;  ///< (output, band)
struct StoredCampaign;

/// The identity of a campaign: two runs with equal specs are one campaign.
struct CampaignSpec {
  std::uint64_t seed = 0;
  std::uint64_t cases = 0;            ///< of each series; 0 if only the time was given
  std::uint64_t first = 0, last = 0;  ///< the range of cases of this shard
  int generator = generator_version;
  std::string program;  ///< version of liecheck
  std::string budgets;  ///< the first 16 digits of the SHA-256 of the budget table
  Robot robot;
  std::vector<std::shared_ptr<const SubjectLimits>> limits;  ///< sorted by subject
  std::string environment;          ///< JSON of the machine that ran it; not compared
  BesideCases beside;               ///< of the first shard; no part of the identity
  std::vector<std::string> series;  ///< names of the series (SeriesName::text)

  /// Returns "seed 1 against 2; ...", or an empty text if both are the same campaign.
  std::string differences(const CampaignSpec& other, bool with_range = true) const;
};
/// Returns "limits of a: none against x.limits (0123456789abcdef); ...", or an empty text if each subject was
/// judged by the same limits file.
std::string differences_of_limits(const CampaignSpec& a, const CampaignSpec& b);
/// Returns "profile of a: ours against careful; ...", or an empty text if each subject in both was judged by
/// the same profile.
std::string differences_of_profiles(const StoredCampaign& a, const StoredCampaign& b);
CampaignSpec spec_of(const CampaignOptions& options, const Robot& robot,
                     const std::vector<SeriesResult>& series);

struct Label {
  std::string operation, block, band;
};
struct Failure {
  std::uint64_t index = 0;  ///< of the case
  std::string input;        ///< hexadecimal floats, joined by commas
};

struct SeriesName {
  std::string property, subject, subject_version, scalar, robot, profile;
  std::string text() const;
};
SeriesName name_of(const Series& series);

struct StoredSeries : SeriesName {
  Tally tally;
  std::map<Cell, Label> labels;
  std::map<Cell, Failure> failures;
};

struct StoredCampaign {
  CampaignSpec spec;
  std::vector<StoredSeries> series;
  bool complete() const;  ///< every series has its whole range; false if only the time was given
  /// Why no verdict can rest on it: "nothing was measured", "7 measurements have no verdict"; or "".
  std::string not_measured() const;
};

}  // namespace liecheck::properties
