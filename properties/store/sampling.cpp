#include <store/sampling.hpp>

#include <fmt/format.h>
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

/// Whether so many of the marked cases are in the second sample, of m cases, that chance cannot explain it. Fisher's
/// exact test, one-sided: the hypergeometric distribution.
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

/// One-sided two-sample test of Kolmogorov and Smirnov: P(D > d) -> exp(-2 d^2 n m / (n + m)).
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

}  // namespace

std::vector<std::string> worse_by_more_than_chance(const Row& was, const Row& is) {
  std::vector<std::string> all;
  if (too_many(was.failed, was.judged(), is.failed, is.judged()))
    all.push_back(fmt::format("failed {} of {} cases, were {} of {}", is.failed, is.judged(), was.failed,
                              was.judged()));
  if (shifted(was.errors, is.errors))
    for (const double q : {0.5, 0.99})
      if (const double from = was.errors.quantile(q), to = is.errors.quantile(q); grown(from, to))
        all.push_back(fmt::format("{} error [eps] {:.4g}, was {:.4g}",
                                  q == 0.5 ? "median" : "99 % quantile of the", to, from));
  const double largest = was.errors.quantile(1);
  std::uint64_t above = 0;
  for (const auto& [bin, count] : is.errors.bins())
    if (grown(largest, std::exp2(bin / 32.0))) above += count;
  if (was.errors.count() > 0 && too_many(0, was.errors.count(), above, is.errors.count()))
    all.push_back(fmt::format("{} of {} errors [eps] are above {:.4g}, the largest of {} before", above,
                              is.errors.count(), largest, was.errors.count()));
  return all;
}

}  // namespace liecheck::properties
