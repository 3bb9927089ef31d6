#pragma once
// The input of a failure as a person would write it: numbers of ordinary size, simple axes, angles in the middle of a band.

#include <search/shrink.hpp>
#include <set>

namespace liecheck::properties {

/// A band, the error or excess of its worst case, and whether somebody will meet its angles: these are tried first.
struct BandOfFailure {
  std::size_t band;
  double score;
  bool ordinary = true;
};

/// An input that fails with an outcome like `worst` in one of the bands, tried in their order: translations like (1, 2, 3),
/// also two that are nearly equal, rotations about simple axes by a round angle, and their quaternions of both signs. None
/// if no such input fails with a tenth of the error of the band's worst case. `with_error`: it has an error, whatever `worst` has.
std::optional<Shrunk> plain_failure(const Series& series, const CaseId& worst, int output,
                                    const std::vector<BandOfFailure>& bands, bool with_error = false);

struct Crossing {
  double angle;    ///< [rad]
  double passing;  ///< error over limit of an input beside it, on the side of `passing`
};
/// Where the errors of plain inputs of an output change from those at an angle at which they fail to those at one at which they
/// pass, or err by 30 times less, by bisection; none if no plain input does so.
std::optional<Crossing> angle_between(const Series& series, int output, double failing, double passing);

/// The largest angle between two below which results of plain inputs are 0 and right ones are not, to a thousandth; none if
/// they are not 0 at `low`, or still at `high`.
std::optional<double> last_zero(const Series& series, int output, double low, double high);

/// The power of theta, or pi - theta, as which the largest errors of plain inputs grow between two angles, where they are above
/// the limit and leave four digits; 0 if they are so at fewer than six angles.
double slope_of_errors(const Series& series, int output, double low, double high, bool from_pi);

/// A change at once of the largest errors of plain inputs.
struct ErrorStep {
  double angle;         ///< theta, or pi - theta [rad]
  double below, above;  ///< error over limit beside it
};
/// The largest step of errors between two angles theta, or pi - theta if `from_pi`, by a factor of six at least, to three
/// thousandths of the angle; none if plain inputs show none.
std::optional<ErrorStep> step_of_errors(const Series& series, int output, double low, double high, bool from_pi);

}  // namespace liecheck::properties
