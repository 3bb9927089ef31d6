// Every relative link and anchor of a page, and every page that a file names, exists.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <regex>
#include <set>

#include "../scratch.hpp"
#include "source_files.hpp"

namespace liecheck::house {
namespace {

/// The text of a page without what is shown as it stands: blocks between ``` or indented by four, and `code`.
std::string prose(const std::string& text) {
  static const std::regex code("`[^`\n]*`");
  std::istringstream stream(text);
  std::string all;
  bool fenced = false, blank = true;
  for (std::string line; std::getline(stream, line); blank = line.empty())
    if (line.starts_with("```"))
      fenced = !fenced;
    else if (!fenced && !(blank && line.starts_with("    ")))
      all += line + "\n";
  return std::regex_replace(all, code, "`");
}

/// The anchors of a page: its headings in lower case, without punctuation, with hyphens for spaces. A heading
/// that occurs again gets a number.
std::set<std::string> anchors(const std::string& page) {
  std::set<std::string> all;
  std::istringstream stream(page);
  bool fenced = false;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("```")) fenced = !fenced;
    const auto words = line.find_first_not_of('#');
    if (fenced || words == 0 || words == line.npos || line[words] != ' ') continue;
    std::string anchor;
    for (const char letter : line.substr(words + 1))
      if (const auto c = static_cast<unsigned char>(letter); c == ' ')
        anchor += '-';
      else if (std::isalnum(c) || c == '-' || c == '_' || c >= 0x80)
        anchor += static_cast<char>(std::tolower(c));
    const std::string first = anchor;
    for (int again = 1; !all.insert(anchor).second; ++again) anchor = first + "-" + std::to_string(again);
  }
  return all;
}

/// The links of a page, given by its path, that lead nowhere.
std::vector<std::string> broken_links(const fs::path& page, const std::string& text) {
  static const std::regex link("\\]\\(([^)#\\s]*)(#[^)\\s]*)?\\)");
  const std::string words = prose(text);
  std::vector<std::string> broken;
  for (std::sregex_iterator l(words.begin(), words.end(), link), end; l != end; ++l) {
    const std::string path = (*l)[1], anchor = (*l)[2];
    if (path.find("://") != path.npos) continue;
    const fs::path target = page.parent_path() / path;
    if ((!path.empty() && !fs::exists(target)) ||
        (!anchor.empty() && !anchors(path.empty() ? text : read(target)).count(anchor.substr(1))))
      broken.push_back(path + anchor);
  }
  return broken;
}

std::vector<fs::path> pages() {
  std::vector<fs::path> all{top() / "README.md", top() / "CHANGELOG.md"};
  for (const char* folder : {"docs", "fixtures"})
    for (const auto& entry : fs::recursive_directory_iterator(top() / folder))
      if (entry.path().extension() == ".md") all.push_back(entry.path());
  return all;
}

TEST(Links, LeadToFilesAndHeadingsThatExist) {
  EXPECT_GT(pages().size(), 10u);
  for (const fs::path& page : pages())
    for (const std::string& link : broken_links(page, read(page))) ADD_FAILURE() << page << ": " << link;
}

TEST(Links, ThatLeadNowhereAreFound) {
  const auto broken = [](const std::string& text) { return broken_links(top() / "docs/a.md", text); };
  EXPECT_TRUE(broken("# A b: c!\n[x](#a-b-c) [y](../README.md) [z](https://a.b/c#d) `[w](w.md)`\n").empty());
  EXPECT_TRUE(broken("# A\n# A\n[x](#a-1)\n```\n[y](y.md)\n```\n\n    [z](z.md)\n").empty());
  EXPECT_EQ(broken("# A\n```sh\n# B\n```\n[x](#b) [y](no.md)\n[z](../README.md#no-such-heading)\n"),
            (std::vector<std::string>{"#b", "no.md", "../README.md#no-such-heading"}));
}

TEST(Pages, ThatFilesNameExist) {
  static const std::regex page("\\bdocs/[a-z_]+\\.md");
  int named = 0;
  for (const auto& [path, text] : sources({"lib", "scenes", "properties", "adapters", "lab", "tests"}))
    for (std::sregex_iterator p(text.begin(), text.end(), page), end;
         p != end && !path.ends_with("links_test.cpp"); ++p, ++named)
      EXPECT_TRUE(fs::exists(top() / p->str())) << path << ": " << p->str();
  EXPECT_GT(named, 50);
}

TEST(Readme, HasAProgramThatCompilesWithoutWarnings) {
  const std::string text = read(top() / "README.md"), begin = "```cpp\n";
  const auto at = text.find(begin);
  ASSERT_NE(at, text.npos);
  const fs::path file = fs::path(liecheck::scratch()) / "liecheck_readme.cpp";
  std::ofstream(file) << text.substr(at + begin.size(), text.find("```\n", at + 1) - at - begin.size());
  EXPECT_EQ(std::system((LIECHECK_SYNTAX_CHECK " -Wall -Wextra -Werror '" + file.string() + "'").c_str()), 0);
}

TEST(Readme, CountsTheDefectsOfTheirPage) {
  static const std::regex count("[0-9]+ defects in [0-9]+ releases");
  std::smatch readme, page;
  const std::string front = read(top() / "README.md"), found = read(top() / "docs/found.md");
  ASSERT_TRUE(std::regex_search(front, readme, count));
  ASSERT_TRUE(std::regex_search(found, page, count));
  EXPECT_EQ(readme.str(), page.str());
}

TEST(Readme, HasAtMostAHundredLines) {
  const std::string text = read(top() / "README.md");
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 100);
}

}  // namespace
}  // namespace liecheck::house
