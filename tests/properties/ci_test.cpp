// docs/ci.md quotes the files of install/ci, and the flags that they use exist.

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <regex>
#include <string>

namespace liecheck::properties {
namespace {

const std::string root = LIECHECK_FIXTURES "/../";

std::string read(const std::string& path) {
  std::ifstream file(root + path);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string help_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(
      popen(("'" LIECHECK_PROGRAM "' " + command + " --help").c_str(), "r"), pclose);
  std::string text;
  for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get())) text += static_cast<char>(c);
  return text;
}

/// "campaign --rules" for each flag of each call of liecheck that its command does not have.
std::vector<std::string> unknown_flags(std::string text) {
  static const std::regex call("liecheck ([a-z]+)([^\n;|`)]*)"), flag(" (--[a-z-]+)");
  for (auto at = text.find("\\\n"); at != text.npos; at = text.find("\\\n")) text.replace(at, 2, " ");
  std::vector<std::string> unknown;
  for (std::sregex_iterator c(text.begin(), text.end(), call), end; c != end; ++c) {
    const std::string arguments = (*c)[2], help = help_of((*c)[1]);
    for (std::sregex_iterator f(arguments.begin(), arguments.end(), flag); f != end; ++f)
      if (help.find((*f)[1]) == help.npos) unknown.push_back((*c)[1].str() + " " + (*f)[1].str());
  }
  return unknown;
}

TEST(CiFiles, AreThoseOfTheDocs) {
  const std::string docs = read("docs/ci.md");
  for (const auto& [language, file] :
       {std::pair{"dockerfile", "install/ci/Containerfile"}, {"yaml", "install/ci/workflow.yml"}}) {
    const std::string text = read(file);
    EXPECT_FALSE(text.empty());
    EXPECT_NE(docs.find(std::string("```") + language + "\n" + text + "```\n"), docs.npos)
        << "docs/ci.md does not quote " << file;
  }
}

TEST(CiFiles, UseFlagsThatExist) {
  for (const char* file : {"install/ci/Containerfile", "install/ci/workflow.yml", "docs/ci.md"})
    for (const std::string& flag : unknown_flags(read(file))) ADD_FAILURE() << file << ": liecheck " << flag;
  EXPECT_EQ(
      unknown_flags("x\nliecheck campaign --seed 1 --no-such-flag \\\n  --cases 3 --or-this | tee --that\n"),
      (std::vector<std::string>{"campaign --no-such-flag", "campaign --or-this"}));
}

TEST(CiFiles, NameAVersionOfTheRulesInTheChanges) {
  EXPECT_NE(read("CHANGELOG.md").find("\n| 1 | 0.1 |\n"), std::string::npos);
}

}  // namespace
}  // namespace liecheck::properties
