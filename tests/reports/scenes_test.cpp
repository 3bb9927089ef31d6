// The section of simulated scenes.

#include <gtest/gtest.h>

#include <reports/html.hpp>

#include "sample_record.hpp"

namespace {

using namespace liecheck::reports;

std::string complaint(const Json& s) {
  Json whole = record();
  whole["scenes"] = s;
  try {
    check_record("r.json", whole);
    return "";
  } catch (const std::runtime_error& e) {
    return e.what();
  }
}

TEST(ScenesReport, ShowsOrderFloorSpinFlipsPeersAndCosts) {
  ASSERT_EQ(complaint(scenes()), "");
  Merged merged;
  merged.records.push_back({{"scenes", scenes()}});
  const std::string page = scenes_section(merged);
  for (const char* text : {"4.003 over 5, float128; floor 2e-15", "5.00", "5e-17, lost", "34.8 s", "0.250",
                           "3.5 ns", "absent from this build", "data-films=\"[0]\"", "a&lt;b&gt;", "-2e-09"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
  EXPECT_EQ(page.find("a<b>"), std::string::npos);
  EXPECT_NE(scenes_section({}).find("hold no scenes"), std::string::npos);
}

TEST(ScenesReport, NamesTheFieldThatItRefuses) {
  Json s = scenes();
  s["films"][0]["frames"][0].push_back(s["films"][0]["frames"][0][0]);
  EXPECT_NE(complaint(s).find("scenes.films[0].frames[0]: expected 1 entries"), std::string::npos)
      << complaint(s);
  s = scenes();
  s["scenes"][0]["orders"][0]["observed"] = "four";
  EXPECT_NE(complaint(s).find("orders[0].observed"), std::string::npos);
  s = scenes();
  s["spins"][0].erase("limit");
  EXPECT_NE(complaint(s).find("limit is missing"), std::string::npos);
}

}  // namespace
