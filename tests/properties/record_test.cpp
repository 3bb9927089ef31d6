// The records that the program writes meet their schema, have every field that it documents and no other, and
// define every operation and block that they measure.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <record/record.hpp>
#include <reports/record.hpp>
#include <string>
#include <utility>

#include "../reports/documented_fields.hpp"
#include "../reports/sample_record.hpp"
#include "../scratch.hpp"
#include "../shell.hpp"

namespace {

using namespace liecheck::reports;

/// The record that a command writes with --json. Its verdict, exit code 0, 1 or 3, is ignored.
Json written(const std::string& arguments) {
  const std::string file = liecheck::own_folder() + "record.json";
  const auto [code, text] = liecheck::shell(LIECHECK_PROGRAM " " + arguments + " --json '" + file + "'");
  EXPECT_TRUE(code != -1 && code != 2) << arguments << text;
  std::ifstream in(file);
  return Json::parse(in);
}

const Json& campaign() {
  static const Json record = written("campaign --subject all --cases 20 -j 1");
  return record;
}

/// The schema of a record without the sections that a campaign does not write.
Json schema_of_campaign() {
  Json rule = schema();
  for (const char* section : {"sweep", "bounds", "cost", "scenes"}) rule["properties"].erase(section);
  for (const char* section : {"not_measured", "wrong_calls", "cliffs", "expected"})
    if (campaign()[section].empty()) rule["properties"][section].erase("items");
  return rule;
}

void expect_agreement(const Json& rule, const Json& value) {
  const Disagreement found = compare_fields(rule, value);
  EXPECT_EQ(found.absent, std::set<std::string>());
  EXPECT_EQ(found.undocumented, std::set<std::string>());
}

TEST(Record, OfACampaignHasEveryDocumentedFieldAndNoOther) {
  EXPECT_NO_THROW(check_record("campaign.json", campaign()));
  expect_agreement(schema_of_campaign(), campaign());
  Json spoilt = campaign();
  spoilt["results"][7].erase("budget");
  EXPECT_THROW(check_record("campaign.json", spoilt), std::runtime_error);
}

TEST(Record, OfCliffsAndExpectedFailuresHasEveryDocumentedFieldAndNoOther) {
  const std::string limits = liecheck::scratch() + "record.limits";
  std::ofstream(limits)
      << "version = 2\nsubject = textbook\n[expected]\nexp6, translation, any = why, link\n";
  const Json record = written(
      "campaign --subject textbook --property exp_oracle --scalar double --cases 8000 "
      "--no-hard-cases --limits '" +
      limits + "'");
  EXPECT_NO_THROW(check_record("campaign.json", record));
  for (const char* section : {"cliffs", "expected"})
    expect_agreement(schema()["properties"][section], record[section]);
}

/// Faults in the definitions of the operations and blocks in a record's results.
std::set<std::string> faulty_definitions(const Json& record) {
  std::map<std::string, std::string> operations;  // definition -> name
  std::set<std::string> bad;
  std::set<std::pair<std::string, std::string>> blocks;
  for (const Json& o : record["operations"]) {
    const std::string name = o["operation"], definition = o["definition"];
    const auto [first, is_new] = operations.emplace(definition, name);
    if (!is_new) bad.insert(name + " shares the definition of " + first->second);
    for (const char* field : {"definition", "source"})
      if (o.value(field, "") == "") bad.insert(name + " has no " + field);
    if (o.value("results", Json::array()).empty()) bad.insert(name + " has no results");
  }
  for (const Json& b : record["blocks"])
    if (!b.contains("operation"))
      bad.insert(b["block"].get<std::string>() + " is defined without an operation");
    else if (!blocks.emplace(b["operation"], b["block"]).second)
      bad.insert(b.dump() + " is defined twice");
    else if (b["error"] == "" || b["denominator"] == "" || b["unit"] == "")
      bad.insert(b.dump() + " has an empty field");
  std::set<std::string> defined;
  for (const auto& [definition, name] : operations) defined.insert(name);
  for (const Json& row : record["results"]) {
    const std::string operation = row["operation"], block = row["block"];
    if (!defined.count(operation)) bad.insert(operation + " is not defined");
    if (!blocks.count({operation, block})) bad.insert(operation + ", " + block + " is not defined");
  }
  return bad;
}

TEST(Record, DefinesEveryOperationAndBlockOfItsResults) {
  EXPECT_EQ(faulty_definitions(campaign()), std::set<std::string>());
  Json less = campaign();
  const Json &row = less["results"][0], &blocks = less["blocks"];
  for (std::size_t i = blocks.size(); i-- > 0;)
    if (blocks[i]["block"] == row["block"] && row["operation"] == blocks[i].value("operation", ""))
      less["blocks"].erase(i);
  EXPECT_EQ(faulty_definitions(less).size(), 1u);
  less = campaign();
  less["operations"][0]["definition"] = less["operations"][1]["definition"];
  EXPECT_FALSE(faulty_definitions(less).empty());
}

TEST(Record, OfCostSweepAndBoundsHasEveryDocumentedFieldAndNoOther) {
  Json whole = record();
  whole["cost"] = written("cost --op exp6 --for 1s");
  whole["sweep"] = written("lab sweep --coefficient c2 --stride 1000003 -j 1");
  whole["bounds"] = written("lab bounds --operation exp6 --boxes 200");
  EXPECT_NO_THROW(check_record("report.json", whole));
  for (const char* section : {"sweep", "bounds"})
    expect_agreement(schema()["properties"][section], whole[section]);
  const Disagreement found = compare_fields(schema()["properties"]["cost"], whole["cost"]);
  EXPECT_EQ(found.undocumented, std::set<std::string>());
  for (const std::string& field :
       found.absent)  // of adapters (adapter_cost_test.cpp), and where cycles are counted
    EXPECT_TRUE(field == "rows[].timed" || field.starts_with("rows[].sets[].interface") ||
                field == "rows[].sets[].cycles")
        << field;
  Json parts = record();
  for (const char* section : {"cost", "sweep", "bounds"})
    liecheck::properties::add_part(parts, section, whole[section]);
  EXPECT_NO_THROW(check_record("report.json", parts));
}

TEST(Record, OfScenesHasNoUndocumentedField) {
  Json whole = record();
  whole["scenes"] = written("scene sweep " LIECHECK_FIXTURES
                            "/scenes/stable_major_spin.yaml --integrator rk2 --no-peers --for 1s");
  EXPECT_NO_THROW(check_record("report.json", whole));
  const Disagreement found = compare_fields(schema()["properties"]["scenes"], whole["scenes"]);
  EXPECT_EQ(found.undocumented, std::set<std::string>());
  for (const std::string& field : found.absent)  // only the record of a report has these
    EXPECT_TRUE(field.starts_with("costs") || field.starts_with("films") || field.starts_with("peers[]") ||
                field.starts_with("scenes[].left_out[]") || field.starts_with("spins[]") ||
                field.starts_with("flips[]"))
        << field;
}

}  // namespace
