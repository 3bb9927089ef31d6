#include <liecheck/scene_file/values.hpp>

#include <algorithm>
#include <filesystem>
#include <liecheck/scene_file/csv_table.hpp>
#include <liecheck/scene_file/scene_error.hpp>
#include <liecheck/scene_file/units.hpp>
#include <set>

namespace liecheck::scene_file_detail {
namespace {

using scene::Key;
using scene::Kind;
using scene::Value;

std::string kindOf(const YAML::Node& node) {
  if (node.IsSequence()) return "a list";
  if (node.IsMap()) return "a map";
  return node.IsScalar() ? "'" + node.Scalar().substr(0, 60) + "'" : "nothing";
}

}  // namespace

void Text::refuse(int line, const std::string& what) const {
  throw SceneError(file_, line, what);
}
int Text::lineOf(const YAML::Node& node) {
  const YAML::Mark mark = node.Mark();
  return mark.is_null() ? 0 : mark.line + 1;
}

void Text::checkKeys(const YAML::Node& node, const std::string& what,
                     const std::vector<std::string>& keys) const {
  if (!node.IsMap()) refuse(node, what + " is a map of keys and values, not " + kindOf(node));
  std::set<std::string> seen;
  for (const auto& entry : node) {
    if (!entry.first.IsScalar()) refuse(entry.first, "a key of " + what + " is " + kindOf(entry.first));
    const std::string key = entry.first.Scalar();
    place(entry.first, key, keys, what + " has no key '" + key + "'");
    if (!seen.insert(key).second)
      refuse(entry.first, "key '" + key + "' of " + what + " is given twice: keep one");
  }
}

std::size_t Text::place(const YAML::Node& node, const std::string& name,
                        const std::vector<std::string>& names, const std::string& unknown) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) refuse(node, unknown + nearestNames(name, names));
  return std::size_t(found - names.begin());
}

std::string Text::word(const YAML::Node& node, const std::string& what) const {
  if (!node.IsScalar() || node.Scalar().empty()) refuse(node, what + " is a word, not " + kindOf(node));
  for (const char c : node.Scalar())
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      refuse(node, what + " holds a control character or a line break: write one line of text");
  return node.Scalar();
}

std::string Text::path(const YAML::Node& node, const std::string& what) const {
  namespace fs = std::filesystem;
  const fs::path own = folder_.empty() ? "." : folder_,
                 path = own / word(node, what);  // the word if it is absolute
  std::error_code error;
  const fs::path real = fs::weakly_canonical(fs::absolute(path), error);
  const auto holds = [&](const fs::path& folder) {
    std::error_code unknown;
    const fs::path top = fs::canonical(folder, unknown);
    return !error && !unknown && std::ranges::mismatch(top, real).in1 == top.end();
  };
  const bool robot = real.extension() == ".urdf",
             beside =
                 robot && holds(own / "..") && real.parent_path().parent_path() == fs::canonical(own / "..");
  if (!holds(own) && !beside && std::ranges::none_of(outside_, holds))
    refuse(node, what + ": '" + node.Scalar().substr(0, 200) + "' is outside of the scene's folder" +
                     (robot ? " and of those beside it" : "") +
                     ": copy it there, or allow its folder with --read-outside DIR");
  return named_.emplace_back(path.lexically_normal().string());
}

double Text::number(const YAML::Node& node, const std::string& what, const std::string& unit,
                    Kind kind) const {
  if (!node.IsScalar()) refuse(node, what + " is one number, not " + kindOf(node));
  double x = 0;
  try {
    x = parseQuantity(node.Scalar(), unit);
  } catch (const std::invalid_argument& e) {
    refuse(node, what + ": " + e.what());
  }
  if (kind == Kind::Positive && !(x > 0))
    refuse(node, what + " is '" + node.Scalar() + "': it must be above 0");
  if (kind == Kind::NotNegative && !(x >= 0))
    refuse(node, what + " is '" + node.Scalar() + "': it must not be below 0");
  return x;
}

std::vector<double> Text::numbers(const YAML::Node& node, const std::string& what, const std::string& unit,
                                  int count) const {
  if (!node.IsSequence() || (count >= 0 && node.size() != std::size_t(count)))
    refuse(node, what + " is a list of " + (count >= 0 ? std::to_string(count) + " " : "") + "numbers, as [" +
                     (count == 3 ? "0, 0, 1" : "...") + "], not " +
                     (node.IsSequence() ? "of " + std::to_string(node.size()) : kindOf(node)));
  std::vector<double> all;
  for (std::size_t i = 0; i < node.size(); ++i)
    all.push_back(number(node[i], what + "[" + std::to_string(i) + "]", unit));
  return all;
}

Value Text::table(const YAML::Node& node, const std::string& what, const std::string& unit) const {
  Value v;
  if (node.IsMap()) {
    checkKeys(node, what, {"file", "time", "columns"});
    if (!node["file"].IsDefined()) refuse(node, what + " needs 'file', a CSV file");
    CsvChoice choice;
    if (node["time"].IsDefined()) choice.time = word(node["time"], what + ".time");
    if (const YAML::Node columns = node["columns"]; columns.IsDefined()) {
      choice.columns.emplace();
      if (columns.IsSequence())
        for (const auto& c : columns) choice.columns->push_back(word(c, what + ".columns"));
      else
        choice.columns->push_back(word(columns, what + ".columns"));
    }
    const std::string path = this->path(node["file"], what + ".file");
    CsvTable csv = at(lineOf(node["file"]), [&] {
      try {
        return readCsvTable(path, choice, unit);
      } catch (const std::invalid_argument& e) {
        throw std::invalid_argument(what + ": " + e.what());
      }
    });
    v.numbers = std::move(csv.numbers), v.width = csv.width;
    return v;
  }
  if (!node.IsSequence() || node.size() == 0)
    refuse(node, what + " is a list of rows [[0 s, 1], [1 s, 2]] or {file: FILE.csv}, not " + kindOf(node));
  for (std::size_t i = 0; i < node.size(); ++i) {
    const std::string row = what + "[" + std::to_string(i) + "]";
    if (!node[i].IsSequence() || node[i].size() < 2 || (i > 0 && node[i].size() != v.width))
      refuse(node[i], row + " is a time and " +
                          (i == 0 ? "numbers" : std::to_string(v.width - 1) + " numbers") +
                          ", as [0 s, ...]");
    v.width = node[i].size();
    for (std::size_t k = 0; k < v.width; ++k)
      v.numbers.push_back(number(node[i][k], row + "[" + std::to_string(k) + "]", k == 0 ? "s" : unit));
    if (i > 0 && !(v.numbers[i * v.width] >= v.numbers[(i - 1) * v.width]))
      refuse(node[i],
             row +
                 " is before the time before it: write the rows in the order of their times, and two rows "
                 "with one time for a jump");
  }
  return v;
}

Value Text::value(const YAML::Node& node, const std::string& what, const Key& key,
                  const Model<double>* model) const {
  Value v;
  const auto addName = [&](const YAML::Node& n) {
    const std::string name = word(n, what);
    if (model && key.kind != Kind::Joints && key.kind != Kind::Bodies)
      at(lineOf(n), [&] { return model->requireFrameId(name); });
    else if (model && key.kind == Kind::Joints && name != "all")
      at(lineOf(n), [&] { return model->requireJointId(name); });
    v.names.push_back(name);
  };
  if (key.kind == Kind::Vector || key.kind == Kind::Direction) {
    v.numbers = numbers(node, what, key.unit, 3);
    if (key.kind == Kind::Direction && v.numbers == std::vector<double>(3, 0.0))
      refuse(node, what + " is zero: it has no direction");
  } else if (key.kind == Kind::Numbers || key.kind == Kind::Times) {
    v.numbers = key.kind == Kind::Numbers && node.IsScalar()
                    ? std::vector<double>{number(node, what, key.unit)}
                    : numbers(node, what, key.unit);
    if (v.numbers.empty()) refuse(node, what + " is an empty list");
    for (std::size_t i = 1; i < v.numbers.size() && key.kind == Kind::Times; ++i)
      if (!(v.numbers[i] >= v.numbers[i - 1]))
        refuse(node,
               what + "[" + std::to_string(i) +
                   "] is before the time before it: write the times in order, and a time twice for a jump");
  } else if (key.kind == Kind::Table) {
    v = table(node, what, key.unit);
  } else if ((key.kind == Kind::Frames || key.kind == Kind::Bodies || key.kind == Kind::Joints) &&
             node.IsSequence()) {
    for (const auto& n : node) addName(n);
    if (v.names.empty()) refuse(node, what + " is an empty list");
    for (auto name = v.names.begin(); name != v.names.end(); ++name)
      if (std::find(v.names.begin(), name, *name) != name)
        refuse(node, what + " names '" + *name + "' twice: keep one");
  } else if (key.kind == Kind::Frame || key.kind == Kind::Frames || key.kind == Kind::Bodies ||
             key.kind == Kind::Joints) {
    addName(node);
  } else if (key.kind == Kind::Choice) {
    v.names = {word(node, what)};
    place(node, v.names[0], alternatives(key.unit), what + " is '" + v.names[0] + "'");
  } else {
    v.numbers = {number(node, what, key.unit, key.kind)};
  }
  return v;
}

scene::Parameters Text::parameters(const YAML::Node& node, int line, const std::string& what,
                                   const std::vector<Key>& schema, const Model<double>* model,
                                   const std::vector<std::string>& others) const {
  std::vector<std::string> known = others;
  for (const Key& key : schema) known.emplace_back(key.name);
  if (node.IsDefined() && !node.IsNull()) checkKeys(node, what, known);
  scene::Parameters p;
  for (const Key& key : schema) {
    const std::string name = what + "." + key.name;
    if (node.IsDefined() && node.IsMap() && node[key.name].IsDefined()) {
      p.values[key.name] = value(node[key.name], name, key, model);
    } else if (!key.fallback) {
      const bool unitless = std::string(key.unit) == "1" || std::string(key.unit).empty();
      refuse(line, what + " needs '" + key.name + "'" + (unitless ? "" : " [" + std::string(key.unit) + "]") +
                       ": " + key.meaning);
    } else if (*key.fallback) {
      auto read = fallbacks_.find(key.fallback);
      if (read == fallbacks_.end()) read = fallbacks_.emplace(key.fallback, YAML::Load(key.fallback)).first;
      p.values[key.name] = value(read->second, name, key, model);
    }
  }
  return p;
}

}  // namespace liecheck::scene_file_detail
