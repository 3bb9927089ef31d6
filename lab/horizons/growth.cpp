#include <horizons/horizon.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace liecheck::properties {

namespace {

/// The slope of y over x by least squares.
double slope(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / n,
               mean_y = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    xx += (x[i] - mean_x) * (x[i] - mean_x), xy += (x[i] - mean_x) * (y[i] - mean_y);
  return xy / xx;
}

/// Slopes fitted to simulated sums of independent errors, at these numbers of steps and with so many paths, in order.
std::vector<double> slopes_of_random_walks(const std::vector<double>& n, unsigned paths) {
  constexpr int walks = 2000;
  std::mt19937_64 random(42);
  std::normal_distribution<double> normal;
  std::vector<double> x, slopes;
  for (const double steps : n) x.push_back(std::log(steps));
  for (int walk = 0; walk < walks; ++walk) {
    std::vector<double> squares(n.size(), 0), y;
    for (unsigned path = 0; path < paths; ++path) {
      std::array<double, 3> angle{};
      for (std::size_t k = 0; k < n.size(); ++k)
        for (double& component : angle) {
          component += std::sqrt(n[k] - (k ? n[k - 1] : 0)) * normal(random);
          squares[k] += component * component;
        }
    }
    for (const double square : squares) y.push_back(std::log(square) / 2);
    slopes.push_back(slope(x, y));
  }
  std::ranges::sort(slopes);
  return slopes;
}

}  // namespace

void fit_growth(Horizon& h, unsigned paths) {
  std::vector<double> n, x, y;
  for (const HorizonPoint& p : h.points)
    if (p.n >= 1000 && p.attitude > 0 && std::isfinite(p.attitude))
      n.push_back(static_cast<double>(p.n)), x.push_back(std::log(n.back())),
          y.push_back(std::log(p.attitude));
  h.exponent = h.low = h.high = std::numeric_limits<double>::quiet_NaN();
  if (n.size() < 3) return;
  h.exponent = slope(x, y);
  const std::vector<double> slopes = slopes_of_random_walks(n, paths);
  h.low = h.exponent + 0.5 - slopes[slopes.size() * 39 / 40];
  h.high = h.exponent + 0.5 - slopes[slopes.size() / 40];
}

}  // namespace liecheck::properties
