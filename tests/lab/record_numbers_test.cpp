// How a record stores numbers that are not finite, and the verdict of a bench of known bugs.

#include <gtest/gtest.h>

#include <limits>
#include <results/bench.hpp>
#include <support/json_number.hpp>

namespace liecheck::properties {
namespace {

TEST(RecordNumbers, ThatAreNotFiniteAreStrings) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(number(0.1), 0.1);
  EXPECT_EQ(number(std::nan("")), "nan");
  EXPECT_EQ(number(infinity), "inf");
  EXPECT_EQ(number(-infinity), "-inf");
  EXPECT_TRUE(number_or_null(std::nan("")).is_null());
  EXPECT_EQ(number_or_null(infinity), "inf");
  EXPECT_EQ(numbers(std::vector<double>{1, -infinity}).dump(), "[1.0,\"-inf\"]");
}

TEST(RecordOfKnownBugs, PassesIfEveryBugAndNoLookAlikeIsKilled) {
  BugBench bench;
  bench.rows.resize(2);
  bench.rows[0].name = "bug:a", bench.rows[0].killed = true;
  bench.rows[1].name = "alike:b";
  EXPECT_EQ(record_of(bench)["verdict"], "incomplete");
  bench.complete = true;
  EXPECT_EQ(record_of(bench)["verdict"], "pass");
  bench.rows[1].killed = true;
  EXPECT_EQ(record_of(bench)["verdict"], "fail");
  bench.rows[1].killed = bench.rows[0].killed = false;
  EXPECT_EQ(record_of(bench)["verdict"], "fail");
  EXPECT_EQ(record_of(bench)["bugs"].size(), 2u);
}

}  // namespace
}  // namespace liecheck::properties
