#pragma once
// The fields that the schema documents, and the fields that a record has.

#include <map>
#include <reports/record.hpp>
#include <set>
#include <string>

namespace liecheck::reports {

/// Calls visit(field, object, key, rule, object_rule) for every member of every object in a value that the
/// node `rule` of the schema describes, outer objects first. In `field`, "[]" stands for any index and "*"
/// for a key that the schema leaves open: "results[].worst.id", "hard_cases[].input.*". The rule of an
/// unknown member is null.
template <class Value, class Visit>
void visit_fields(const Json& rule, Value& value, const std::string& field, const Visit& visit) {
  if (value.is_array() && rule.contains("items"))
    for (auto& part : value) visit_fields(rule["items"], part, field + "[]", visit);
  if (!value.is_object()) return;
  const std::string prefix = field.empty() ? "" : field + ".";
  for (auto member = value.begin(); member != value.end(); ++member) {
    const bool open = rule.contains("additionalProperties");
    const bool known = rule.contains("properties") && rule["properties"].contains(member.key());
    const Json& inner = known  ? rule["properties"][member.key()]
                        : open ? rule["additionalProperties"]
                               : Json();
    const std::string name = prefix + (open && !known ? "*" : member.key());
    visit(name, value, member.key(), inner, rule);
    if (known || open) visit_fields(inner, *member, name, visit);
  }
}

/// Adds every field below a node of the schema to `all`, with the node of each field.
inline void documented_fields(const Json& rule, const std::string& field, std::map<std::string, Json>& all) {
  if (rule.contains("items")) documented_fields(rule["items"], field + "[]", all);
  Json members = rule.value("properties", Json::object());
  if (rule.contains("additionalProperties")) members["*"] = rule["additionalProperties"];
  for (const auto& [key, inner] : members.items()) {
    const std::string name = (field.empty() ? "" : field + ".") + key;
    all[name] = inner;
    documented_fields(inner, name, all);
  }
}

/// Differences between a value and its node of the schema: documented fields that do not occur in the value,
/// and fields that occur but are not documented.
struct Disagreement {
  std::set<std::string> absent, undocumented;
};
inline Disagreement compare_fields(const Json& rule, const Json& value) {
  Disagreement result;
  std::map<std::string, Json> documented;
  documented_fields(rule, "", documented);
  for (const auto& [field, inner] : documented) result.absent.insert(field);
  visit_fields(rule, value, "",
               [&](const std::string& field, const Json&, const auto&, const Json& inner, const Json&) {
                 if (inner.is_null()) result.undocumented.insert(field);
                 result.absent.erase(field);
               });
  return result;
}

}  // namespace liecheck::reports
