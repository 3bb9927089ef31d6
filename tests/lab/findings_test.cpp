// A record of the league is data: it starts no program and chooses no path.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <support/files.hpp>

#include "../scratch.hpp"

namespace liecheck::properties {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// A library `name`, started by `adapter`, with one failing cell whose program prints what the adapter returned.
json library(const std::string& name, const std::string& adapter, const std::string& run) {
  const json failure = {
      {"what", "wrong"},
      {"where", "everywhere"},
      {"guess", ""},
      {"failed", 1},
      {"cases", 2},
      {"text",
       "  input  1\n    Q[0]  got  0.5  expected 1\n  as lib's own program:\n\nprint(0.5)\n\n"
       "  replay liecheck replay g4.1.exp_oracle.lib.double.none.1\n"}};
  const json cell = {{"operation", "exp3_quaternion"},
                     {"scalar", "double"},
                     {"cases", 2},
                     {"worst_eps", 1e9},
                     {"grade", "D"},
                     {"ns", 1},
                     {"bands", json::array()},
                     {"failure", failure}};
  return {{"name", name}, {"version", "1"}, {"language", "Python"}, {"adapter", adapter},
          {"run", run},   {"get", ""},      {"cells", {cell}}};
}

class FindingsOfARecord : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(dir);
    fs::create_directories(dir + "in");
    write_whole(dir + "list.json", json::array({row("echo listed", "python3 {file}")}).dump());
  }
  static json row(const std::string& adapter, const std::string& run) {
    return {{"name", "lib"}, {"language", "Python"}, {"adapter", adapter}, {"get", ""}, {"run", run}};
  }
  struct Run {
    int code;
    std::string text;
  };
  Run findings(const json& record, const std::string& flags = "") {
    write_whole(dir + "in/r.json", record.dump());
    const int status = std::system(
        ("cd " + dir + "in && " LIECHECK_LAB " league findings r.json --out o --adapters ../list.json " +
         flags + " >../text 2>&1")
            .c_str());
    return {WEXITSTATUS(status), read_whole(dir + "text")};
  }
  static json record(const json& library) {
    return {{"league", 1}, {"date", "2026-01-01"}, {"libraries", {library}}};
  }
  /// Everything below the folder, without what the test itself wrote.
  std::string written() const {
    std::set<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(dir))
      if (const std::string name = fs::relative(entry.path(), dir).string();
          entry.is_regular_file() && name != "in/r.json" && name != "list.json" && name != "text")
        files.insert(name);
    std::string all;
    for (const std::string& name : files) all += name + "\n";
    return all;
  }

  const std::string dir = scratch() + "findings/";
};

TEST_F(FindingsOfARecord, StartNoCommandThatTheListOfAdaptersDoesNotHave) {
  const std::pair<const char*, const char*> commands[] = {{"touch by_adapter", "python3 {file}"},
                                                          {"echo listed", "touch by_run; echo 0.5"},
                                                          {"echo listed; touch by_adapter", "python3 {file}"},
                                                          {"", "python3 {file}"},
                                                          {"echo listed", "python3 {file} "}};
  for (const auto& [adapter, run] : commands) {
    const Run r = findings(record(library("lib", adapter, run)));
    EXPECT_EQ(r.code, 2) << r.text;
    EXPECT_NE(r.text.find("r.json: the library 'lib' has commands"), r.text.npos) << r.text;
    EXPECT_NE(r.text.find(std::string("adapter '") + adapter + "', run '" + run), r.text.npos) << r.text;
    EXPECT_EQ(written(), "") << adapter << run;
  }
}

TEST_F(FindingsOfARecord, RunNoProgramThatTheListedAdapterDoesNotPrint) {
  json all = record(library("lib", "echo listed", "python3 {file}"));
  std::string text = all["libraries"][0]["cells"][0]["failure"]["text"];
  for (const std::string id :
       {"g4.1.exp_oracle.lib.double.none.1", "--adapter=touch${IFS}by_replay.a.b.c", "", "-"}) {
    std::string other = text;
    all["libraries"][0]["cells"][0]["failure"]["text"] =
        other.replace(other.find("replay g4"), std::string::npos, "replay " + id + "\n");
    const Run r = findings(all);
    EXPECT_EQ(r.code, 0) << r.text;
    EXPECT_NE(r.text.find("no finding: lib_exp3_quaternion: its adapter prints another program"), r.text.npos)
        << r.text;
    EXPECT_EQ(written(), "");
  }
}

TEST_F(FindingsOfARecord, RunWhatTheRecordSaysIfThatIsAskedFor) {
  const Run r = findings(record(library("lib", "false", "python3 {file}")), "--run-recorded");
  EXPECT_EQ(r.code, 0) << r.text;
  EXPECT_NE(r.text.find("1 findings in o"), r.text.npos) << r.text;
  EXPECT_EQ(written(), "in/o/lib_exp3_quaternion.md\nin/o/lib_exp3_quaternion.py\n");
}

TEST_F(FindingsOfARecord, RunInAFolderOfTheirOwnFromWhichNothingElseIsImported) {
  fs::create_directories(dir + "in/o");
  write_whole(dir + "in/o/json.py", "open('ran', 'w')");
  const std::string run = "ls $(dirname {file}) >../listed; python3 {file}";
  EXPECT_EQ(findings(record(library("lib", "false", run)), "--run-recorded").code, 0);
  EXPECT_EQ(read_whole(dir + "listed"), "lib_exp3_quaternion.py\n");
}

TEST_F(FindingsOfARecord, StayInTheirFolderAndShowNoControlCharacters) {
  const std::string names[] = {"../../x", "/etc/x", "..", "a\x1b[2Jb", std::string("a\0b", 3)};
  for (const std::string& name : names) {
    fs::remove_all(dir + "in/o");
    const Run r = findings(record(library(name, "false", "python3 {file}")), "--run-recorded");
    EXPECT_EQ(r.code, 0) << r.text;
    EXPECT_EQ(r.text.find('\x1b'), r.text.npos) << r.text;
    for (const auto& entry : fs::recursive_directory_iterator(dir))
      if (entry.is_regular_file() && entry.path().filename().string().find("exp3") != std::string::npos) {
        EXPECT_EQ(entry.path().parent_path().string(), dir + "in/o") << name;
        EXPECT_FALSE(entry.path().filename().string().starts_with('.')) << name;
      }
  }
}

TEST_F(FindingsOfARecord, OfNamesThatBecomeOneFileNameAreFilesOfTheirOwn) {
  json all = record(library("a/b", "false", "python3 {file}"));
  all["libraries"].push_back(library("a?b", "false", "python3 {file}"));
  EXPECT_EQ(findings(all, "--run-recorded").code, 0);
  const std::string stem = "in/o/a_b_exp3_quaternion";
  EXPECT_EQ(written(), stem + ".md\n" + stem + ".py\n" + stem + "_.md\n" + stem + "_.py\n");
}

TEST_F(FindingsOfARecord, AreNotWrittenThroughALink) {
  for (const std::string ending : {".py", ".md"}) {
    fs::remove_all(dir + "in/o");
    fs::create_directories(dir + "in/o");
    fs::create_symlink("../../outside", dir + "in/o/lib_exp3_quaternion" + ending);
    const Run r = findings(record(library("lib", "false", "touch ran; python3 {file}")), "--run-recorded");
    EXPECT_EQ(r.code, 2);
    EXPECT_NE(r.text.find("o/lib_exp3_quaternion" + ending + ": is a link out of the folder"), r.text.npos)
        << r.text;
    EXPECT_EQ(written(), "");
  }
}

TEST_F(FindingsOfARecord, AreTextInTheirPage) {
  json all = record(library("lib", "false", "python3 {file}"));
  json& failure = all["libraries"][0]["cells"][0]["failure"];
  failure["guess"] = "<script>alert(1)</script>[x](http://x)";
  failure["text"] = "  input  1\n  ```\n# a heading\n    Q[0]  got  0.5  expected 1\n" +
                    failure["text"].get<std::string>().substr(10);
  EXPECT_EQ(findings(all, "--run-recorded").code, 0);
  const std::string page = read_whole(dir + "in/o/lib_exp3_quaternion.md");
  EXPECT_EQ(page.find("<script"), page.npos) << page;
  EXPECT_EQ(page.find("[x]"), page.npos) << page;
  EXPECT_NE(page.find("\n````\n  input"), page.npos) << page;
}

TEST_F(FindingsOfARecord, NameTheMemberThatIsMissingOrOfAnotherType) {
  const json whole = record(library("lib", "echo listed", "python3 {file}"));
  const std::pair<json::json_pointer, json> changes[] = {
      {json::json_pointer("/date"), 3},
      {json::json_pointer("/libraries"), "text"},
      {json::json_pointer("/libraries/0"), 7},
      {json::json_pointer("/libraries/0/run"), json::array()},
      {json::json_pointer("/libraries/0/cells"), nullptr},
      {json::json_pointer("/libraries/0/cells/0/grade"), 1},
      {json::json_pointer("/libraries/0/cells/0/failure"), "text"},
      {json::json_pointer("/libraries/0/cells/0/failure/text"), 5},
      {json::json_pointer("/libraries/0/cells/0/bands"), {1}}};
  for (const auto& [where, value] : changes) {
    json broken = whole;
    broken[where] = value;
    const Run r = findings(broken);
    EXPECT_EQ(r.code, 2) << where.to_string();
    EXPECT_EQ(r.text.rfind("liecheck: r.json: ", 0), 0U) << r.text;
    EXPECT_NE(r.text.find(" has no "), r.text.npos) << r.text;
    EXPECT_EQ(r.text.find("json.exception"), r.text.npos) << r.text;
    EXPECT_EQ(written(), "");
  }
}

}  // namespace
}  // namespace liecheck::properties
