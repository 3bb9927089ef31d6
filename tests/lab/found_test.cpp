// docs/found.md is made from fixtures/league/found.json, and what that says is judged again. No library is needed: a test
// of the label league measures them.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <support/files.hpp>

#include "../scratch.hpp"

namespace liecheck::properties {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

class FoundDefects : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(dir);
    fs::create_directories(dir);
    write_whole(dir + "none.json", "[]");
  }
  struct Run {
    int code;
    std::string text;
  };
  /// Judges the record, as if no library were here.
  Run judged(const std::string& file) const {
    const int status = std::system((LIECHECK_LAB " league findings " + file + " --out " + dir +
                                    "out --adapters " + dir + "none.json >" + dir + "text 2>&1")
                                       .c_str());
    return {WEXITSTATUS(status), read_whole(dir + "text")};
  }
  /// Judges the record with one member of its first defect changed.
  Run changed(const std::string& member, const json& value) const {
    json record = whole;
    record["libraries"][0]["defects"][0][member] = value;
    write_whole(dir + "changed.json", record.dump());
    return judged(dir + "changed.json");
  }

  const std::string dir = scratch() + "found/", fixture = LIECHECK_FIXTURES "/league/found.json";
  const json whole = json::parse(read_whole(fixture));
};

TEST_F(FoundDefects, AreJudgedAsTheirRecordSaysAndThePageIsTheirs) {
  const Run r = judged(fixture);
  EXPECT_EQ(r.code, 0) << r.text;
  EXPECT_EQ(read_whole(dir + "out/found.json"), read_whole(fixture)) << "as league findings writes it";
  EXPECT_TRUE(read_whole(dir + "out/found.md") == read_whole(LIECHECK_FIXTURES "/../docs/found.md"))
      << "docs/found.md is not the page that league findings writes: copy " << dir << "out/found.md";
}

TEST_F(FoundDefects, AreAtLeastFortyInFifteenReleasesAndHaveShortPrograms) {
  std::size_t all = 0;
  for (const json& library : whole["libraries"])
    for (const json& d : library["defects"]) {
      const std::string program = d["program"];
      EXPECT_LE(std::ranges::count(program, '\n'), 12) << program;
      ++all;
    }
  EXPECT_GE(all, 40U);
  EXPECT_GE(whole["libraries"].size(), 15U);
}

TEST_F(FoundDefects, DifferWhereANumberOfTheirRecordIsChanged) {
  const json& first = whole["libraries"][0]["defects"][0];
  const std::string name = first["function"];
  json right = first["right"];
  right[0] = "0.5";
  for (const auto& [member, value] : {std::pair<const char*, json>{"right", right},
                                      {"lost", "1.0 of 15.7 digits lost"},
                                      {"shows", "nothing"},
                                      {"call", "another"}}) {
    const Run r = changed(member, value);
    EXPECT_EQ(r.code, 1) << r.text;
    EXPECT_NE(r.text.find("  " + name + ":\n    " + member + " is "), r.text.npos) << r.text;
  }
  json got = first["got"];
  got[0] = "0.5";
  EXPECT_EQ(changed("got", got).code, 1);
}

TEST_F(FoundDefects, AreRefusedWhereTheyAreNone) {
  const json& first = whole["libraries"][0]["defects"][0];
  const std::string where = dir + "changed.json, " + whole["libraries"][0]["adapter"].get<std::string>() +
                            ", " + first["function"].get<std::string>() + ": ";
  const auto refused = [&](const std::string& member, const json& value, const std::string& why) {
    const Run r = changed(member, value);
    EXPECT_EQ(r.code, 2) << r.text;
    EXPECT_NE(r.text.find(why), r.text.npos) << r.text;
  };
  refused("got", first["right"], where + first["operation"].get<std::string>() + " is within its limit");
  refused("got", {"1", "2"}, where + "'got' has 2 numbers: expected 1");
  refused("law", "exp_oracle", where + "the law 'exp_oracle' does not measure");
  refused("law", "no_law", where + "there is no law 'no_law'");
  refused("input", "a = 1, 0", "changed.json");
  refused("got", 1, "has no list 'got'");
  refused("got", {1}, "has a number in 'got' that is no text");
  refused("function", 1, "has no text 'function'");
  refused("scalar", "half", "has the scalar \"half\"");
  refused("block", 1, "has no text 'block'");
}

}  // namespace
}  // namespace liecheck::properties
