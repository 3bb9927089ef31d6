// docs/ci.md quotes the files of install/ci.

#include <gtest/gtest.h>

#include "pages.hpp"

namespace liecheck::properties {
namespace {

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
