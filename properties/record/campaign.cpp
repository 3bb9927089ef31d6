#include <fmt/format.h>
#include <algorithm>
#include <campaign/cliffs.hpp>
#include <campaign/coverage_report.hpp>
#include <campaign/expected.hpp>
#include <map>
#include <record/record.hpp>
#include <set>
#include <store/stored_run.hpp>
#include <subjects/subject_names.hpp>
#include <support/environment.hpp>
#include <support/json.hpp>
#include <support/json_number.hpp>

namespace liecheck::properties {

namespace {

using nlohmann::json;

json size_of(const Part& part) {
  switch (part.size) {
    case nq:
      return "nq";
    case nv:
      return "nv";
    case nv_by_nv:
      return "nv x nv";
    case six_by_nv:
      return "6 x nv";
    case three_by_nv:
      return "3 x nv";
    default:
      return part.size;
  }
}

/// One entry for each part of each argument or result. If there is only one part, the entry has its name,
/// such as "phi". If there are several, the argument's name comes first, such as "X.R". An argument without
/// parts has one entry with its own name.
template <class Layouts>
json parts_of(const Layouts& layouts) {
  json list = json::array();
  for (const Layout* l : layouts) {
    if (l->parts.size() == 0)
      list.push_back({{"name", l->name}, {"size", 1}, {"unit", "1"}, {"frame", l->frame}});
    for (const Part& p : l->parts)
      list.push_back(
          {{"name", l->parts.size() == 1 ? std::string(p.name) : fmt::format("{}.{}", l->name, p.name)},
           {"size", size_of(p)},
           {"unit", p.unit},
           {"frame", l->frame}});
  }
  return list;
}

/// Name, defining equation, source, axes, arguments, results, the call of liecheck's own function, and the functions
/// from whose results a law forms it.
json definition_of(const Operation& o, const Series& series) {
  json all = {{"operation", o.name},
              {"definition", o.definition},
              {"source", o.source},
              {"frame", o.results[0]->frame},
              {"arguments", parts_of(o.arguments)},
              {"results", parts_of(o.results)},
              {"expression", o.call.expression}};
  if (const auto from = series.formed_from(o); !from.empty()) all["formed_from"] = from;
  return all;
}

/// Numerator, denominator and unit of the error of one block.
json definition_of(const Output& o) {
  return {{"operation", o.operation},
          {"block", o.block},
          {"error", o.definition->error},
          {"denominator", o.definition->denominator},
          {"unit", o.definition->unit}};
}

const char* name_of(Axis axis) {
  return axis == Axis::theta ? "theta" : axis == Axis::pi_minus_theta ? "pi_minus_theta" : "none";
}

const char* status_of(const Row& row, bool expected) {
  const std::uint64_t judged = row.inside();
  return row.failed                ? (expected ? "expected" : "fail")
         : row.unresolved          ? "unresolved"
         : row.unmeasured          ? "unmeasured"
         : judged == 0             ? "empty"
         : row.ill_posed == judged ? "ill-posed"
                                   : "pass";
}

/// One output of a series in one band.
json row_record(const Series& series, const Rows::Cell& cell, const Row& row, std::uint64_t seed) {
  const auto output = static_cast<std::size_t>(cell.first);
  const Output& o = series.outputs.at(output);
  const Band& b = series.bands()[static_cast<std::size_t>(cell.second)];
  const Budget& budget = series.budget(output, b.region);
  const CaseId id = series.id(seed, row.worst_index);
  const json worst =
      row.inside() > 0
          ? json{{"id", id.text()}, {"input", series.input(id)}, {"kappa", number(row.worst_kappa)}}
          : json();
  return {{"subject", series.subject},
          {"scalar", series.scalar},
          {"property", series.property},
          {"operation", o.operation},
          {"block", o.block},
          {"band", b.name},
          {"axis", name_of(b.axis)},
          {"low", b.low},
          {"high", b.high},
          {"count", row.count},
          // A result that is NaN or infinite has an infinite error.
          {"max_eps", row.not_finite > 0 ? json("inf") : number(row.max_error)},
          {"p99_eps", number(std::min(row.errors.quantile(0.99), row.max_error))},
          {"median_eps", number(std::min(row.errors.quantile(0.5), row.max_error))},
          {"max_excess", number(row.max_excess)},
          {"budget", budget.limit},
          {"rule", budget.rule == Rule::forward ? "forward" : "excess"},
          {"reason", budget.reason},
          {"ill_posed", row.ill_posed},
          {"unresolved", row.unresolved},
          {"not_finite", row.not_finite},
          {"wrong_branch", row.wrong_branch},
          {"refused", row.refused},
          {"not_repeatable", row.not_repeatable},
          {"argument_written", row.argument_written},
          {"output_unwritten", row.output_unwritten},
          {"outside_domain", row.outside_domain},
          {"crashed", row.crashed},
          {"environment_changed", row.environment_changed},
          {"printed", row.printed},
          {"failed", row.failed},
          {"unmeasured", row.unmeasured},
          {"status", status_of(row, !fails(series, cell, row))},
          {"worst", worst}};
}

struct Results {
  json rows = json::array(), operations = json::array(), blocks = json::array();
};

/// Every row, and the definitions of their operations and blocks, each once.
Results results_of(const CampaignResult& r) {
  Results all;
  std::set<const Operation*> operations;
  std::set<const Block*> blocks;
  for (const auto& [series, tally] : r.series)
    for (const auto& [cell, row] : tally.rows) {
      const Output& o = series->outputs.at(static_cast<std::size_t>(cell.first));
      if (operations.insert(o.record).second) all.operations.push_back(definition_of(*o.record, *series));
      if (blocks.insert(o.definition).second) all.blocks.push_back(definition_of(o));
      all.rows.push_back(row_record(*series, cell, row, r.options.seed));
    }
  return all;
}

json laws(const CampaignResult& r) {
  json all = json::array();
  std::set<std::string> seen;
  for (const auto& [series, tally] : r.series)
    if (seen.insert(series->property).second)
      all.push_back({{"property", series->property},
                     {"law", series->law},
                     {"equation", series->equation},
                     {"source", series->source}});
  return all;
}

/// The subjects, each with the operations of this campaign that it does not offer.
json subjects_record(const CampaignResult& r) {
  struct Offered {
    const Series* series;
    std::set<std::string_view> operations;
  };
  std::map<std::pair<std::string, std::string>, Offered> subjects;
  std::set<std::string_view> operations;
  for (const auto& [series, tally] : r.series) {
    for (const Output& o : series->outputs) operations.insert(o.operation);
    Offered& offered = subjects[{series->subject, series->scalar}];
    offered.series = series.get();
    for (const auto& [cell, row] : tally.rows)
      offered.operations.insert(series->outputs.at(static_cast<std::size_t>(cell.first)).operation);
  }
  json all = json::array();
  for (const auto& [key, offered] : subjects) {
    std::vector<std::string_view> not_offered;
    std::set_difference(operations.begin(), operations.end(), offered.operations.begin(),
                        offered.operations.end(), std::back_inserter(not_offered));
    all.push_back({{"name", key.first},
                   {"version", offered.series->subject_version},
                   {"scalar", key.second},
                   {"eps", offered.series->eps},
                   {"profile", name_of(offered.series->profile)},
                   {"limits", offered.series->own ? offered.series->own->file : ""},
                   {"limits_hash", offered.series->own ? hash_of(*offered.series->own) : ""},
                   {"flags", subject_flags(*offered.series)},
                   {"not_offered", not_offered}});
  }
  return all;
}

/// What the campaign must have measured and did not.
json not_measured_record(const CampaignResult& r) {
  json all = json::array();
  for (const auto& [series, tally] : r.series)
    for (const std::string& line : not_measured(*series, tally))
      all.push_back({{"property", series->property},
                     {"subject", series->subject},
                     {"scalar", series->scalar},
                     {"what", line}});
  return all;
}

json wrong_calls_record(const CampaignResult& r) {
  json all = json::array();
  for (const WrongCall& call : r.wrong_calls)
    all.push_back({{"subject", call.subject}, {"sentence", call.sentence}});
  return all;
}

json cliffs_record(const CampaignResult& r) {
  json all = json::array();
  for (const auto& [series, tally] : r.series)
    for (const Cliff& c : cliffs_of(*series, tally)) {
      const Output& o = series->outputs.at(c.output);
      all.push_back({{"property", series->property},
                     {"subject", series->subject},
                     {"scalar", series->scalar},
                     {"operation", o.operation},
                     {"block", o.block},
                     {"band", series->bands()[c.band].name},
                     {"beside", c.moderate ? "moderate angles" : "neighbours"},
                     {"figure", number(c.figure)},
                     {"reference", number(c.reference)},
                     {"expected", c.expected}});
    }
  return all;
}

json expected_record(const CampaignResult& r) {
  json all = json::array();
  for (const Expectation& e : expectations_of(r))
    all.push_back({{"subject", e.subject},
                   {"operation", e.line.operation},
                   {"block", e.line.block},
                   {"inputs", e.line.inputs.text},
                   {"reason", e.line.reason},
                   {"link", e.line.link},
                   {"measured", e.measured},
                   {"failed", e.failed},
                   {"passed", e.passed()}});
  return all;
}

json counterexamples_record(const Counterexamples& c) {
  return {{"replayed", c.replayed},
          {"skipped", c.skipped},
          {"failing", list_of(c.failing, [](const auto& f) { return f.id; })}};
}

}  // namespace

json record_of(const StoredRun& run) {
  const CampaignResult& r = run.result;
  Results results = results_of(r);  // of a million numbers: moved, since a signal waits for the record
  return {
      {"version", LIECHECK_VERSION},
      {"generator_version", generator_version},
      {"seed", r.options.seed},
      {"cases", r.options.seconds ? r.total_cases : r.options.cases},
      {"total_cases", r.total_cases},
      {"verdict", verdict_of(!r.undecided(), !r.fails())},
      {"not_measured", not_measured_record(r)},
      {"wrong_calls", wrong_calls_record(r)},
      {"cliffs", cliffs_record(r)},
      {"expected", expected_record(r)},
      {"counterexamples", counterexamples_record(run.counterexamples)},
      {"digest", {{"inputs", r.inputs_digest}, {"results", r.results_digest}}},
      {"robot",
       {{"name", r.robot.name}, {"hash", r.robot.hash}, {"root", r.robot.fixed ? "fixed" : "free-flyer"}}},
      {"environment", run.environment.empty() ? environment() : parsed(run.environment)},
      {"subjects", subjects_record(r)},
      {"absent", absent_subjects()},
      {"blocks", std::move(results.blocks)},
      {"operations", std::move(results.operations)},
      {"properties", laws(r)},
      {"results", std::move(results.rows)}};
}

void add_part(json& record, const std::string& key, json part) {
  if (part.is_null()) return;
  if (key != "cost") part.erase("environment");  // the campaign's record has it, without what concerns times
  if (part.value("verdict", "") == "fail") record["verdict"] = "fail";
  record[key] = std::move(part);
}

}  // namespace liecheck::properties
