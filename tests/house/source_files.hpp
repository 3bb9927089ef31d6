#pragma once
// The files of the project, for the tests of its structure.

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace liecheck::house {

namespace fs = std::filesystem;

/// Path from the project's top -> text.
using Files = std::map<std::string, std::string>;

inline fs::path top() {
  return LIECHECK_SOURCE_DIR;
}

inline std::string read(const fs::path& p) {
  std::ifstream f(p);
  std::ostringstream text;
  text << f.rdbuf();
  return text.str();
}

inline bool is_source(const fs::path& p) {
  return p.extension() == ".hpp" || p.extension() == ".cpp";
}

/// The sources of some folders.
inline Files sources(const std::vector<std::string>& folders) {
  Files all;
  for (const std::string& folder : folders)
    for (const auto& entry : fs::recursive_directory_iterator(top() / folder))
      if (is_source(entry.path())) all[fs::relative(entry.path(), top()).string()] = read(entry.path());
  return all;
}

}  // namespace liecheck::house
