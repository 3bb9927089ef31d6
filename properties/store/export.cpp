#include <store/merge.hpp>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <support/json.hpp>
#include <support/json_number.hpp>
#include <support/progress.hpp>
#include <support/text.hpp>
#include <tuple>

namespace liecheck::properties {

namespace {

using nlohmann::json;

json key_of(const StoredSeries& s) {
  return {{"subject", s.subject}, {"scalar", s.scalar}, {"property", s.property}};
}

json key_of(const StoredSeries& s, const char* what, const Cell& cell) {
  json key = key_of(s);
  const Label& l = s.labels.at(cell);
  key.update(
      {{what, {cell.first, cell.second}}, {"operation", l.operation}, {"block", l.block}, {"band", l.band}});
  return key;
}

std::string series_line(const StoredSeries& s) {
  auto disagreed = s.tally.disagreed;
  std::sort(disagreed.begin(), disagreed.end());
  json done = json::array();
  for (const auto& [first, last] : s.tally.done) done.push_back({first, last});
  json line = key_of(s);
  line.update({{"series", s.robot},
               {"profile", s.profile},
               {"version", printable(s.subject_version)},
               {"cases", s.tally.cases},
               {"done", done},
               {"fast", s.tally.fast},
               {"checked", s.tally.checked},
               {"disagreed", disagreed},
               {"coverage", s.tally.coverage.text()},
               {"inputs", hexadecimal(s.tally.inputs.sum())},
               {"results", hexadecimal(s.tally.results.sum())}});
  return dumped(line) + "\n";
}

std::string cell_line(const StoredSeries& s, const Cell& cell, const Row& r) {
  json histogram = json::array();
  for (const auto& [bin, n] : r.errors.bins()) histogram.push_back({bin, n});
  json line = key_of(s, "cell", cell);
  line.update(
      {{"count", r.count},
       {"ill_posed", r.ill_posed},
       {"unresolved", r.unresolved},
       {"not_finite", r.not_finite},
       {"wrong_branch", r.wrong_branch},
       {"refused", r.refused},
       {"failed", r.failed},
       {"unmeasured", r.unmeasured},
       {"not_repeatable", r.not_repeatable},
       {"argument_written", r.argument_written},
       {"output_unwritten", r.output_unwritten},
       {"outside_domain", r.outside_domain},
       {"crashed", r.crashed},
       {"environment_changed", r.environment_changed},
       {"printed", r.printed},
       {"max_error", number(r.max_error)},
       {"max_excess", number(r.max_excess)},
       {"worst",
        {{"index", r.worst_index}, {"score", number(r.worst_score)}, {"kappa", number(r.worst_kappa)}}},
       {"histogram", histogram}});
  return dumped(line) + "\n";
}

std::string failure_line(const StoredSeries& s, const Cell& cell, const Failure& failure) {
  json line = key_of(s, "failure", cell);
  line.update({{"index", failure.index}, {"input", failure.input}});
  return dumped(line) + "\n";
}

/// The series in the order of subject, scalar, property and robot.
std::vector<const StoredSeries*> sorted_series(const StoredCampaign& c) {
  std::vector<const StoredSeries*> sorted;
  for (const StoredSeries& s : c.series) sorted.push_back(&s);
  const auto key = [](const StoredSeries* s) {
    return std::tie(s->subject, s->scalar, s->property, s->robot);
  };
  std::sort(sorted.begin(), sorted.end(), [&](auto* a, auto* b) { return key(a) < key(b); });
  return sorted;
}

}  // namespace

std::string export_text(const StoredCampaign& c) {
  SetDigest inputs, results;
  std::uint64_t total = 0, failed = 0;
  const auto all = sorted_series(c);
  for (const StoredSeries* s : all) {
    inputs.merge(s->tally.inputs);
    results.merge(s->tally.results);
    total += s->tally.cases;
    for (const auto& [cell, row] : s->tally.rows) failed += row.failed;
  }
  const CampaignSpec& p = c.spec;
  json limits = json::object();  // by subject; without the file's name, which may differ
  for (const auto& own : p.limits) limits[own->subject] = hash_of(*own);
  const json head = {
      {"campaign", {{"seed", p.seed}, {"cases", p.cases}, {"first", p.first}, {"last", p.last}}},
      {"program", p.program},
      {"generator", p.generator},
      {"budgets", p.budgets},
      {"robot", p.robot.hash},
      {"limits", limits},
      {"complete", c.complete()},
      {"failed", failed},
      {"total_cases", total},
      {"inputs", hexadecimal(inputs.sum())},
      {"results", hexadecimal(results.sum())}};
  std::string text = dumped(head) + "\n";
  for (const StoredSeries* s : all) text += series_line(*s);
  Counted rows("writing as text");
  for (const StoredSeries* s : all)
    for (const auto& [cell, row] : s->tally.rows) rows.next(), text += cell_line(*s, cell, row);
  for (const StoredSeries* s : all)
    for (const auto& [cell, failure] : s->failures) rows.next(), text += failure_line(*s, cell, failure);
  return text;
}

}  // namespace liecheck::properties
