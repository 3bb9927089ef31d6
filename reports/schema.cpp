// A checker of the part of JSON Schema (draft 7) that the schemas in properties/record/schema use.

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <reports/record.hpp>
#include <stdexcept>

namespace liecheck::reports {
namespace {

/// A schema file, parsed at its first use; only schema() needs these files.
const Json& schema_file(const std::string& name) {
  static std::map<std::string, Json> all;
  const auto [file, is_new] = all.try_emplace(name);
  if (is_new) file->second = parsed(embedded_file(name));
  return file->second;
}

/// A node of the schema file `name`, with its references replaced by their targets. A key next to a reference
/// overrides the same key of the target.
Json resolved(const std::string& name, const Json& node) {
  if (node.is_array()) {
    Json all = Json::array();
    for (const Json& part : node) all.push_back(resolved(name, part));
    return all;
  }
  if (!node.is_object()) return node;
  Json all = Json::object();
  if (node.contains("$ref")) {
    const std::string reference = node["$ref"];
    const auto hash = std::min(reference.find('#'), reference.size());
    const std::string file = hash == 0 ? name : reference.substr(0, hash);
    const Json::json_pointer place(hash == reference.size() ? "" : reference.substr(hash + 1));
    all = resolved(file, schema_file(file).at(place));
  }
  for (const auto& [key, part] : node.items())
    if (key != "$ref" && key != "definitions") all[key] = resolved(name, part);
  return all;
}

/// Whether a value has a type of JSON Schema. An integer is one that is written without a point: 1.0 is none.
bool has_type(const Json& value, std::string_view type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "null") return value.is_null();
  if (type == "number") return value.is_number();
  if (type == "integer") return value.is_number_integer();
  throw std::logic_error(fmt::format("schema: type {} is not known", type));
}

/// The words of a pattern ^(word|word)$, which is the only kind of pattern in the schemas.
std::vector<std::string> words_of(const std::string& pattern) {
  if (!pattern.starts_with("^(") || !pattern.ends_with(")$") ||
      pattern.find_first_of("^$()[]{}.*+?\\", 2) != pattern.size() - 2)
    throw std::logic_error(fmt::format("schema: pattern {} is not known", pattern));
  std::vector<std::string> all;
  std::string_view rest = std::string_view(pattern).substr(2, pattern.size() - 4);
  for (std::size_t end = 0; end != rest.npos; rest.remove_prefix(end == rest.npos ? rest.size() : end + 1))
    all.emplace_back(rest.substr(0, end = rest.find('|')));
  return all;
}

/// Checks values against a node of the schema. Throws std::logic_error for a keyword that it does not know.
class Rule {
 public:
  explicit Rule(const Json& node) {
    for (const auto& [key, part] : node.items()) add(key, part);
  }
  bool is_met_by(const Json& value) const {
    if (!types_.empty() &&
        std::ranges::none_of(types_, [&](const std::string& type) { return has_type(value, type); }))
      return false;
    if (!enum_.is_null() && std::ranges::count(enum_, value) == 0) return false;
    if (value.is_number()) {
      const double x = value.get<double>();
      return x >= minimum_ && x <= maximum_ && x > above_ && x < below_;
    }
    if (value.is_string() && !words_.empty())
      return std::ranges::count(words_, value.get_ref<const std::string&>()) > 0;
    if (value.is_array())
      return value.size() >= min_items_ && value.size() <= max_items_ &&
             (!items_ ||
              std::ranges::all_of(value, [&](const Json& item) { return items_->is_met_by(item); }));
    return !value.is_object() || has_members(value);
  }
  /// Removes the members that the schema does not know.
  void prune(Json& value) const {
    if (value.is_array() && items_)
      for (Json& item : value) items_->prune(item);
    if (!value.is_object()) return;
    for (auto member = value.begin(); member != value.end();) {
      const auto known = properties_.find(member.key());
      const Rule* const rule = known != properties_.end() ? &known->second : others_.get();
      if (rule) rule->prune(*member);
      member = rule ? std::next(member) : value.erase(member);
    }
  }

 private:
  void add(const std::string& key, const Json& part) {
    if (key == "type")
      types_ = part.is_array() ? part.get<std::vector<std::string>>() : std::vector{part.get<std::string>()};
    else if (key == "enum")
      enum_ = part;
    else if (key == "minimum")
      minimum_ = part;
    else if (key == "maximum")
      maximum_ = part;
    else if (key == "exclusiveMinimum")
      above_ = part;
    else if (key == "exclusiveMaximum")
      below_ = part;
    else if (key == "pattern")
      words_ = words_of(part);
    else if (key == "minItems")
      min_items_ = part;
    else if (key == "maxItems")
      max_items_ = part;
    else if (key == "items")
      items_ = std::make_unique<Rule>(part);
    else if (key == "required")
      required_ = part.get<std::vector<std::string>>();
    else if (key == "properties")
      for (const auto& [name, rule] : part.items()) properties_.try_emplace(name, rule);
    else if (key == "additionalProperties")
      others_ = std::make_unique<Rule>(part);
    else if (key != "title" && key != "description" && key != "$schema" && key != "$comment")
      throw std::logic_error(fmt::format("schema: keyword {} is not known", key));
  }
  bool has_members(const Json& value) const {
    if (!std::ranges::all_of(required_, [&](const std::string& name) { return value.contains(name); }))
      return false;
    for (const auto& [name, part] : value.items()) {
      const auto known = properties_.find(name);
      const Rule* const rule = known != properties_.end() ? &known->second : others_.get();
      if (rule && !rule->is_met_by(part)) return false;
    }
    return true;
  }

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  double minimum_ = -infinity, maximum_ = infinity, above_ = -infinity, below_ = infinity;
  std::size_t min_items_ = 0, max_items_ = std::numeric_limits<std::size_t>::max();
  std::vector<std::string> types_, required_;
  Json enum_;                       // null: every value
  std::vector<std::string> words_;  // empty: every string
  std::map<std::string, Rule> properties_;
  std::unique_ptr<Rule> items_, others_;
};

/// The rule of a node of a schema(). Rules are made once: to parse the schema takes longer than to check a small record.
Rule& rule_of(const Json& node) {
  thread_local std::map<const Json*, Rule> all;
  return all.try_emplace(&node, node).first->second;
}

/// Says in words which values a node of the schema accepts.
std::string expected(const Json& node) {
  if (node.contains("enum"))
    return fmt::format("one of {}", fmt::join(node["enum"].get<std::vector<std::string>>(), ", "));
  if (node["type"] == "object") return "an object";
  if (node["type"].is_array() && node["type"][0] == "object") return "an object or null";
  return node.value("title", "an array");
}

/// Refuses the innermost part of `value` that does not satisfy its node of the schema.
[[noreturn]] void refuse_part(std::string_view file, const std::string& field, const Json& node,
                              const Json& value) {
  const auto check = [file](const std::string& inner, const Json& rule, const Json& part) {
    if (!rule_of(rule).is_met_by(part)) refuse_part(file, inner, rule, part);
  };
  if (value.is_array() && node.contains("items")) {
    for (std::size_t i = 0; i < value.size(); ++i)
      check(fmt::format("{}[{}]", field, i), node["items"], value[i]);
  }
  if (value.is_object()) {
    const std::string prefix = field.empty() ? "" : field + ".";
    for (const Json& name : node.value("required", Json::array()))
      if (!value.contains(name.get<std::string>()))
        throw std::runtime_error(
            fmt::format("{}: field {}{} is missing", file, prefix, name.get<std::string>()));
    for (const auto& [name, part] : value.items())
      if (node.contains("properties") && node["properties"].contains(name))
        check(prefix + name, node["properties"][name], part);
      else if (node.contains("additionalProperties"))
        check(prefix + name, node["additionalProperties"], part);
  }
  refuse(file, field, expected(node), value);
}

}  // namespace

const Json& schema(const std::string& kind) {
  static std::map<std::string, Json> all;
  const auto [whole, is_new] = all.try_emplace(kind);
  if (is_new) whole->second = resolved(kind + ".json", {{"$ref", kind + ".json"}});
  return whole->second;
}

void refuse(std::string_view file, std::string_view field, std::string_view expected, const Json& found) {
  std::string text = found.dump(-1, ' ', true);
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  throw std::runtime_error(fmt::format("{}: field {}: expected {}, found {}", file,
                                       field.empty() ? "(top level)" : field, expected, text));
}

void prune(Json& record, const std::string& kind) {
  rule_of(schema(kind)).prune(record);
}

void check_schema(std::string_view file, const Json& record, const std::string& kind) {
  if (!rule_of(schema(kind)).is_met_by(record)) refuse_part(file, "", schema(kind), record);
}

}  // namespace liecheck::reports
