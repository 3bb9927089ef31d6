// A reader of URDFs that says that it couples mimic joints is held to that. One that does not say so is never accused.

#include <gtest/gtest.h>
#include <adapters/subjects.hpp>
#include <filesystem>
#include <fstream>
#include <support/files.hpp>

#include "../campaigns.hpp"
#include "../scratch.hpp"
#include "../shell.hpp"

namespace liecheck::properties::adapters {
namespace {

namespace fs = std::filesystem;
const std::string rods = LIECHECK_FIXTURES "/scenes/tied_rods.urdf";
const std::vector<std::string> laws{"lagrange", "power_balance", "mass_matrix"};

/// The command of a copy of the example named `name`, whose description and reader have `from` replaced by `to`.
std::string reader(const std::string& name, bool says_so, const std::string& from = "",
                   const std::string& to = "") {
  const fs::path folder = fs::path(own_folder()) / name;
  fs::create_directories(folder);
  for (const char* file : {"adapter.py", "tree.py", "urdf.py"}) {
    std::string text = read_whole(LIECHECK_FIXTURES "/adapters/trees/" + std::string(file));
    const auto replace = [&](const std::string& old, const std::string& now) {
      if (const auto at = text.find(old); at != text.npos) text.replace(at, old.size(), now);
    };
    replace(R"("name": "trees")", R"("name": ")" + name + '"');
    if (!says_so) replace(R"(, "mimics"])", "]");
    if (!from.empty()) replace(from, to);
    std::ofstream(folder / file) << text;
  }
  return "/usr/bin/python3 -B -W ignore " + (folder / "adapter.py").string();
}

CampaignResult campaign(const std::string& command) {
  return run_quietly({{register_adapter(command)}, laws, {}}, 8, 1, load_robot(rods, true));
}
/// One case: a reader that expects another number of coordinates does not answer.
CampaignResult one_case(const std::string& command) {
  return run_quietly({{register_adapter(command)}, {"power_balance"}, {"double"}}, 1, 1,
                     load_robot(rods, true));
}

TEST(Mimics, AReaderThatCouplesThemIsHeldToIt) {
  const CampaignResult right = campaign(reader("couples", true));
  EXPECT_FALSE(right.failed);
  ASSERT_FALSE(right.series.empty());
  for (const auto& [series, tally] : right.series)
    for (const auto& [cell, row] : tally.rows) EXPECT_EQ(row.outside_domain, 0u) << series->property;
  EXPECT_TRUE(campaign(reader("loses_offset", true, R"(tie.get("offset", 0))", "0")).failed);
  EXPECT_TRUE(one_case(reader("drops_though", true, R"(own.find("mimic"))", "None")).failed);
}

TEST(Mimics, AReaderThatDoesNotSaySoIsNotAccused) {
  const CampaignResult drops = campaign(reader("drops", false, R"(own.find("mimic"))", "None"));
  EXPECT_FALSE(drops.failed);
  for (const auto& [series, tally] : drops.series)
    for (const auto& [cell, row] : tally.rows) EXPECT_EQ(row.outside_domain, 0u) << series->property;

  const CampaignResult couples = one_case(reader("couples_silently", false));
  EXPECT_FALSE(couples.failed);
  for (const auto& [series, tally] : couples.series)
    for (const auto& [cell, row] : tally.rows) EXPECT_EQ(row.outside_domain, row.count) << series->property;
}

TEST(Mimics, ThatAReaderDoesNotTakeAreARemark) {
  const auto said = [](const std::string& command, const std::string& robot) {
    return shell(LIECHECK_PROGRAM
                 " campaign --no-hard-cases --cases 2 --property lagrange --root fixed --robot " +
                 robot + " --adapter '" + command + "'")
        .text;
  };
  const std::string remark = "remark  drops reads tied_rods itself, which has mimic joints";
  const std::string drops = reader("drops", false, R"(own.find("mimic"))", "None");
  EXPECT_NE(said(drops, rods).find(remark), std::string::npos) << said(drops, rods);
  EXPECT_EQ(said(drops, LIECHECK_FIXTURES "/robots/quadruped.urdf").find("remark  drops"), std::string::npos);
  EXPECT_EQ(said(reader("couples", true), rods).find("mimic joints"), std::string::npos);
}

}  // namespace
}  // namespace liecheck::properties::adapters
