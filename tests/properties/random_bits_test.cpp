#include <gtest/gtest.h>
#include <generators/random_bits.hpp>
#include <set>

namespace liecheck::properties {
namespace {

TEST(RandomBits, AreThoseOfSplitMix64) {
  Source source({0, 0, 0, 0});  // the first numbers from state 0, as published with the generator
  EXPECT_EQ(source.bits(), 0xe220a8397b1dcdafu);
  EXPECT_EQ(source.bits(), 0x6e789e6aa1b965f4u);
  EXPECT_EQ(source.bits(), 0x06c45d188009454fu);
}

TEST(RandomBits, OfNeighbouringCasesAreIndependent) {
  std::set<std::uint64_t> seen;
  constexpr std::size_t cases = 2000, numbers = 20;
  int ones = 0;  // bits that differ in the first numbers of neighbours: 32 of 64 are expected
  for (std::uint64_t i = 0; i < cases; ++i) {
    Source a({7, 8, 9, i}), b({7, 8, 9, i + 1});
    ones += __builtin_popcountll(a.bits() ^ b.bits());
    Source c({7, 8, 9, i});
    for (std::size_t k = 0; k < numbers; ++k) seen.insert(c.bits());
  }
  EXPECT_EQ(seen.size(), cases * numbers);
  EXPECT_NEAR(ones / static_cast<double>(cases), 32, 0.6);  // the standard deviation is 4 / sqrt(2000) = 0.09
}

}  // namespace
}  // namespace liecheck::properties
