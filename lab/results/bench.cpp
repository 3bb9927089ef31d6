#include <results/bench.hpp>

#include <algorithm>
#include <history/bench.hpp>
#include <lattice/lattice.hpp>
#include <map>
#include <record/record.hpp>
#include <support/environment.hpp>
#include <support/json_number.hpp>

namespace liecheck::properties {

using nlohmann::json;

std::size_t BugBench::count(bool alike, bool only_killed) const {
  return static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), [&](const BugRow& r) {
    return r.alike() == alike && (r.killed || !only_killed);
  }));
}

bool BugBench::measured() const {
  return std::all_of(rows.begin(), rows.end(), [](const BugRow& bug) { return bug.not_measured.empty(); });
}

json record_of(const BugBench& b) {
  const auto row = [](const BugRow& bug) -> json {
    return {
        {"name", bug.name},
        {"fault", bug.fault},
        {"origin", bug.origin},
        {"killed", bug.killed},
        {"by", bug.by},
        {"not_measured", bug.not_measured},
        {"cases", bug.cases},
        {"seconds", bug.seconds},
        {"weaker_styles", std::map<std::string, bool>(bug.weaker_styles.begin(), bug.weaker_styles.end())}};
  };
  return {{"version", LIECHECK_VERSION},
          {"seed", b.seed},
          {"scalar", b.scalar},
          {"seconds_each", b.seconds_each},
          {"verdict", verdict_of(b.complete && (b.measured() || !b.passed()), b.passed())},
          {"bugs", list_of(b.rows, row)}};
}

json record_of(const HistoryBench& b) {
  const auto row = [](const HistoryRow& r) -> json {
    const HistoricBug& bug = *r.bug;
    return {{"name", bug.name},
            {"library", bug.library},
            {"source", bug.thread},
            {"operation", bug.forms.operation},
            {"inputs", bug.region},
            {"symptom", bug.symptom},
            {"wrong", bug.wrong},
            {"control", bug.kind == HistoryKind::control},
            {"verdict", r.verdict()},
            {"by", r.faulty.by},
            {"cases", r.faulty.cases},
            {"seconds", r.faulty.seconds},
            {"first", r.faulty.replay},
            {"outcome", r.faulty.outcome},
            {"digits_lost", r.faulty.digits_lost()},
            {"silent_cases", r.fixed.cases},
            {"accused_by", r.fixed.by}};
  };
  return {{"version", LIECHECK_VERSION},
          {"verdict", verdict_of(b.complete && (b.measured() || !b.passed()), b.passed())},
          {"seed", b.seed},
          {"scalar", "double"},
          {"cases", b.cases},
          {"from", b.from},
          {"rows", list_of(b.rows, row)}};
}

json record_of(const LatticeResult& r) {
  const auto row = [](const LatticeRow& fault) -> json {
    const FaultVerdict& v = fault.verdict;
    return {{"subject", fault.subject}, {"operation", fault.operation},
            {"block", fault.block},     {"change", fault.change},
            {"family", fault.family},   {"trigger", fault.trigger},
            {"share", v.share},         {"verdict", found_words[static_cast<std::size_t>(v.found)]},
            {"cases", v.cases},         {"by", v.by},
            {"judged", fault.judged}};
  };
  return {{"version", LIECHECK_VERSION},   {"verdict", verdict_of(r.complete, r.passed())},
          {"seed", r.options.seed},        {"scalar", r.options.scalar},
          {"cases", r.options.cases},      {"failures_of_base", r.failures_of_base},
          {"common", r.common()},          {"common_found", r.common_found()},
          {"faults", list_of(r.rows, row)}};
}

json record_of(const SpeedBench& b) {
  const auto row = [](const auto& rate) -> json {
    return {{"name", rate.first}, {"cases_per_second", rate.second}};
  };
  return {{"version", LIECHECK_VERSION},
          {"verdict", verdict_of(b.complete, !b.falsified)},
          {"seed", b.seed},
          {"environment", environment()},
          {"rows", list_of(b.rates, row)},
          {"all_laws", number(b.all_laws)},
          {"tree_laws", number(b.tree_laws)},
          {"exp6_over_rapidcheck", number(b.exp6_over_rapidcheck)},
          {"two_jobs_over_one", number(b.two_jobs_over_one)}};
}

json record_of(const WireBench& b) {
  const auto row = [](const WireBench::Row& r) -> json {
    return {{"name", r.name},
            {"cases_per_second", number(r.rate)},
            {"ratio", number(r.ratio)},
            {"least_ratio", number(r.least)},
            {"largest_ratio", number(r.most)}};
  };
  return {{"version", LIECHECK_VERSION},
          {"verdict", verdict_of(b.complete, !b.failed)},
          {"seed", b.seed},
          {"environment", environment()},
          {"jobs", b.jobs},
          {"rows", list_of(b.rows, row)}};
}

}  // namespace liecheck::properties
