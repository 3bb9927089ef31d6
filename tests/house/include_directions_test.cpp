// Who may include whom, and that the README and CI say the same.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& p) {
  std::ifstream f(p);
  std::ostringstream text;
  text << f.rdbuf();
  return text.str();
}

/// The first folder of an include, after "liecheck/" where it is the library's: "scalar", "oracles", "reports".
std::string room(std::string include, bool& lib) {
  lib = include.rfind("liecheck/", 0) == 0;
  if (lib) include = include.substr(9);
  return include.substr(0, include.find('/'));
}

/// The includes of a file that its place in the house forbids.
std::vector<std::string> violations(const std::string& path, const std::string& text) {
  static const std::map<std::string, std::vector<std::string>> lib_rooms = {
      {"text", {"text"}},
      {"scalar", {"scalar"}},
      {"spatial", {"scalar", "spatial"}},
      {"multibody", {"scalar", "spatial", "multibody"}},
      {"algorithms", {"scalar", "spatial", "multibody", "algorithms"}},
      {"urdf", {"text", "scalar", "spatial", "multibody", "urdf"}},
      {"scene", {"scalar", "spatial", "multibody", "algorithms", "scene"}},
      {"scene_file",
       {"scalar", "spatial", "multibody", "algorithms", "scene", "text", "urdf", "scene_file"}}};
  static const std::vector<std::string> harness = {"generators", "oracles", "subjects", "invariants",
                                                   "campaign",   "timing",  "scenes",   "scene_peers"};
  const auto has = [](const auto& list, const std::string& x) {
    return std::find(list.begin(), list.end(), x) != list.end();
  };
  std::vector<std::string> bad;
  static const std::regex line(R"(#include\s*[<"]([^>"]+)[>"])");
  for (std::sregex_iterator i(text.begin(), text.end(), line), end; i != end; ++i) {
    const std::string include = (*i)[1];
    bool lib = false;
    const std::string r = room(include, lib);
    bool allowed = true;
    if (path.rfind("lib/liecheck/", 0) == 0) {
      const std::string own = path.substr(13, path.find('/', 13) - 13);
      allowed = lib ? lib_rooms.count(own) && has(lib_rooms.at(own), r) : !has(harness, r) && r != "reports";
    } else if (path.rfind("properties/oracles/", 0) == 0) {
      allowed = !lib && r != "reports" && (r == "oracles" || !has(harness, r));
    } else if (path.rfind("reports/", 0) == 0) {
      allowed = !lib && !has(harness, r);
    } else if (path.rfind("properties/", 0) == 0) {
      allowed = r != "reports" || path.rfind("properties/app/", 0) == 0;
    }
    if (!allowed) bad.push_back(path + " includes " + include);
  }
  return bad;
}

TEST(IncludeDirections, AreKeptByEveryFile) {
  const fs::path top = LIECHECK_SOURCE_DIR;
  int files = 0;
  for (const char* folder : {"lib", "properties", "reports"}) {
    for (const auto& entry : fs::recursive_directory_iterator(top / folder)) {
      const auto extension = entry.path().extension();
      if (extension != ".hpp" && extension != ".cpp") continue;
      ++files;
      for (const auto& v : violations(fs::relative(entry.path(), top).string(), read(entry.path())))
        ADD_FAILURE() << v;
    }
  }
  EXPECT_GT(files, 50);
}

TEST(IncludeDirections, ViolationsAreSeen) {
  EXPECT_EQ(violations("properties/oracles/a.cpp", "#include <liecheck/spatial/se3.hpp>\n").size(), 1u);
  EXPECT_EQ(violations("properties/oracles/a.cpp", "#include <subjects/subject.hpp>\n").size(), 1u);
  EXPECT_EQ(violations("lib/liecheck/spatial/a.hpp", "#include <liecheck/multibody/model.hpp>\n").size(), 1u);
  EXPECT_EQ(violations("lib/liecheck/multibody/a.hpp", "#include \"oracles/exp.hpp\"\n").size(), 1u);
  EXPECT_EQ(violations("reports/a.cpp", "#include <campaign/campaign.hpp>\n").size(), 1u);
  EXPECT_EQ(violations("properties/campaign/a.cpp", "#include <reports/report.hpp>\n").size(), 1u);
  EXPECT_EQ(violations("lib/liecheck/scene/a.cpp", "#include <liecheck/urdf/urdf.hpp>\n").size(), 1u);
  EXPECT_EQ(violations("lib/liecheck/algorithms/a.hpp", "#include <liecheck/scene/tree.hpp>\n").size(), 1u);
  EXPECT_TRUE(violations("lib/liecheck/scene_file/a.cpp", "#include <liecheck/urdf/urdf.hpp>\n").empty());
  EXPECT_TRUE(violations("lib/liecheck/urdf/a.cpp",
                         "#include <liecheck/multibody/model.hpp>\n#include <Eigen/Core>\n")
                  .empty());
}

TEST(Readme, SaysTheLineThatContinuousIntegrationRuns) {
  const fs::path top = LIECHECK_SOURCE_DIR;
  const std::string ci = read(top / ".ci/run");
  const auto at = ci.find("apt-get update");
  ASSERT_NE(at, std::string::npos);
  const std::string line = ci.substr(at, ci.find('\n', at) - at);
  EXPECT_NE(read(top / "README.md").find(line), std::string::npos) << line;
}

}  // namespace
