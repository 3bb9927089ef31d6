// The section of simulated scenes.

#include <gtest/gtest.h>

#include <reports/html.hpp>

#include "sample_record.hpp"

namespace {

using namespace liecheck::reports;

std::string complaint(const Json& s) {
  return refusal_of(with(record(), "/scenes", s));
}

TEST(ScenesReport, ShowsOrderFloorSpinFlipsPeersAndCosts) {
  ASSERT_EQ(complaint(scenes()), "");
  Merged merged;
  merged.records.push_back({{"scenes", scenes()}});
  const std::string page = scenes_section(merged);
  for (const char* text : {"4.003 over 5, float128; floor 2e-15", "5.00", "5e-17, lost", "34.8 s", "0.250",
                           "3.5 ns", "absent from this build", "data-films=\"[0]\"", "a&lt;b&gt;", "-2e-09"})
    EXPECT_TRUE(has(page, text)) << text;
  EXPECT_FALSE(has(page, "a<b>"));
  EXPECT_EQ(scenes_section({}), "");
}

TEST(ScenesReport, NamesTheFieldThatItRefuses) {
  Json s = scenes();
  s["films"][0]["frames"][0].push_back(s["films"][0]["frames"][0][0]);
  EXPECT_TRUE(has(complaint(s), "scenes.films[0].frames[0]: expected 1 entries"));
  EXPECT_TRUE(has(complaint(with(scenes(), "/scenes/0/orders/0/observed", "four")), "orders[0].observed"));
  EXPECT_TRUE(has(complaint(without(scenes(), "/spins/0/limit")), "limit is missing"));
}

}  // namespace
