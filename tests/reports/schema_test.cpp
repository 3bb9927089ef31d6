// The schema of a record: every field that it documents is checked, and docs/record.md says what it says.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <reports/record.hpp>
#include <set>
#include <stdexcept>

#include "documented_fields.hpp"
#include "sample_record.hpp"

namespace {

using namespace liecheck::reports;

std::string refusal(const Json& record) {
  try {
    check_record("r.json", record);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(Schema, DocumentsEveryFieldOfARecordAndNoOther) {
  EXPECT_EQ(refusal(full_record()), "");
  const Disagreement found = compare_fields(schema(), full_record());
  EXPECT_EQ(found.absent, std::set<std::string>());
  EXPECT_EQ(found.undocumented, std::set<std::string>());
  Json more = full_record();
  more["results"][1]["worst"]["colour"] = "red";
  EXPECT_EQ(compare_fields(schema(), more).undocumented, std::set<std::string>{"results[].worst.colour"});
  EXPECT_EQ(refusal(more), "") << "later versions add fields";
}

TEST(Schema, ChecksEveryFieldThatItDocuments) {
  Json record = full_record();
  const auto refusal_with = [&](Json& object, Json changed) {
    std::swap(object, changed);  // and back, so that nobody's iterators are lost
    const std::string line = refusal(record);
    std::swap(object, changed);
    return line;
  };
  std::set<std::string> done;
  visit_fields(schema(), record, "",
               [&](const std::string& field, Json& object, const std::string& key, const Json& rule,
                   const Json& object_rule) {
                 if (!done.insert(field).second) return;
                 EXPECT_NE(rule.value("description", ""), "") << field << " has no description";
                 Json changed = object;
                 changed[key] = rule["type"] == "boolean" ? Json(1) : Json(true);
                 const std::string wrong = refusal_with(object, changed);
                 EXPECT_EQ(wrong.rfind("r.json: field ", 0), 0u) << field << " may be anything: " << wrong;
                 EXPECT_NE(wrong.find(key + ": expected "), wrong.npos) << wrong;
                 EXPECT_NE(wrong.find(", found "), wrong.npos) << wrong;
                 changed.erase(key);
                 const Json required = object_rule.value("required", Json::array());
                 // A hard case must have the input of every scalar that its cells name.
                 EXPECT_EQ(field.ends_with(".*") || std::count(required.begin(), required.end(), key) == 1,
                           refusal_with(object, changed).find(key + " is missing") != wrong.npos)
                     << field;
               });
  EXPECT_GT(done.size(), 200u);
}

}  // namespace
