// The commands on the pages: their flags exist, and README.md shows a failure as the program prints it.

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <regex>
#include <sstream>
#include <string>

namespace liecheck::properties {
namespace {

const std::string root = LIECHECK_FIXTURES "/../";

std::string read(const std::string& path) {
  std::ifstream file(root + path);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What the program prints on its standard output.
std::string output_of(const std::string& arguments) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(
      popen(("'" LIECHECK_PROGRAM "' " + arguments + " 2>/dev/null").c_str(), "r"), pclose);
  std::string text;
  for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get())) text += static_cast<char>(c);
  return text;
}

const std::string& help_of(const std::string& command) {
  static std::map<std::string, std::string> all;
  const auto [at, is_new] = all.try_emplace(command);
  if (is_new) at->second = output_of(command + " --help");
  return at->second;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (auto at = text.find(what); at != text.npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

/// "campaign --rules" for each flag of each call of liecheck that its command does not have. In a table, the
/// alternatives are separated by "\\|".
std::vector<std::string> unknown_flags(const std::string& text) {
  static const std::regex call("liecheck ((?:(?:adapter|bench|scene) )?[a-z-]+)([^\n;|`)]*)"),
      flag("[ \\[](--[a-z-]+)");
  const std::string calls = replaced(replaced(text, "\\\n", " "), "\\|", " ");
  std::vector<std::string> unknown;
  for (std::sregex_iterator c(calls.begin(), calls.end(), call), end; c != end; ++c) {
    const std::string command = (*c)[1], arguments = (*c)[2];
    for (std::sregex_iterator f(arguments.begin(), arguments.end(), flag); f != end; ++f)
      if (!std::regex_search(help_of(command), std::regex((*f)[1].str() + "(?![a-z-])")))
        unknown.push_back(command + " " + (*f)[1].str());
  }
  return unknown;
}

TEST(Pages, UseFlagsThatExist) {
  std::vector<std::string> pages{"README.md", "install/ci/Containerfile", "install/ci/workflow.yml"};
  for (const auto& page : std::filesystem::directory_iterator(root + "docs"))
    pages.push_back("docs/" + page.path().filename().string());
  EXPECT_GT(pages.size(), 12u);
  for (const std::string& page : pages)
    for (const std::string& flag : unknown_flags(read(page))) ADD_FAILURE() << page << ": liecheck " << flag;
}

TEST(Pages, ThatUseUnknownFlagsAreFound) {
  EXPECT_EQ(
      unknown_flags("x\nliecheck campaign --seed 1 --no-such-flag \\\n  --cases 3 --or-this | tee --that\n"),
      (std::vector<std::string>{"campaign --no-such-flag", "campaign --or-this"}));
  EXPECT_EQ(
      unknown_flags("| `liecheck bench speed [--for 1s \\| --for-each 1s] [--seed N]` | `--not-a-flag` |"),
      std::vector<std::string>{"bench speed --for"});
}

TEST(Pages, TheReadmeShowsAFailureAsTheProgramPrintsIt) {
  const std::string text = read("README.md"), begin = "```text\n$ build/release/bin/liecheck ";
  const auto at = text.find(begin);
  ASSERT_NE(at, text.npos);
  std::istringstream shown(text.substr(at + begin.size(), text.find("```\n", at + 1) - at - begin.size()));
  std::string arguments;
  std::getline(shown, arguments);
  const std::string printed = "\n" + output_of(arguments);
  std::size_t from = 0;
  int lines = 0;
  for (std::string line; std::getline(shown, line); ++lines) {
    const auto found = printed.find("\n" + line + "\n", from);
    ASSERT_NE(found, printed.npos) << "not printed, or not in this order: " << line;
    from = found + 1;
  }
  EXPECT_GT(lines, 5);
}

}  // namespace
}  // namespace liecheck::properties
