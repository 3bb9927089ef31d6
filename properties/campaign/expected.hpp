#pragma once
// Failures that a limits file expects: docs/limits.md, section Expected failures.

#include <campaign/campaign.hpp>

namespace liecheck::properties {

/// Whether a row has failures that its subject does not expect.
bool fails(const Series& series, const Rows::Cell& cell, const Row& row);
bool fails(const Series& series, const Judged& judged);

/// What became of one line of [expected], in all laws and scalars of its subject.
struct Expectation {
  std::string subject;
  ExpectedFailure line;
  std::uint64_t measured = 0, failed = 0;  ///< cases in its region
  bool cliff = false;
  /// Whether the failure is gone: none in 100 cases.
  bool passed() const { return measured >= 100 && failed == 0 && !cliff; }
};
std::vector<Expectation> expectations_of(const CampaignResult& campaign);

/// "expected failure: mylib, exp6 translation at theta 1e-9..1e-3: 12 of 340 cases: why (link)".
std::string text_of(const Expectation& e);

}  // namespace liecheck::properties
