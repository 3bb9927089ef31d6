#pragma once
// Checks that a series measured what it must: every output that the subject offers, in every case, and in the
// classes and bands that the generators must cover.

#include <campaign/series.hpp>

namespace liecheck::properties {

/// One class of one field, or one band of the angle, and the output that was measured least in it.
struct Covered {
  std::string what;    ///< "phi: beyond pi", "band theta 1e-8..1e-7"
  std::string output;  ///< "exp6, translation"
  std::uint64_t count = 0;
  std::uint64_t one_in = 0;     ///< at least one case in this many belongs to it
  bool required = false;        ///< the campaign is long enough to expect measurements in it
  bool outside_domain = false;  ///< every input of it is outside the domain of every output
  bool missing() const { return required && count == 0; }
};

/// All classes and bands that the series must cover, with the number of measurements of the output that was
/// measured least. Outputs that are ill-posed in the whole class or band do not count, unless all are. The
/// bands are those of the exact angles; a law without angles has none.
std::vector<Covered> coverage_of(const Series& series, const Tally& tally);

/// An output must be measured in at least one case in this many; in the others it may be ill-posed. The
/// problem that is ill-posed most often is aba_derivatives in float: eps kappa >= 1 in half of the random
/// trees and in nine of ten states of the quadruped in fixtures/robots. The factor of two leaves room for
/// chance.
inline constexpr std::uint64_t measured_one_in = 20;

/// What the series must have measured and did not, one line each. If there is none, a series without a
/// failure passes; otherwise it is incomplete. Unresolved cases and cases that the law did not record are
/// among them.
std::vector<std::string> not_measured(const Series& series, const Tally& tally);

/// One line: how many classes and bands were reached, or which are missing, and how many cases and classes
/// are outside the subject's domain.
std::string coverage_line(const std::vector<Covered>& all, const Tally& tally);

}  // namespace liecheck::properties
