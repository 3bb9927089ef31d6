#include <gtest/gtest.h>
#include <campaign/histogram.hpp>
#include <random>

namespace liecheck::properties {
namespace {

std::vector<double> errors(std::size_t n) {
  std::mt19937_64 random(5);
  std::vector<double> x;
  while (x.size() < n) {
    const auto k = random() % 16;
    const double mantissa = 1 + static_cast<double>(random() % 4096) / 4096;
    const auto at = [&](int widest) {
      return std::ldexp(mantissa, static_cast<int>(random() % (2 * widest)) - widest);
    };
    x.push_back(k == 0   ? 0
                : k == 1 ? std::numeric_limits<double>::infinity()
                : k == 2 ? at(1000)  // outside the window
                         : at(8));
  }
  return x;
}

TEST(Histogram, IsTheSameInEveryOrderAndAfterMerging) {
  const std::vector<double> x = errors(20000);
  Histogram forward, backward, parts[2], merged, read;
  for (std::size_t i = 0; i < x.size(); ++i) {
    forward.add(x[i]), backward.add(x[x.size() - 1 - i]), parts[i % 2].add(x[i]);
    if (i % 777 == 0) {
      EXPECT_FALSE(forward.bins().empty());  // bins() also adds the buffered values to the bins
    }
  }
  merged.merge(parts[1]), merged.merge(parts[0]);
  for (const auto& [bin, n] : forward.bins()) read.add_bin(bin, n);
  for (const Histogram* h : {&backward, &merged, &read}) {
    EXPECT_EQ(h->bins(), forward.bins());
    EXPECT_EQ(h->count(), x.size());
  }
  std::uint64_t all = 0;
  for (const auto& [bin, n] : forward.bins()) all += n;
  EXPECT_EQ(all, x.size());
  EXPECT_TRUE(std::is_sorted(forward.bins().begin(), forward.bins().end()));
}

TEST(Histogram, HasTheQuantilesToOneBin) {
  std::vector<double> x = errors(20000);
  Histogram h;
  for (const double e : x) h.add(e);
  std::sort(x.begin(), x.end());
  for (const double q : {0.02, 0.1, 0.3, 0.5, 0.8, 0.9}) {
    const double exact = x[static_cast<std::size_t>(std::ceil(q * static_cast<double>(x.size()))) - 1];
    EXPECT_GE(h.quantile(q), exact);
    EXPECT_LE(h.quantile(q), exact * 1.0220) << q;
  }
}

}  // namespace
}  // namespace liecheck::properties
