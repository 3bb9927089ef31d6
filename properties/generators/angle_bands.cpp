#include <generators/angle_bands.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <oracles/number.hpp>

namespace liecheck::properties {

using oracles::Real;

namespace {
Real pi() {
  return boost::math::constants::pi<Real>();
}
Real power_of_ten(int e) {
  return pow(Real(10), e);
}
double head(const Real& x) {
  return static_cast<double>(x);
}
template <class M>
double head(const oracles::Ball<M>& x) {
  return x.head();
}
}  // namespace

struct Bands::Edge {
  Real exact;
  oracles::DoubleDouble rounded;  ///< to a relative 2^-106
  explicit Edge(const Real& x);
  template <class T>
  T as() const;
};
Bands::~Bands() = default;

Bands::Edge::Edge(const Real& x) : exact(x), rounded{head(x), 0} {
  rounded.low = head(x - rounded.high);
}
/// A power of two is exact as a ball.
template <class T>
T Bands::Edge::as() const {
  if constexpr (std::is_same_v<T, Real>)
    return exact;
  else if constexpr (std::is_same_v<T, oracles::DoubleDoubleBall>)
    return {rounded, rounded.low == 0 ? 0 : 0x1p-105 * rounded.high};
  else
    return {rounded.high, 2 * std::fabs(rounded.low)};
}

const Bands& Bands::of(const oracles::Scalar& scalar) {
  static const Bands of_float(-126, 24), of_double(-1022, 53);
  return scalar.is_float() ? of_float : of_double;
}

// min_exponent: 2^min_exponent is the smallest normal number.
Bands::Bands(int min_exponent, int digits) {
  const auto push = [this](std::string name, Axis axis, double low, double high,
                           Region region = Region::to_pi) {
    bands_.push_back({std::move(name), axis, low, high, region});
    return bands_.size() - 1;
  };
  const int precision = static_cast<int>(std::floor(digits * std::log10(2.0)));  // 7, 15
  push("all", Axis::none, 0, 0);

  first_theta_ = push("0", Axis::theta, 0, 0);
  Real low(0);
  const auto push_theta = [&](std::string name, const Real& high) {
    push(std::move(name), Axis::theta, head(low), head(high));
    theta_edges_.emplace_back(high);
    low = high;
  };
  const Real smallest_normal = ldexp(Real(1), min_exponent);
  push_theta("subnormal", smallest_normal);
  push_theta("theta^2 underflows", sqrt(smallest_normal));

  const int lowest = static_cast<int>(floor(log10(low)));
  const int first_decade = std::max(lowest, -(precision + 5));
  std::vector<int> exponents;
  for (int e : {-1000, -100, -50})
    if (e > lowest && e < first_decade - 5) exponents.push_back(e);
  for (int e = first_decade; e <= 0; ++e) exponents.push_back(e);
  int low_exponent = lowest;
  for (int e : exponents)
    if (const Real high = power_of_ten(e); high > low) {
      push_theta(fmt::format("theta 1e{}..1e{}", low_exponent, e), high);
      low_exponent = e;
    }

  generic_ = push("generic 1..pi-1", Axis::none, 1, head(pi() - 1));
  first_pi_ = bands_.size();
  for (int e = 0; e > -(precision + 1); --e) {
    push(fmt::format("pi-theta 1e{}..1e{}", e - 1, e), Axis::pi_minus_theta, std::pow(10.0, e - 1),
         std::pow(10.0, e));
    pi_edges_.emplace_back(power_of_ten(e - 1));
  }
  pi_ = push("pi", Axis::pi_minus_theta, 0, bands_.back().low);
  beyond_ = push("beyond pi", Axis::none, 3.2, 6.2, Region::beyond_pi);
  near_2pi_ = push("near 2pi k", Axis::none, 6.2, 100, Region::beyond_pi);
  huge_ = push("huge", Axis::none, 100, 0, Region::beyond_pi);
}

template <class T>
std::size_t Bands::classify(const T& theta) const {
  static const T pi_value = Edge(pi()).as<T>();
  if (theta == T(0)) return first_theta_;
  if (theta <= T(1)) {
    // The nearest doubles give the next edge above; exact numbers or balls confirm it.
    const auto above = std::upper_bound(theta_edges_.begin(), theta_edges_.end(), head(theta),
                                        [](double x, const Edge& e) { return x < e.rounded.high; });
    auto i = static_cast<std::size_t>(above - theta_edges_.begin());
    while (i > 0 && theta < theta_edges_[i - 1].as<T>()) --i;
    while (i < theta_edges_.size() && theta >= theta_edges_[i].as<T>()) ++i;
    return std::min<std::size_t>(first_theta_ + 1 + i, generic_ - 1);
  }
  const T pi_minus_theta = pi_value - theta;
  if (pi_minus_theta > T(1)) return generic_;
  if (pi_minus_theta >= T(0)) {
    for (std::size_t i = 0; i < pi_edges_.size(); ++i)
      if (pi_minus_theta >= pi_edges_[i].as<T>()) return first_pi_ + i;
    return pi_;
  }
  if (theta > T(100)) return huge_;
  const T periods = theta / (T(2) * pi_value);
  const double nearest = std::nearbyint(head(periods));
  if (nearest >= 1 && abs(periods - T(nearest)) * T(2) * pi_value < T(1) / T(10)) return near_2pi_;
  return beyond_;
}
template std::size_t Bands::classify(const Real&) const;
template std::size_t Bands::classify(const oracles::DoubleBall&) const;
template std::size_t Bands::classify(const oracles::DoubleDoubleBall&) const;

}  // namespace liecheck::properties
