// Every operation and block has a definition of its own, in the records, in the JSON record and in the docs.

#include <gtest/gtest.h>

#include <campaign/campaign.hpp>
#include <fstream>
#include <map>
#include <operations/operations.hpp>
#include <operations/table.hpp>
#include <record/campaign.hpp>
#include <set>
#include <sstream>
#include <store/counterexamples.hpp>

namespace liecheck::properties {
namespace {

using nlohmann::json;

/// What is wrong with the definitions of a record: a row without one, or two operations or two blocks of an operation
/// that share one.
std::vector<std::string> faults_of(const json& record) {
  std::vector<std::string> faults;
  std::map<std::string, std::string> operations;
  std::map<std::pair<std::string, std::string>, std::string> blocks;
  const auto unique = [&](auto& all, const auto& key, const std::string& text, const std::string& name) {
    if (!all.emplace(key, text).second) faults.push_back(name + " is defined twice");
    if (text.empty()) faults.push_back(name + " has an empty definition");
  };
  for (const json& o : record.at("operations"))
    unique(operations, o.at("operation").get<std::string>(), o.at("definition").get<std::string>(),
           o["operation"]);
  for (const json& b : record.at("blocks"))
    unique(blocks, std::pair(b.at("operation").get<std::string>(), b.at("block").get<std::string>()),
           b.at("error").get<std::string>() + " / " + b.at("denominator").get<std::string>(),
           b["operation"].get<std::string>() + " " + b["block"].get<std::string>());
  for (const json& row : record.at("results")) {
    const std::string operation = row.at("operation"), block = row.at("block");
    if (!operations.count(operation)) faults.push_back(operation + " has no definition");
    if (!blocks.count({operation, block})) faults.push_back(operation + " " + block + " has no definition");
  }
  std::map<std::string, std::string> by_definition;
  for (const auto& [name, text] : operations)
    if (const auto [other, added] = by_definition.emplace(text, name); !added)
      faults.push_back(name + " shares the definition of " + other->second);
  std::map<std::pair<std::string, std::string>, std::string> by_error;
  for (const auto& [name, text] : blocks)
    if (const auto [other, added] = by_error.emplace(std::pair(name.first, text), name.second); !added)
      faults.push_back(name.first + " " + name.second + " shares the definition of " + other->second);
  return faults;
}

json real_record() {
  CampaignOptions options;
  options.selection = {{"liecheck"}, {}, {"double"}};
  options.cases = 40;
  options.quiet = true;
  return record_of(run_campaign(options, built_in_robot()));
}

TEST(Record, DefinesEveryOperationAndBlockOfARealCampaign) {
  json record = real_record();
  EXPECT_EQ(faults_of(record), std::vector<std::string>());
  std::set<std::string> measured;
  for (const json& row : record["results"]) measured.insert(row["operation"]);
  EXPECT_EQ(measured.size(), all_operations().size())
      << "a record that no law measures, or a law that found nothing";

  json without_operation = record;
  without_operation["operations"].erase(3);
  EXPECT_FALSE(faults_of(without_operation).empty());
  json without_block = record;
  without_block["blocks"].erase(7);
  EXPECT_FALSE(faults_of(without_block).empty());
  json shared = record;
  shared["operations"][1]["definition"] = shared["operations"][0]["definition"];
  EXPECT_FALSE(faults_of(shared).empty());
  record["blocks"][0]["error"] = record["blocks"][0]["denominator"] = "";
  record["blocks"][1] = record["blocks"][0];
  EXPECT_FALSE(faults_of(record).empty());
}

TEST(Operations, AreNamedOnceAndHaveBlocksWithUnits) {
  std::set<std::string_view> names;
  for (const Operation* o : all_operations()) {
    EXPECT_TRUE(names.insert(o->name).second) << o->name;
    EXPECT_EQ(&operation_named(o->name), o);
    EXPECT_GT(o->blocks.size(), 0u) << o->name;
    EXPECT_GT(o->results.size(), 0u) << o->name;
    for (const Block& b : o->blocks) EXPECT_FALSE(b.unit.empty()) << o->name << " " << b.name.text;
    for (const std::string_view text : {o->definition, o->source, o->call.header, o->call.expression})
      EXPECT_FALSE(text.empty()) << o->name;
  }
  EXPECT_THROW(operation_named("exp7"), std::logic_error);
}

template <class M>
int numbers_in(const M& m) {
  return static_cast<int>(m.size());
}
int numbers_in(const Pose<double>&) {
  return 12;
}
int numbers_in(const Body<double>&) {
  return 13;
}
int numbers_in(double) {
  return 1;
}

template <class Id, bool Bound, class Result, class... Arguments>
void check_sizes(const Typed<Id, Bound, Result, Arguments...>& o) {
  const std::vector<int> sizes{numbers_in(typename Arguments::template of<double>())...};
  const auto parts = [](const Layout& l) {
    int n = 0;
    for (const Part& p : l.parts) n += p.size;
    return n;
  };
  for (std::size_t i = 0; i < sizes.size(); ++i)
    EXPECT_EQ(parts(*o.arguments[i]), sizes[i]) << o.name << " " << i;
  EXPECT_EQ(parts(*o.results[0]), numbers_in(typename Result::template of<double>())) << o.name;
}

TEST(Operations, PartsOfLayoutsAreTheNumbersOfTheirTypes) {
  SpatialSlots<double>::for_each([](const auto& o) { check_sizes(o); });
}

TEST(Operations, DocumentationIsWhatTheRecordsSay) {
  std::ifstream file(std::string(LIECHECK_FIXTURES) + "/../docs/operations.md");
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), operations_table()) << "regenerate: liecheck list --operations > docs/operations.md";
}

}  // namespace
}  // namespace liecheck::properties
