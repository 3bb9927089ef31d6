// The schema of a record: every documented field is checked, and docs/record.md agrees with the schema.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <reports/record.hpp>
#include <set>

#include "documented_fields.hpp"
#include "sample_record.hpp"

namespace {

using namespace liecheck::reports;

class SchemaOf : public testing::TestWithParam<const char*> {
 protected:
  std::string kind = GetParam();
  Json sample() const { return kind == "record" ? full_record() : measurement(kind); }
};
INSTANTIATE_TEST_SUITE_P(Of, SchemaOf, testing::Values("record", "environments", "horizons", "rounding"));

TEST_P(SchemaOf, DocumentsEveryFieldAndNoOther) {
  EXPECT_EQ(refusal_of(sample(), kind), "");
  const Disagreement found = compare_fields(schema(kind), sample());
  EXPECT_EQ(found.absent, std::set<std::string>());
  EXPECT_EQ(found.undocumented, std::set<std::string>());
}

TEST(Schema, AcceptsFieldsOfLaterVersions) {
  Json more = full_record();
  more["results"][1]["worst"]["colour"] = "red";
  EXPECT_EQ(compare_fields(schema(), more).undocumented, std::set<std::string>{"results[].worst.colour"});
  EXPECT_EQ(refusal_of(more), "");
}

TEST_P(SchemaOf, ChecksEveryFieldThatItDocuments) {
  Json record = sample();
  const auto refusal_with = [&](Json& object, Json changed) {
    std::swap(object, changed);  // swapped back below, so that the iterators of visit_fields stay valid
    const std::string line = refusal_of(record, kind);
    std::swap(object, changed);
    return line;
  };
  std::set<std::string> done;
  visit_fields(schema(kind), record, "",
               [&](const std::string& field, Json& object, const std::string& key, const Json& rule,
                   const Json& object_rule) {
                 if (!done.insert(field).second) return;
                 EXPECT_NE(rule.value("description", ""), "") << field << " has no description";
                 Json changed = object;
                 changed[key] = rule.contains("type") && rule["type"] == "boolean" ? Json(1) : Json(true);
                 const std::string wrong = refusal_with(object, changed);
                 EXPECT_TRUE(wrong.starts_with("r.json: field ")) << field << " accepts any value: " << wrong;
                 EXPECT_TRUE(has(wrong, key + ": expected "));
                 EXPECT_TRUE(has(wrong, ", found "));
                 changed.erase(key);
                 const Json required = object_rule.value("required", Json::array());
                 // Open keys are required too, such as the input for each scalar of a hard case.
                 EXPECT_EQ(field.ends_with(".*") || std::count(required.begin(), required.end(), key) == 1,
                           refusal_with(object, changed).find(key + " is missing") != wrong.npos)
                     << field;
               });
  EXPECT_GT(done.size(), kind == "record" ? 200u : 15u);
}

/// The values that a node of the schema allows, in the words of docs/record.md.
std::string kind(const Json& rule) {
  if (rule.contains("enum"))
    return fmt::format("`{}`", fmt::join(rule["enum"].get<std::vector<std::string>>(), "`, `"));
  const bool or_null = rule["type"].is_array() && rule["type"].back() == "null";
  if (rule.contains("properties") || rule.contains("additionalProperties"))
    return or_null ? "object or null" : "object";
  if (!rule.contains("items") || (rule["items"]["type"] == "number" && rule.contains("maxItems")))
    return rule["title"];
  const Json& item = rule["items"];
  return item.contains("properties") ? "list of objects" : "list, each " + kind(item);
}

/// Tables of the fields of each object, outer objects first; objects with equal fields share a table.
std::string tables(const Json& rule, const std::string& name, std::map<std::string, std::string>& done) {
  if (rule.contains("items")) return tables(rule["items"], name + "[]", done);
  Json members = rule.value("properties", Json::object());
  if (rule.contains("additionalProperties")) members["*"] = rule["additionalProperties"];
  if (members.empty()) return "";
  const std::string title = fmt::format("\n### {}\n\n", name.empty() ? "The record" : "`" + name + "`");
  const auto [same, is_new] = done.try_emplace(dumped(members), name);
  if (!is_new) return title + fmt::format("The fields are those of `{}`.\n", same->second);
  std::vector<std::string> keys = rule.value("required", std::vector<std::string>());
  const std::size_t required = keys.size();
  for (const auto& [key, member] : members.items())
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
  std::string out = title + "| field | value | meaning |\n|---|---|---|\n", inner;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Json& member = members[keys[i]];
    out += fmt::format("| `{}` | {}{} | {} |\n", keys[i], kind(member), i < required ? "" : "; may be absent",
                       member["description"].get<std::string>());
    inner += tables(member, (name.empty() ? "" : name + ".") + keys[i], done);
  }
  return out + inner;
}

TEST(Schema, AgreesWithTheDocumentation) {
  std::ifstream file(LIECHECK_SOURCE_DIR "/docs/record.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  const std::string mark = "## Fields\n";
  std::map<std::string, std::string> done;
  std::string text = page.substr(0, page.find(mark) + mark.size()) + tables(schema(), "", done);
  for (const char* kind : measurement_kinds) text += tables(schema(kind), kind, done);
  const std::string right = testing::TempDir() + "record.md";  // it must outlive the test
  if (text != page) std::ofstream(right) << text;
  EXPECT_TRUE(text == page) << "copy " << right << " to docs/record.md";
}

}  // namespace
