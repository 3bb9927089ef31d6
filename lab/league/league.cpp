#include <league/league.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <support/files.hpp>
#include <support/markdown.hpp>
#include <support/read_json.hpp>
#include <support/text.hpp>
#include <tuple>

namespace liecheck::properties::league {

namespace {

using nlohmann::json;

double value(const json& x) {
  return x.is_number() ? x.get<double>() : std::numeric_limits<double>::infinity();
}

/// Whether a band of an operation says something about the question.
bool concerns(const std::string& question, const json& cell, const json& band) {
  const std::string axis = band["axis"], name = band["band"], operation = cell["operation"];
  const double low = band["low"], high = band["high"];
  if (question == "near-zero") return axis == "theta" && high <= 1.5e-3;
  if (question == "near-pi") return (axis == "pi_minus_theta" && high <= 1.5e-3) || name == "pi";
  if (question == "1e-8") return axis == "theta" && low <= 1e-8 && 1e-8 <= high;
  const bool any_norm = operation.ends_with("_any_norm") || operation == "normalize";
  return any_norm == (question == "off-unit");
}

Answer answer(const json& library, const std::string& scalar, const std::string& question) {
  Answer a{library["name"], library["version"], library["language"], scalar, "", "", 0, 0, 0};
  std::uint64_t bad = 0;
  for (const json& cell : library["cells"]) {
    if (cell["scalar"] != scalar) continue;
    bool seen = false;
    for (const json& band : cell["bands"]) {
      if (!concerns(question, cell, band)) continue;
      seen = true;
      bad += band["bad"].get<std::uint64_t>();
      const double eps = band["bad"] > 0 ? std::numeric_limits<double>::infinity() : value(band["eps"]);
      if (eps > a.eps || a.worst_operation.empty())
        a.eps = std::max(a.eps, eps), a.worst_operation = cell["operation"];
    }
    if (seen) ++a.operations, a.ns += cell["ns"].get<double>();
  }
  if (a.operations > 0) a.ns /= a.operations;
  a.grade = bad ? "F" : a.eps <= 64 ? "A" : a.eps <= 1e4 ? "B" : a.eps <= 1e8 ? "C" : "D";
  return a;
}

const json* cell_of(const json& library, const json& like) {
  for (const json& cell : library["cells"])
    if (cell["operation"] == like["operation"] && cell["scalar"] == like["scalar"]) return &cell;
  return nullptr;
}

const json* library_of(const json& record, const json& name) {
  for (const json& library : record["libraries"])
    if (library["name"] == name) return &library;
  return nullptr;
}

/// "F (12 cases without a right result)" or "B (812 eps)"
std::string standing(const json& cell) {
  return fmt::format("{} ({})", markdown(cell["grade"]),
                     cell["grade"] == "F" ? "NaN, wrong branch or no result"
                                          : fmt::format("{:.3g} eps", value(cell["worst_eps"])));
}

/// Checks the members of a record, which somebody else may have written.
class RecordCheck {
 public:
  explicit RecordCheck(const std::string& file) : file_(file) {}
  void record(const json& record) const {
    texts(record, "the record", {"date"});
    lists(record, "the record", {"libraries"});
    std::set<std::string> names;
    for (const json& library : record["libraries"]) {
      texts(library, "a library", {"name", "version", "language", "adapter", "run"});
      const std::string name = printable(library["name"]);
      lists(library, name, {"cells"});
      if (library.contains("repaired"))
        need(library, name, "repaired", "true or false", [](const json& x) { return x.is_boolean(); });
      once(names, name, "the record");
      std::set<std::string> cells;
      for (const json& c : library["cells"])
        cell(c, name),
            once(cells, fmt::format("{} in {}", printable(c["operation"]), c["scalar"].dump()), name);
    }
  }

 private:
  void once(std::set<std::string>& seen, const std::string& name, const std::string& where) const {
    if (!seen.insert(name).second)
      throw std::invalid_argument(fmt::format("{}: {} has '{}' twice", file_, where, name));
  }
  void cell(const json& c, const std::string& library) const {
    texts(c, "a cell of " + library, {"operation"});
    const std::string name = fmt::format("{} of {}", printable(c["operation"]), library);
    lists(c, name, {"bands"}), numbers(c, name, {"ns"}), counts(c, name, {"cases"}),
        error(c, name, "worst_eps");
    words(c, name, "grade", {"A", "B", "C", "D", "F"}), words(c, name, "scalar", {"float", "double"});
    need(c, name, "failure", "object", [](const json& x) { return x.is_object() || x.is_null(); });
    for (const json& band : c["bands"])
      texts(band, name, {"band"}), words(band, name, "axis", {"theta", "pi_minus_theta", "none"}),
          numbers(band, name, {"low", "high"}), counts(band, name, {"bad"}), error(band, name, "eps");
    if (c.contains("replay"))
      need(c, name, "replay", "line of liecheck replay",
           [](const json& x) { return x.is_string() && (x == "" || is_replay(x)); });
    if (const json& failure = c["failure"]; failure.is_object())
      texts(failure, name, {"what", "where", "guess", "text"}), counts(failure, name, {"failed", "cases"}),
          failure.contains("because") ? texts(failure, name, {"because"}) : void();
  }
  using Names = std::initializer_list<const char*>;
  void texts(const json& of, const std::string& where, Names names) const {
    for (const char* n : names) need(of, where, n, "text", [](const json& x) { return x.is_string(); });
  }
  void numbers(const json& of, const std::string& where, Names names) const {
    for (const char* n : names) need(of, where, n, "number", [](const json& x) { return x.is_number(); });
  }
  void counts(const json& of, const std::string& where, Names names) const {
    for (const char* n : names)
      need(of, where, n, "count", [](const json& x) { return x.is_number_unsigned(); });
  }
  void lists(const json& of, const std::string& where, Names names) const {
    for (const char* n : names) need(of, where, n, "list", [](const json& x) { return x.is_array(); });
  }
  void words(const json& of, const std::string& where, const char* name,
             const std::vector<json>& known) const {
    need(of, where, name, "known word", [&](const json& x) { return std::ranges::count(known, x) == 1; });
  }
  /// An infinite error is the text "inf" or, in an earlier record, null.
  void error(const json& of, const std::string& where, const char* name) const {
    need(of, where, name, "error",
         [](const json& x) { return x.is_null() || x == "inf" || (x.is_number() && x.get<double>() >= 0); });
  }
  void need(const json& of, const std::string& where, const char* name, const char* kind,
            const auto& is_right) const {
    if (!of.is_object() || !of.contains(name) || !is_right(of[name]))
      throw std::invalid_argument(fmt::format("{}: {} has no {} '{}'", file_, where, kind, name));
  }

  const std::string& file_;
};

}  // namespace

std::string built_in_roster() {
  return (std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path() /
          "adapters/league.json")
      .string();
}

std::vector<Entry> read_roster(const std::string& file) {
  std::vector<Entry> all;
  const json list = read_json(file);
  if (!list.is_array())
    throw std::invalid_argument(file + ": is no list of adapters: it must begin with '['");
  members_of(file, "list of adapters", [&] {
    for (const json& e : list) {
      if (std::ranges::find(all, e.at("name").get<std::string>(), &Entry::name) != all.end())
        throw std::invalid_argument(fmt::format("{}: has '{}' twice", file, e.at("name").get<std::string>()));
      all.push_back({e.at("name"), e.at("language"), e.at("adapter"), e.at("get"), e.at("run"),
                     e.value("robot", ""), e.value("root", "free-flyer"), e.value("repaired", false),
                     e.value("limits", "")});
      for (const std::string& named : {all.back().adapter, all.back().robot, all.back().limits})
        keep_files(named, "a file that the list of adapters names");
    }
  });
  return all;
}

json read_league(const std::string& file) {
  json record = read_json(file);
  if (!record.is_object() || !record.contains("league") || record["league"] != 1 ||
      !record.contains("libraries"))
    throw std::invalid_argument(
        fmt::format("{}: is no record of the league, which `liecheck lab league --record` writes", file));
  RecordCheck(file).record(record);
  return record;
}

std::vector<Answer> answers(const json& record, const std::string& question) {
  std::vector<Answer> all;
  for (const json& library : record["libraries"])
    for (const char* scalar : {"double", "float"})
      if (Answer a = answer(library, scalar, question); a.operations > 0) all.push_back(a);
  std::ranges::sort(all, [&](const Answer& a, const Answer& b) {
    if (question == "1kHz")
      return std::tuple(a.grade == "F", a.ns, a.library) < std::tuple(b.grade == "F", b.ns, b.library);
    return std::tuple(a.grade, a.eps, a.library) < std::tuple(b.grade, b.eps, b.library);
  });
  return all;
}

std::string changes(const json& before, const json& after) {
  std::string text =
      fmt::format("# What changed between {} and {}\n\n", markdown(before["date"]), markdown(after["date"]));
  for (const json& library : after["libraries"]) {
    const json* const old = library_of(before, library["name"]);
    const std::string name = markdown(library["name"]), version = markdown(library["version"]);
    if (!old) {
      text += fmt::format("## {} {}\n\nThe earlier record does not have it.\n\n", name, version);
      continue;
    }
    std::string lines;
    for (const json& cell : library["cells"]) {
      const std::string what =
          fmt::format("- {} in {}: ", markdown(cell["operation"]), markdown(cell["scalar"]));
      const json* const was = cell_of(*old, cell);
      if (!was)
        lines += what + "newly offered, " + standing(cell) + "\n";
      else if ((*was)["grade"] != cell["grade"])
        lines += fmt::format("{}{} became {}\n", what, standing(*was), standing(cell));
      else if (const double a = value((*was)["worst_eps"]), b = value(cell["worst_eps"]);
               std::max(a, b) > 64 && std::max(a, b) > 2 * std::min(a, b))
        lines += fmt::format("{}{:.3g} eps became {:.3g} eps\n", what, a, b);
    }
    for (const json& cell : (*old)["cells"])
      if (!cell_of(library, cell))
        lines += fmt::format("- {} in {}: no longer offered\n", markdown(cell["operation"]),
                             markdown(cell["scalar"]));
    const std::string was = markdown((*old)["version"]);
    if (was != version || !lines.empty())
      text += fmt::format(
          "## {} {} → {}\n\n{}\n", name, was, version,
          lines.empty() ? "No grade changed, and no error by more than a factor of two.\n" : lines);
  }
  for (const json& library : before["libraries"])
    if (!library_of(after, library["name"]))
      text += fmt::format("## {}\n\nThe later record does not have it.\n\n", markdown(library["name"]));
  if (text.find("## ") == text.npos) text += "Nothing.\n";
  return text;
}

}  // namespace liecheck::properties::league
