#pragma once
// The errors of one walk at some numbers of steps, and how they grow.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace liecheck::properties {

/// The larger one; NaN if one of them is.
inline double larger(double a, double b) {
  return std::isnan(a) ? a : std::isnan(b) ? b : std::max(a, b);
}

/// After n steps, over all paths.
struct HorizonPoint {
  std::uint64_t n = 0;
  double norm = 0;      ///< largest | |Q|^2 - 1 | or |R^T R - I| so far [eps]
  double attitude = 0;  ///< root of the mean square of the angle between the pose and the exact one [eps]
};

struct Horizon {
  std::string subject, scalar, walk;
  std::vector<HorizonPoint> points;
  double exponent = 0, low = 0,
         high = 0;  ///< attitude ~ n^exponent, fitted from n = 1000 on; the 95 % interval
  double norm_limit = 0, angle_limit = 0;  ///< of the walk, or 0
};

/// The slope of log attitude over log n by least squares, over the points with n >= 1000, and its 95 % interval: that of the
/// slopes of random walks, sums of independent errors, at the same points and with as many paths. 2000 are simulated.
void fit_growth(Horizon& horizon, unsigned paths);

}  // namespace liecheck::properties
