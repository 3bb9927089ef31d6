#pragma once
// Angle bands: where on [0, infinity) a case lies, by the exact angle.
//
// Log-spaced on both sides of the two places where formulas degenerate, 0 and pi, and scaled to the scalar:
// the lowest bands are those in which theta or theta^2 underflows in that scalar.

#include <cmath>
#include <limits>
#include <oracles/real.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

/// What a band is measured along.
enum class Axis { none, theta, pi_minus_theta };

/// Which rule of the budget table holds there.
enum class Region { to_pi, beyond_pi };

struct Band {
  std::string name;
  Axis axis = Axis::none;
  double low = 0, high = 0;  ///< along the axis [rad]; 0 where a double cannot hold it
  Region region = Region::to_pi;
};

/// The bands of one scalar, in the order of the report. Index 0 is "all": no angle is involved.
class Bands {
 public:
  template <class S>
  static const Bands& of() {
    static const Bands bands = [] {
      using L = std::numeric_limits<S>;
      return Bands(L::min_exponent - 1, L::digits);
    }();
    return bands;
  }

  const std::vector<Band>& all() const { return bands_; }
  const Band& operator[](std::size_t i) const { return bands_[i]; }

  /// The band of an exact angle theta >= 0 [rad].
  std::size_t classify(const oracles::Real& theta) const;
  /// Of an angle > 0 below 2^-900: below the smallest normal number, or not.
  std::size_t underflowing(bool is_subnormal) const { return first_theta_ + (is_subnormal ? 1 : 2); }
  /// Of an angle that is exactly pi.
  std::size_t at_pi() const { return pi_; }
  /// The same of a ball; throws oracles::Undecided where it lies across an edge.
  std::size_t classify(const oracles::DoubleBall& theta) const { return classify_ball(theta); }
  std::size_t classify(const oracles::DoubleDoubleBall& theta) const { return classify_ball(theta); }

 private:
  Bands(int min_exponent, int digits);

  template <class T>
  std::size_t classify_ball(const T& theta) const;

  std::vector<Band> bands_;
  std::vector<oracles::Real> theta_edges_, pi_edges_;
  std::vector<oracles::DoubleDouble> fast_theta_edges_, fast_pi_edges_;  ///< within 2^-106 relative
  std::size_t first_theta_ = 0, generic_ = 0, first_pi_ = 0, pi_ = 0, beyond_ = 0, near_2pi_ = 0, huge_ = 0;
};

}  // namespace liecheck::properties
