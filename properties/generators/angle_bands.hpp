#pragma once
// Angle bands: intervals of [0, infinity). A case belongs to the band that contains its exact angle.
//
// The bands are logarithmic near 0 and below pi, where formulas degenerate. They depend on the scalar: in the
// lowest bands theta or theta^2 underflows.

#include <cmath>
#include <limits>
#include <oracles/scalar.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

/// The quantity that a band limits.
enum class Axis { none, theta, pi_minus_theta };

/// Which rule of the budget table applies.
enum class Region { to_pi, beyond_pi };

struct Band {
  std::string name;
  Axis axis = Axis::none;
  double low = 0, high = 0;  ///< limits of theta or pi - theta [rad]; 0 if below the range of double
  Region region = Region::to_pi;
};

/// The bands of one scalar, in the order of the report. Index 0 is "all", for cases without an angle.
class Bands {
 public:
  static const Bands& of(const oracles::Scalar& scalar);

  const std::vector<Band>& all() const { return bands_; }
  const Band& operator[](std::size_t i) const { return bands_[i]; }

  /// The band of theta >= 0 [rad]. Throws oracles::Undecided if theta is a ball that contains an edge.
  template <class T>
  std::size_t classify(const T& theta) const;
  /// The band of an angle in (0, 2^-900): "subnormal" or "theta^2 underflows".
  std::size_t underflowing(bool is_subnormal) const { return first_theta_ + (is_subnormal ? 1 : 2); }
  /// The band of an angle that is exactly pi.
  std::size_t at_pi() const { return pi_; }

  ~Bands();

 private:
  Bands(int min_exponent, int digits);

  struct Edge;  ///< an angle between two bands
  std::vector<Band> bands_;
  std::vector<Edge> theta_edges_, pi_edges_;
  std::size_t first_theta_ = 0, generic_ = 0, first_pi_ = 0, pi_ = 0, beyond_ = 0, near_2pi_ = 0, huge_ = 0;
};

}  // namespace liecheck::properties
