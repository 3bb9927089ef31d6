// Each folder ("room") of lib, properties and reports may include only rooms above it in a list. No files
// include each other in a cycle.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "source_files.hpp"

namespace liecheck::house {
namespace {

struct Room {
  std::string name;
  std::vector<std::string> may_include;  ///< only rooms above it in the list, so that there is no cycle
};

/// lib/liecheck and scenes/liecheck; includes start with "liecheck/".
const std::vector<Room> library = {
    {"text", {}},
    {"scalar", {}},
    {"spatial", {"scalar"}},
    {"multibody", {"scalar", "spatial"}},
    {"algorithms", {"scalar", "spatial", "multibody"}},
    {"batch", {"scalar", "spatial", "multibody", "algorithms"}},
    {"urdf", {"text", "scalar", "spatial", "multibody"}},
    {"liecheck.hpp",
     {"spatial", "multibody", "algorithms", "urdf"}},  // the header of all that most programs need
    // scenes/liecheck: the library does not know it.
    {"scene", {"text", "scalar", "spatial", "multibody", "algorithms"}},
    {"scene_file", {"text", "scalar", "spatial", "multibody", "algorithms", "scene", "urdf"}},
};

/// properties, reports and lab; "lib" is any room of the library. Oracles that used lib would share its errors.
const std::vector<Room> harness = {
    {"lib", {}},
    {"support", {}},
    {"oracles", {}},
    {"operations", {}},
    {"conventions", {"oracles", "operations"}},
    {"generators", {"oracles"}},
    {"budgets", {"support", "operations", "generators"}},
    {"subjects", {"lib", "support", "oracles", "operations"}},
    {"invariants", {"lib", "support", "oracles", "operations", "generators", "subjects"}},
    {"adapters", {"support", "operations", "conventions", "subjects", "invariants"}},
    {"campaign",
     {"lib", "support", "oracles", "operations", "generators", "budgets", "subjects", "invariants"}},
    {"search", {"support", "oracles", "operations", "generators", "subjects", "invariants", "campaign"}},
    {"hard_cases",
     {"support", "oracles", "operations", "conventions", "generators", "subjects", "invariants", "campaign"}},
    {"failures",
     {"lib", "support", "oracles", "operations", "conventions", "generators", "budgets", "subjects",
      "invariants", "adapters", "campaign", "search", "hard_cases"}},
    {"rules", {"support", "generators", "budgets", "invariants", "campaign", "hard_cases"}},
    {"laws",
     {"support", "generators", "subjects", "invariants", "adapters", "campaign", "search", "hard_cases",
      "failures"}},
    {"store", {"support", "campaign", "search", "hard_cases", "failures"}},
    {"timing",
     {"lib", "support", "oracles", "operations", "conventions", "generators", "subjects", "invariants",
      "adapters"}},
    {"scenes", {"lib", "support", "oracles", "timing"}},
    {"environments",
     {"support", "generators", "budgets", "subjects", "invariants", "adapters", "campaign", "hard_cases"}},
    {"tellings", {"support", "generators", "budgets", "invariants", "campaign", "failures"}},
    {"record",
     {"lib", "support", "oracles", "operations", "generators", "budgets", "subjects", "invariants",
      "campaign", "search", "hard_cases", "failures", "store", "timing", "scenes"}},
    {"reports", {"support"}},
    {"app", {"lib",        "support",      "oracles",    "operations", "conventions", "generators",
             "budgets",    "subjects",     "invariants", "adapters",   "campaign",    "search",
             "hard_cases", "failures",     "rules",      "store",      "timing",      "scenes",
             "tellings",   "environments", "record",     "reports"}},
    // The rooms of lab: no room above may include them.
    {"bugs",
     {"support", "oracles", "operations", "budgets", "subjects", "invariants", "campaign", "hard_cases",
      "failures"}},
    {"correct", {"oracles", "operations", "subjects"}},
    {"history",
     {"support", "oracles", "operations", "budgets", "subjects", "invariants", "campaign", "hard_cases",
      "bugs"}},
    {"lattice",
     {"support", "oracles", "operations", "generators", "subjects", "invariants", "campaign", "search"}},
    {"coefficients", {"lib", "support", "oracles", "generators", "budgets"}},
    {"rounding",
     {"lib", "support", "operations", "conventions", "generators", "subjects", "invariants", "timing"}},
    {"wide", {"lib", "oracles", "operations", "subjects", "invariants", "timing"}},
    {"integrators", {"lib", "support", "oracles", "timing", "scenes"}},
    {"horizons", {"support", "oracles", "operations", "subjects", "campaign", "scenes", "integrators"}},
    {"bounds", {"lib", "support", "budgets", "campaign", "hard_cases"}},
    {"league",
     {"support", "operations", "conventions", "generators", "budgets", "subjects", "invariants", "adapters",
      "campaign", "search", "hard_cases", "failures", "tellings"}},
    {"results",
     {"support", "oracles", "record", "history", "lattice", "coefficients", "bounds", "integrators"}},
    {"lab_app",
     {"lib",      "support",    "oracles",     "operations",   "conventions", "generators", "budgets",
      "subjects", "invariants", "adapters",    "campaign",     "search",      "hard_cases", "failures",
      "store",    "timing",     "tellings",    "record",       "reports",     "app",        "bugs",
      "correct",  "history",    "lattice",     "coefficients", "rounding",    "horizons",   "bounds",
      "league",   "results",    "integrators", "wide",         "scenes"}},
};

const Room* find(const std::vector<Room>& rooms, const std::string& name) {
  const auto at = std::find_if(rooms.begin(), rooms.end(), [&](const Room& r) { return r.name == name; });
  return at == rooms.end() ? nullptr : &*at;
}

/// Whether the room stands in lab: below "app" in the list.
bool is_of_lab(const std::string& room) {
  return find(harness, room) > find(harness, "app");
}

/// The folder in `path` after `prefix`; empty if `path` does not start with `prefix` or has no further slash.
std::string folder_after(const std::string& prefix, const std::string& path) {
  const auto end = path.find('/', prefix.size());
  return path.rfind(prefix, 0) == 0 && end != path.npos ? path.substr(prefix.size(), end - prefix.size())
                                                        : "";
}

std::vector<std::string> includes_of(const std::string& text) {
  static const std::string keyword = "#include ";
  std::vector<std::string> all;
  for (auto at = text.find(keyword); at != text.npos; at = text.find(keyword, at)) {
    const bool line_start = at == 0 || text[at - 1] == '\n';
    at += keyword.size();
    if (line_start) all.push_back(text.substr(at + 1, text.find_first_of(">\"\n", at + 1) - at - 1));
  }
  return all;
}

/// The includes of a file that the order of the rooms forbids.
std::vector<std::string> violations(const std::string& path, const std::string& text) {
  std::vector<std::string> bad;
  const bool of_scenes = path.rfind("scenes/", 0) == 0, of_library = path.rfind("lib/", 0) == 0 || of_scenes;
  const std::string own = path == "lib/liecheck/liecheck.hpp" ? "liecheck.hpp"
                          : of_scenes                         ? folder_after("scenes/liecheck/", path)
                          : of_library                        ? folder_after("lib/liecheck/", path)
                          : path.rfind("reports/", 0) == 0    ? "reports"
                          : path.rfind("lab/app/", 0) == 0    ? "lab_app"
                          : path.rfind("lab/", 0) == 0        ? folder_after("lab/", path)
                                                              : folder_after("properties/", path);
  const Room* room = find(of_library ? library : harness, own);
  const bool of_lab = path.rfind("lab/", 0) == 0;
  const bool wrong_folder = of_library && of_scenes != (own == "scene" || own == "scene_file");
  if (!room || wrong_folder || (path.rfind("properties/", 0) == 0 && is_of_lab(own)) ||
      (of_lab && !is_of_lab(own)))
    return {path + " is in no room of this test"};
  for (const std::string& include : includes_of(text)) {
    const std::string lib_room = folder_after("liecheck/", include), other = folder_after("", include);
    if (include.find("lab/") != include.npos && !of_lab) bad.push_back(path + " includes " + include);
    if (lib_room.empty() && !find(harness, other)) continue;  // a header of another project
    const std::string to = of_library ? lib_room : lib_room.empty() ? other : "lib";
    // What reads a text computes nothing that a law judges.
    if (!of_library && lib_room == "text" && own != "oracles") continue;
    const auto& allowed = room->may_include;
    if (to != own && std::find(allowed.begin(), allowed.end(), to) == allowed.end())
      bad.push_back(path + " includes " + include);
  }
  return bad;
}

TEST(Rooms, AreInAnOrderWithoutCycles) {
  for (const auto* rooms : {&library, &harness}) {
    std::set<std::string> before;
    for (const Room& room : *rooms) {
      for (const std::string& other : room.may_include)
        EXPECT_TRUE(before.count(other)) << room.name << " includes " << other << ", which is not above it";
      before.insert(room.name);
    }
  }
}

TEST(Rooms, EveryFileIncludesOnlyWhatItsRoomMay) {
  const Files files = sources({"lib", "scenes", "properties", "reports", "lab"});
  EXPECT_GT(files.size(), 200u);
  for (const auto& [path, text] : files)
    for (const std::string& v : violations(path, text)) ADD_FAILURE() << v;
}

TEST(Rooms, ForbiddenIncludesAreFound) {
  const auto count = [](const char* path, const char* include) {
    return violations(path, "#pragma once\n#include <" + std::string(include) + ">\n").size();
  };
  EXPECT_EQ(count("properties/oracles/a.cpp", "liecheck/spatial/se3.hpp"), 1u);
  EXPECT_EQ(count("properties/oracles/a.cpp", "subjects/typed.hpp"), 1u);
  EXPECT_EQ(count("properties/campaign/a.cpp", "store/store.hpp"), 1u);
  EXPECT_EQ(count("properties/campaign/a.cpp", "reports/report.hpp"), 1u);
  EXPECT_EQ(count("properties/record/a.cpp", "app/command.hpp"), 1u);
  EXPECT_EQ(count("properties/support/a.cpp", "campaign/campaign.hpp"), 1u);
  EXPECT_EQ(count("properties/a.cpp", "support/text.hpp"), 1u);
  EXPECT_EQ(count("properties/elsewhere/a.cpp", "support/text.hpp"), 1u);
  EXPECT_EQ(count("reports/a.cpp", "campaign/campaign.hpp"), 1u);
  EXPECT_EQ(count("properties/subjects/a.cpp", "bugs/planted_bugs.hpp"), 1u);
  EXPECT_EQ(count("properties/app/a.cpp", "history/history.hpp"), 1u);
  EXPECT_EQ(count("properties/app/a.cpp", "../../lab/app/lab_commands.hpp"), 1u);
  EXPECT_EQ(count("properties/history/a.cpp", "support/text.hpp"), 1u);
  EXPECT_EQ(count("lab/campaign/a.cpp", "support/text.hpp"), 1u);
  EXPECT_EQ(count("lab/history/a.cpp", "bugs/planted_bugs.hpp"), 0u);
  EXPECT_EQ(count("lab/app/a.cpp", "app/command.hpp"), 0u);
  EXPECT_EQ(count("lib/liecheck/spatial/a.hpp", "liecheck/multibody/model.hpp"), 1u);
  EXPECT_EQ(count("lib/liecheck/multibody/a.hpp", "oracles/exp.hpp"), 1u);
  EXPECT_EQ(count("scenes/liecheck/scene/a.cpp", "liecheck/urdf/urdf.hpp"), 1u);
  EXPECT_EQ(count("lib/liecheck/algorithms/a.hpp", "liecheck/scene/tree.hpp"), 1u);
  EXPECT_EQ(count("lib/liecheck/scene/a.cpp", "liecheck/spatial/se3.hpp"), 1u);
  EXPECT_EQ(count("properties/oracles/a.cpp", "liecheck/text/from_chars.hpp"), 1u);
  EXPECT_EQ(count("properties/budgets/a.cpp", "liecheck/text/from_chars.hpp"), 0u);
  EXPECT_EQ(count("scenes/liecheck/urdf/a.cpp", "liecheck/text/text_file.hpp"), 1u);
  EXPECT_EQ(count("scenes/liecheck/scene_file/a.cpp", "liecheck/urdf/urdf.hpp"), 0u);
  EXPECT_EQ(count("lib/liecheck/urdf/a.cpp", "Eigen/Core"), 0u);
  EXPECT_EQ(count("properties/campaign/a.cpp", "invariants/property.hpp"), 0u);
}

/// Groups of files that include each other, directly or indirectly. x.hpp and x.cpp count as one file, "x".
std::vector<std::string> cycles(const Files& files) {
  std::map<std::string, std::set<std::string>> arrows;
  const auto unit = [](const std::string& path) { return path.substr(0, path.rfind('.')); };
  for (const auto& [path, text] : files)
    for (const std::string& include : includes_of(text))
      for (const std::string& candidate :
           {"lib/" + include, "scenes/" + include, "properties/" + include, "lab/" + include, include,
            (fs::path(path).parent_path() / include).lexically_normal().string()})
        if (files.count(candidate) && unit(candidate) != unit(path))
          arrows[unit(path)].insert(unit(candidate));
  std::map<std::string, std::set<std::string>> reached;
  for (const auto& [from, unused] : arrows) {
    std::vector<std::string> open{from};
    while (!open.empty()) {
      const std::string at = open.back();
      open.pop_back();
      if (const auto next = arrows.find(at); next != arrows.end())
        for (const std::string& to : next->second)
          if (reached[from].insert(to).second) open.push_back(to);
    }
  }
  std::set<std::string> all;
  for (const auto& [from, to] : reached) {
    if (!to.count(from)) continue;
    std::string group;
    for (const std::string& other : to)
      if (reached[other].count(from)) group += (group.empty() ? "" : ", ") + other;
    all.insert(group);
  }
  return {all.begin(), all.end()};
}

TEST(Includes, HaveNoCycle) {
  for (const std::string& group : cycles(sources({"lib", "scenes", "properties", "reports", "lab"})))
    ADD_FAILURE() << "these include each other: " << group;
}

TEST(Includes, ACycleIsFound) {
  Files files{{"lib/liecheck/urdf/a.hpp", "#include <liecheck/urdf/b.hpp>\n"},
              {"lib/liecheck/urdf/b.hpp", ""},
              {"lib/liecheck/urdf/b.cpp", "#include <liecheck/urdf/b.hpp>\n"}};
  EXPECT_TRUE(cycles(files).empty());
  files["lib/liecheck/urdf/b.cpp"] += "#include <liecheck/urdf/a.hpp>\n";
  EXPECT_EQ(cycles(files), std::vector<std::string>{"lib/liecheck/urdf/a, lib/liecheck/urdf/b"});
}

/// The includes by which `path` sees a header that starts with one of `what`, directly or through headers of the
/// project: "a.cpp > b.hpp > Eigen/Core"; "" if it sees none.
std::string way_to(const Files& files, const std::string& path, const std::vector<std::string>& what) {
  std::vector<std::pair<std::string, std::string>> open{{path, path}};
  std::set<std::string> seen{path};
  for (std::size_t i = 0; i < open.size(); ++i)
    for (const std::string& include : includes_of(files.at(open[i].first))) {
      const std::string way = open[i].second + " > " + include;
      if (std::any_of(what.begin(), what.end(), [&](const auto& w) { return include.starts_with(w); }))
        return way;
      for (const char* folder : {"properties/", "lab/", "lib/", "scenes/", ""})
        if (const std::string file = folder + include; files.count(file) && seen.insert(file).second)
          open.emplace_back(file, way);
    }
  return "";
}

const std::vector<std::string> numerical{"Eigen/", "unsupported/Eigen/", "boost/"};

TEST(Includes, OfFilesThatComputeNothingReachNoNumericalLibrary) {
  const std::set<std::string> may{
      "properties/app/report_command.cpp",  // has the kernels' modules loaded
      "properties/app/robot_command.cpp",   // reads URDFs, as the next files read scenes
      "properties/app/scene_explain_command.cpp",
      "properties/app/scene_keys_command.cpp",
      "properties/app/scene_run_command.cpp",
      "properties/record/scene_run.cpp",
      "properties/record/worst_cases.cpp",  // exact results of worst cases
      "properties/campaign/error_map.cpp",  // these make and measure inputs
      "properties/campaign/robots.cpp",
      "properties/campaign/selection.cpp",
      "properties/campaign/series.cpp",
      "properties/rules/rules.cpp"};  // a digest of the inputs that laws generate
  const Files files = sources({"lib", "scenes", "properties", "reports", "lab"});
  std::set<std::string> reach;
  for (const auto& [path, text] : files)
    for (const char* folder :
         {"properties/app/", "properties/store/", "properties/record/", "properties/campaign/",
          "properties/rules/", "properties/support/", "reports/"})
      if (path.starts_with(folder)) {
        const std::string way = way_to(files, path, numerical);
        if (!way.empty()) reach.insert(path);
        EXPECT_TRUE(way.empty() || may.count(path)) << way;
      }
  EXPECT_EQ(reach, may);
}

TEST(Includes, OfTheCommandLineAndOfJsonAreInTheseFilesAlone) {
  const std::vector<std::pair<std::string, std::string>> may{
      {"CLI/", "properties/app/ lab/app/"},
      {"nlohmann/json.hpp",
       "reports/ properties/support/ properties/adapters/ properties/environments/ properties/tellings/ "
       "properties/app/lab.cpp properties/app/compare_command.cpp properties/app/write_record.cpp "
       "properties/app/report_command.cpp properties/app/environments_command.cpp "
       "properties/app/adapter_tellings_command.cpp properties/store/beside_cases.cpp "
       "properties/store/export.cpp "
       "properties/store/times.cpp "
       "properties/hard_cases/ lab/"}};
  for (const auto& [header, where] : may)
    for (const auto& [path, text] : sources({"lib", "scenes", "properties", "reports", "lab"}))
      for (const std::string& include : includes_of(text))
        if (include.starts_with(header)) {
          bool listed = false;
          std::istringstream places(where);
          for (std::string place; places >> place;) listed = listed || path.starts_with(place);
          EXPECT_TRUE(listed) << path << " includes " << include;
        }
}

TEST(Includes, AWayToANumericalLibraryIsFound) {
  const Files files{{"properties/app/a.cpp", "#include <string>\n#include <store/b.hpp>\n"},
                    {"properties/store/b.hpp", "#include <vector>\n#include <Eigen/Core>\n"}};
  EXPECT_EQ(way_to(files, "properties/app/a.cpp", numerical),
            "properties/app/a.cpp > store/b.hpp > Eigen/Core");
  EXPECT_EQ(way_to(files, "properties/app/a.cpp", {"boost/"}), "");
}

TEST(Commands, PrintTextOfOthersWithoutControlCharacters) {
  // By say() and warn(). These files print colours, of which say() would make text.
  const std::set<std::string> coloured{"properties/app/campaign_command.cpp",
                                       "properties/app/failure_table.cpp"};
  for (const auto& [path, text] : sources({"properties/app", "lab/app"}))
    if (!coloured.contains(path)) EXPECT_EQ(text.find("fmt::print("), text.npos) << path;
}

TEST(TheHarness, HasOnlyFoldersAtItsRoot) {
  for (const char* folder : {"properties", "lab"})
    for (const auto& entry : fs::directory_iterator(top() / folder))
      EXPECT_TRUE(entry.is_directory() || entry.path().filename() == "CMakeLists.txt") << entry.path();
}

TEST(Readme, QuotesTheCommandThatContinuousIntegrationRuns) {
  const std::string ci = read(top() / ".ci/run");
  const auto at = ci.find("apt-get update");
  ASSERT_NE(at, std::string::npos);
  const std::string line = ci.substr(at, ci.find('\n', at) - at);
  EXPECT_NE(read(top() / "README.md").find(line), std::string::npos) << line;
}

}  // namespace
}  // namespace liecheck::house
