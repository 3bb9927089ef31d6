#include <record/record.hpp>
#include <support/environment.hpp>
#include <support/json_number.hpp>
#include <timing/bands.hpp>
#include <timing/cost.hpp>

namespace liecheck::properties {

using nlohmann::json;

namespace {

json block_record(const BlockErrors& b) {
  return {{"block", b.block},
          {"measured", b.errors.size()},
          {"max_eps", number(b.largest())},
          {"p99_eps", number(b.quantile(0.99))},
          {"median_eps", number(b.quantile(0.5))},
          {"not_finite", b.not_finite},
          {"wrong_branch", b.wrong_branch},
          {"unresolved", b.unresolved},
          {"refused", b.refused}};
}

json ratio_record(const Ratio& r, double reference_ns) {
  if (r.processes == 0) return nullptr;
  return {{"ratio", r.median},
          {"low", r.low},
          {"high", r.high},
          {"ns", r.median * reference_ns},
          {"processes", r.processes}};
}

json set_record(const CostSet& set, double reference_ns) {
  json all = {{"set", set.set},
              {"inputs", set.inputs},
              {"throughput", ratio_record(set.throughput, reference_ns)},
              {"latency", ratio_record(set.latency, reference_ns)},
              {"instructions", set.instructions > 0 ? json(set.instructions) : json()},
              {"blocks", list_of(set.blocks, block_record)}};
  if (set.cycles > 0) all["cycles"] = set.cycles;
  if (set.interface.processes > 0) all["interface"] = ratio_record(set.interface, reference_ns);
  return all;
}

json row_records(const std::vector<CostRow>& rows, double reference_ns) {
  const std::vector<int> throughput = dominators(rows, &CostSet::throughput),
                         latency = dominators(rows, &CostSet::latency);
  const auto dominator = [&](int i) {
    return i < 0 ? json() : json(implementation_of(rows[static_cast<std::size_t>(i)]));
  };
  json all = json::array();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const CostRow& row = rows[i];
    const bool scored = !row.sets.back().blocks.empty();
    all.push_back(
        {{"subject", row.subject},
         {"version", row.version},
         {"scalar", row.scalar},
         {"operation", row.operation},
         {"eps", row.eps},
         {"error", scored ? number(error_of(row)) : json()},
         {"worst_block", worst_block(row)},
         {"dominated_throughput", dominator(throughput[i])},
         {"dominated_latency", dominator(latency[i])},
         {"sets", list_of(row.sets, [&](const CostSet& s) { return set_record(s, reference_ns); })}});
    if (!row.timed.empty()) all.back()["timed"] = row.timed;
  }
  return all;
}

json band_record(const CostBand& b) {
  return {
      {"band", b.name}, {"axis", b.from_pi ? "pi_minus_theta" : "theta"}, {"low", b.low}, {"high", b.high}};
}

}  // namespace

json record_of(const Spread& s) {
  if (s.repetitions == 0) return nullptr;
  return {{"median", s.median}, {"low", s.low}, {"high", s.high}, {"repetitions", s.repetitions}};
}

std::string implementation_of(const CostRow& row) {
  return row.subject + " " + row.scalar;
}

json record_of(const CostResult& r) {
  json where = environment();
  where["governor"] = frequency_governor();
  return {{"version", LIECHECK_VERSION},
          {"verdict", verdict_of(r.complete, true)},
          {"seed", r.options.seed},
          {"processes", r.options.processes},
          {"repetitions", r.options.repetitions},
          {"reference_ns", r.machine.reference_ns},
          {"disturbed", r.machine.disturbed},
          {"steady", r.machine.steady()},
          {"spread", r.machine.spread},
          {"seconds", r.options.seconds},
          {"elapsed", r.elapsed},
          {"clock", "processor time of the thread"},
          {"no_counter", r.no_counter},
          {"environment", where},
          {"bands", list_of(r.options.bands(), band_record)},
          {"rows", row_records(r.rows, r.machine.reference_ns)}};
}

}  // namespace liecheck::properties
