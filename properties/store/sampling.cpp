#include <store/sampling.hpp>

#include <algorithm>
#include <cmath>

namespace liecheck::properties {

namespace {

/// log(1e9): a campaign has some 1e4 cells, so even a thousand comparisons find hardly anything by chance.
const double least_surprise = std::log(1e9);

/// log of n choose k.
double log_choose(std::uint64_t n, std::uint64_t k) {
  const auto factorial = [](std::uint64_t i) { return std::lgamma(static_cast<double>(i) + 1); };
  return factorial(n) - factorial(k) - factorial(n - k);
}

}  // namespace

bool too_many(std::uint64_t marked_a, std::uint64_t n, std::uint64_t marked_b, std::uint64_t m) {
  const std::uint64_t marked = marked_a + marked_b;
  if (marked_b == 0 || marked_b * (n + m) <= marked * m) return false;
  double chance = 0;
  for (std::uint64_t k = marked_b; k <= std::min(marked, m); ++k) {
    if (m - k > n + m - marked) continue;
    const double term =
        std::exp(log_choose(marked, k) + log_choose(n + m - marked, m - k) - log_choose(n + m, m));
    chance += term;
    if (term < 1e-6 * chance) break;
  }
  return -std::log(chance) > least_surprise;
}

bool shifted(const Histogram& a, const Histogram& b) {
  const auto n = static_cast<double>(a.count()), m = static_cast<double>(b.count());
  if (n == 0 || m == 0) return false;
  double below_a = 0, below_b = 0, d = 0;
  auto at = b.bins().begin();
  for (const auto& [bin, count] : a.bins()) {
    below_a += static_cast<double>(count) / n;
    for (; at != b.bins().end() && at->first <= bin; ++at) below_b += static_cast<double>(at->second) / m;
    d = std::max(d, below_a - below_b);
  }
  return 2 * d * d * n * m / (n + m) > least_surprise;
}

}  // namespace liecheck::properties
