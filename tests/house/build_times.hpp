#pragma once
// The log of compile times (precompiled/measured.c) and its judgement by a budget (build_budget.csv).

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace liecheck::house {

/// One compilation: CPU seconds of the compiler and its largest memory; from_ccache if ccache had the object.
struct Compilation {
  double seconds = 0, gigabytes = 0;
  bool from_ccache = false;
};

/// The last compilation of each object in a log. Throws std::runtime_error for a line that is none.
inline std::map<std::string, Compilation> compilations_in(std::istream& log) {
  std::map<std::string, Compilation> all;
  for (std::string line; std::getline(log, line);) {
    std::istringstream words(line);
    double seconds = 0, kilobytes = 0;
    std::string from, object;
    words >> seconds >> kilobytes >> from >> std::ws;
    if (!std::getline(words, object) || (from != "ccache" && from != "compiled"))
      throw std::runtime_error("a log of compile times has the line: " + line);
    all[object] = {seconds, kilobytes / 1e6, from == "ccache"};
  }
  return all;
}

/// The limits of a budget by their names. Throws std::runtime_error if one of the six is absent.
inline std::map<std::string, double> limits_in(std::istream& csv) {
  std::map<std::string, double> all;
  for (std::string line; std::getline(csv, line);)
    if (const auto comma = line.find(','); !line.starts_with('#') && !line.starts_with("what,"))
      all[line.substr(0, comma)] = std::stod(line.substr(comma + 1));
  for (const char* name : {"reference", "program", "report", "everything", "file", "memory"})
    if (!all.contains(name)) throw std::runtime_error(fmt::format("the budget has no row {}", name));
  return all;
}

inline bool is_reference(const std::string& object) {
  return object.ends_with("/reference.cpp.o");
}

/// An object without the folders that CMake adds: properties/CMakeFiles/liecheck.dir/app/main.cpp.o is
/// properties/app/main.cpp, and Unity/unity_laws_0_cxx.cxx.o of the same target is properties/laws/unity_laws_0.
inline std::string name_of(const std::string& object) {
  std::string name = object;
  if (const auto from = name.find("CMakeFiles/"); from != name.npos)
    if (const auto end = name.find(".dir/", from); end != name.npos) name.erase(from, end + 5 - from);
  if (const auto at = name.find("Unity/unity_"); at != name.npos) {
    const std::string group = name.substr(at + 6, name.rfind("_cxx.cxx") - at - 6);
    const std::string folder = group.substr(6, group.rfind('_') - 6);
    const std::string parent = name.substr(0, at);
    name = (parent == folder + "/" ? parent : parent + folder + "/") + group;
  }
  if (name.ends_with(".o")) name.resize(name.size() - 2);
  for (auto at = name.find("__/"); at != name.npos; at = name.find("__/")) name.replace(at, 3, "../");
  return std::filesystem::path(name).lexically_normal().string();
}

/// The three sets of objects with a budget.
struct Scopes {
  std::set<std::string> program, report, everything;
};

/// Why a log does not measure a build, or "": every object of the build and the reference must have been compiled.
inline std::string gap(const std::map<std::string, Compilation>& log, const Scopes& scopes) {
  if (scopes.program.empty() || scopes.report.empty()) return "the program has no objects";
  const auto measures = [](const auto& c) { return is_reference(c.first) && !c.second.from_ccache; };
  if (std::ranges::none_of(log, measures)) return "the reference is not in the log, or came from ccache";
  std::size_t absent = 0, cached = 0;
  std::string example;
  for (const std::string& object : scopes.everything) {
    const auto at = log.find(object);
    if (at != log.end() && !at->second.from_ccache) continue;
    ++(at == log.end() ? absent : cached);
    if (example.empty()) example = object;
  }
  if (absent + cached == 0) return "";
  return fmt::format("{} of {} objects are not in the log and {} came from ccache, for example {}", absent,
                     scopes.everything.size(), cached, example);
}

/// The table of a build by folders, its slowest files, and what is above the limits.
struct Judgement {
  std::string table;
  std::vector<std::string> exceeded;
};

inline Judgement judged(const std::map<std::string, Compilation>& log, const Scopes& scopes,
                        const std::map<std::string, double>& limits) {
  double references = 0, of_references = 0;
  for (const auto& [object, c] : log)
    if (is_reference(object) && !c.from_ccache) ++references, of_references += c.seconds;
  const double scale = limits.at("reference") * references / of_references;
  Judgement result;
  const auto check = [&](const std::string& name, const std::string& what, double value) {
    if (value > limits.at(name))
      result.exceeded.push_back(
          fmt::format("{}: {:.4g} is above the limit {:g}", what, value, limits.at(name)));
  };
  std::map<std::string, double> folders;
  std::vector<std::pair<double, std::string>> files;
  std::map<std::string, double> sums;
  for (const std::string& object : scopes.everything) {
    const Compilation& c = log.at(object);
    const double seconds = scale * c.seconds;
    if (is_reference(object)) continue;
    sums["everything"] += seconds;
    if (scopes.report.contains(object)) sums["report"] += seconds;
    if (scopes.program.contains(object)) sums["program"] += seconds;
    folders[std::filesystem::path(name_of(object)).parent_path().string()] += seconds;
    files.emplace_back(seconds, fmt::format("{} | {:.0f} | {:.2f}", name_of(object), seconds, c.gigabytes));
    check("file", name_of(object) + " [CPU seconds]", seconds);
    check("memory", name_of(object) + " [GB]", c.gigabytes);
  }
  result.table = "| what | CPU-minutes |\n|---|---|\n";
  for (const char* name : {"program", "report", "everything"}) {
    result.table += fmt::format("| {} | {:.1f} |\n", name, sums[name] / 60);
    check(name, std::string(name) + " [CPU seconds]", sums[name]);
  }
  std::vector<std::pair<double, std::string>> by_time;
  for (const auto& [folder, seconds] : folders) by_time.emplace_back(seconds, folder);
  std::ranges::sort(by_time, std::greater());
  std::ranges::sort(files, std::greater());
  result.table += "\n| folder | CPU-minutes | % |\n|---|---|---|\n";
  for (const auto& [seconds, folder] : by_time)
    result.table +=
        fmt::format("| {} | {:.2f} | {:.0f} |\n", folder, seconds / 60, 100 * seconds / sums["everything"]);
  result.table += "\n| file | CPU s | GB |\n|---|---|---|\n";
  for (std::size_t i = 0; i < std::min<std::size_t>(10, files.size()); ++i)
    result.table += "| " + files[i].second + " |\n";
  return result;
}

}  // namespace liecheck::house
