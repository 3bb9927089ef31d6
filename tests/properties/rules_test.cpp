// Rules stay what they were: the digests of fixtures/rules, and what a pinned campaign runs.

#include <gtest/gtest.h>

#include <algorithm>
#include <rules/rules.hpp>

#include "../refusal.hpp"

namespace liecheck::properties {
namespace {

std::string joined(const std::vector<std::string>& lines) {
  std::string all;
  for (const std::string& line : lines) all += line + "\n";
  return all;
}
std::string error_of(const Rules& rules, const Rules& program) {
  return test::refusal([&] { check_runs(rules, program); });
}

TEST(Rules, OfThisProgramAreTheNewestVersion) {
  EXPECT_EQ(joined(differences(known_rules().back(), present_rules())), "")
      << "the rules of a verdict changed. docs/ci.md, section Rules, says what to do; a new version is "
         "written by\n"
         "  liecheck list --rules present > fixtures/rules/"
      << std::stoi(known_rules().back().version) + 1 << ".txt";
  for (const char* part : {"law exp_oracle", "law lagrange", "limits careful double", "limits ours float",
                           "hard case cutoff_1e-3_below"})
    EXPECT_TRUE(present_rules().parts.contains(part)) << part;
}

TEST(Rules, OfEveryKnownVersionStillRun) {
  for (const Rules& r : known_rules()) EXPECT_EQ(error_of(r, present_rules()), "");
}

TEST(Rules, AnOlderVersionRunsWithoutWhatIsNewAndIsRefusedAfterAChange) {
  const Rules old = present_rules();
  Rules program = old;
  program.parts["law new_law"] = program.parts["hard case new_case"] = "0123456789abcdef";
  EXPECT_EQ(error_of(old, program), "");
  EXPECT_EQ(joined(differences(old, program)),
            "hard case new_case: only in present\nlaw new_law: only in present\n");
  program.parts["limits careful double"] = "0123456789abcdef";
  EXPECT_NE(
      error_of(old, program).find("cannot judge by rules present any more (limits careful double: changed)"),
      std::string::npos)
      << error_of(old, program);
  program.parts.erase("law exp_oracle");
  EXPECT_NE(error_of(old, program).find("(law exp_oracle: only in present and 1 more)"), std::string::npos);
}

TEST(Rules, OfAnOlderVersionLeaveOutNewLawsAndNewHardCases) {
  Rules old = present_rules();
  old.parts.erase("law pose_group");
  old.parts.erase("hard case cutoff_1e-3_below");
  const auto laws = laws_of(old, {});
  EXPECT_EQ(laws.size() + 1, present_rules().names("law").size());
  EXPECT_EQ(std::ranges::count(laws, "pose_group"), 0);
  EXPECT_EQ(laws_of(old, {"log_oracle"}), (std::vector<std::string>{"log_oracle"}));
  EXPECT_THROW(laws_of(old, {"pose_group"}), std::invalid_argument);
  EXPECT_EQ(hard_cases_of(present_rules()).size(), built_in_corpus().size());
  EXPECT_EQ(hard_cases_of(old).size() + 1, built_in_corpus().size());
  EXPECT_EQ(std::ranges::count(hard_cases_of(old), "cutoff_1e-3_below", &HardCase::name), 0);
}

TEST(Rules, AreReadAsTheyAreWritten) {
  const Rules& present = present_rules();
  EXPECT_EQ(parse_rules("present.txt", present.text()).parts, present.parts);
  const auto laws = present.names("law");
  EXPECT_NE(std::ranges::find(laws, "exp_oracle"), laws.end());
  EXPECT_THROW(parse_rules("2.txt", "12 law x\n"), std::invalid_argument);
  EXPECT_THROW(rules_named("0"), std::invalid_argument);
  EXPECT_EQ(&rules_named("present"), &present);
}

}  // namespace
}  // namespace liecheck::properties
