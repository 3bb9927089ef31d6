// The only file that compiles valijson.

#include <fmt/format.h>

#include <map>
#include <reports/record.hpp>
#include <stdexcept>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

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

/// Checks values against a node of the schema.
class Rule {
 public:
  explicit Rule(const Json& node) {
    valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(node), schema_);
  }
  bool is_met_by(const Json& value) {
    return validator_.validate(schema_, valijson::adapters::NlohmannJsonAdapter(value), nullptr);
  }

 private:
  valijson::Schema schema_;
  valijson::Validator validator_;
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

/// Refuses the innermost part of `value` that does not satisfy its node of the schema. valijson's lists of
/// errors are not used: they grow with the file and lack the value that was found.
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

void check_schema(std::string_view file, const Json& record, const std::string& kind) {
  if (!rule_of(schema(kind)).is_met_by(record)) refuse_part(file, "", schema(kind), record);
}

}  // namespace liecheck::reports
