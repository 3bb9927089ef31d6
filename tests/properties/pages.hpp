#pragma once
// The pages README.md and docs/*.md, as their tests read them.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace liecheck::properties {

inline const std::string root = LIECHECK_FIXTURES "/../";

inline std::string read(const std::string& path) {
  std::ifstream file(root + path);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

inline std::vector<std::string> pages() {
  std::vector<std::string> all{"README.md"};
  for (const auto& page : std::filesystem::directory_iterator(root + "docs"))
    if (page.path().extension() == ".md") all.push_back("docs/" + page.path().filename().string());
  return all;
}

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (auto at = text.find(what); at != text.npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

/// A block of a page between ``` and ```.
struct CodeBlock {
  std::string language, text;
};
inline std::vector<CodeBlock> blocks_of(const std::string& page) {
  std::vector<CodeBlock> all;
  std::istringstream lines(page);
  bool inside = false;
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with("```")) {
      if (inside) all.back().text += line + "\n";
    } else if (inside = !inside; inside) {
      all.push_back({line.substr(3), ""});
    }
  return all;
}

}  // namespace liecheck::properties
