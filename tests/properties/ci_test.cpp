// docs/ci.md quotes the files of install/ci.

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

namespace liecheck::properties {
namespace {

const std::string root = LIECHECK_FIXTURES "/../";

std::string read(const std::string& path) {
  std::ifstream file(root + path);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
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

TEST(CiFiles, NameAVersionOfTheRulesInTheChanges) {
  EXPECT_NE(read("CHANGELOG.md").find("\n| 1 | 0.1 |\n"), std::string::npos);
}

}  // namespace
}  // namespace liecheck::properties
