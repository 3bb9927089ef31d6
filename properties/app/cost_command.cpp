#include <app/cost_command.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <app/store_commands.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <support/environment.hpp>
#include <support/files.hpp>
#include <support/progress.hpp>
#include <support/stop.hpp>
#include <timing/front.hpp>
#include <timing/inputs.hpp>

namespace liecheck::properties {
namespace {

using nlohmann::json;

json number(double x) {
  return std::isfinite(x) ? json(x) : json("inf");
}

/// Of the core that is asked first; "not told" in a virtual machine that has none.
std::string governor() {
  std::ifstream file("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
  std::string name;
  return std::getline(file, name) ? name : "not told";
}

json spread(const Spread& s) {
  if (s.repetitions == 0) return nullptr;
  return {{"median", s.median}, {"low", s.low}, {"high", s.high}, {"repetitions", s.repetitions}};
}

json set_of(const CostSet& set) {
  json blocks = json::array();
  for (const BlockErrors& b : set.blocks)
    blocks.push_back({{"block", b.block},
                      {"measured", b.errors.size()},
                      {"max_eps", number(b.largest())},
                      {"p99_eps", number(b.quantile(0.99))},
                      {"median_eps", number(b.quantile(0.5))},
                      {"not_finite", b.not_finite},
                      {"wrong_branch", b.wrong_branch},
                      {"unresolved", b.unresolved},
                      {"refused", b.refused}});
  return {{"set", set.set},
          {"inputs", set.inputs},
          {"throughput_ns", spread(set.throughput)},
          {"latency_ns", spread(set.latency)},
          {"instructions", set.instructions > 0 ? json(set.instructions) : json()},
          {"blocks", blocks}};
}

/// "liecheck double"
std::string point_name(const CostRow& row) {
  return row.subject + " " + row.scalar;
}

std::string time_text(const Spread& s) {
  if (s.repetitions == 0) return "-";
  const auto ns = [](double x) { return x < 1000 ? fmt::format("{:.4g}", x) : fmt::format("{:.0f}", x); };
  return fmt::format("{} [{}, {}]", ns(s.median), ns(s.low), ns(s.high));
}

void print_rows(const CostResult& r) {
  const auto by = dominators(r.rows, TimeOf::latency);
  std::string operation;
  for (std::size_t i = 0; i < r.rows.size(); ++i) {
    const CostRow& row = r.rows[i];
    if (row.operation != operation) {
      operation = row.operation;
      fmt::print("\n{:<24}{:<11}{:<26}{:<26}{:>8}{:>10}{:>10}{:>10}  {:<18}{}\n", operation, "",
                 "latency [ns]", "throughput [ns]", "instr.", "max", "p99", "median", "block [eps]",
                 "dominated by");
    }
    const CostSet& all = row.sets.back();
    fmt::print("{:<24}{:<11}{:<26}{:<26}{:>8}", row.subject, row.scalar, time_text(all.latency),
               time_text(all.throughput),
               all.instructions > 0 ? fmt::format("{:.0f}", all.instructions) : "-");
    const std::string worst = worst_block(row);
    for (const BlockErrors& b : all.blocks)
      if (b.block == worst)
        fmt::print("{:>10}{:>10.3g}{:>10.3g}  {:<18}{}",
                   std::isinf(error_of(row)) ? "no result" : fmt::format("{:.3g}", b.largest()),
                   b.quantile(0.99), b.quantile(0.5), worst,
                   by[i] < 0 ? "" : point_name(r.rows[static_cast<std::size_t>(by[i])]));
    fmt::print("\n");
  }
}

}  // namespace

CostResult run_cost(const CostFlags& f) {
  CostOptions options = f.options;
  options.stop = &stop_requested;
  Progress progress("cost");
  options.progress = [&](double share) {
    progress.show(share, [](double) { return std::string("of the repetitions"); });
  };
  CostResult r = measure_cost(options);
  // One operation after the other, as their table lists them; of each from the least to the most digits.
  const auto names = cost_operations();
  std::stable_sort(r.rows.begin(), r.rows.end(), [&](const CostRow& a, const CostRow& b) {
    return std::find(names.begin(), names.end(), a.operation) <
           std::find(names.begin(), names.end(), b.operation);
  });
  return r;
}

json cost_record(const CostResult& r) {
  json rows = json::array(), bands = json::array();
  const std::vector<int> by[] = {dominators(r.rows, TimeOf::throughput), dominators(r.rows, TimeOf::latency)};
  const auto dominator = [&](int i) {
    return i < 0 ? json() : json(point_name(r.rows[static_cast<std::size_t>(i)]));
  };
  for (std::size_t i = 0; i < r.rows.size(); ++i) {
    const CostRow& row = r.rows[i];
    json sets = json::array();
    for (const CostSet& set : row.sets) sets.push_back(set_of(set));
    const bool scored = !row.sets.back().blocks.empty();
    rows.push_back({{"subject", row.subject},
                    {"version", row.version},
                    {"scalar", row.scalar},
                    {"operation", row.operation},
                    {"eps", row.eps},
                    {"error", scored ? number(error_of(row)) : json()},
                    {"worst_block", worst_block(row)},
                    {"dominated_throughput", dominator(by[0][i])},
                    {"dominated_latency", dominator(by[1][i])},
                    {"sets", sets}});
  }
  for (const CostBand& b : cost_bands)
    bands.push_back({{"band", b.name},
                     {"axis", b.from_pi ? "pi_minus_theta" : "theta"},
                     {"low", b.low},
                     {"high", b.high}});
  json environment = json::parse(environment_text());
  environment["governor"] = governor();
  return {{"version", LIECHECK_VERSION},
          {"verdict", r.complete ? "pass" : "incomplete"},
          {"seed", r.options.seed},
          {"repetitions", r.options.repetitions},
          {"seconds", r.options.seconds},
          {"elapsed", r.elapsed},
          {"clock", "processor time of the thread"},
          {"no_counter", r.no_counter},
          {"environment", environment},
          {"bands", bands},
          {"rows", rows}};
}

void add_cost(json& record, const CostResult& result) {
  record["cost"] = cost_record(result);
}

int run_cost_command(const CostFlags& f) {
  if (!f.json.empty()) check_writable(f.json);
  const CostResult r = run_cost(f);
  const json record = cost_record(r), &e = record["environment"];
  const auto text = [&](const char* name) { return e[name].get<std::string>(); };
  fmt::print("{}, governor {}, {}, {}, {}\n", text("cpu"), text("governor"), text("os"), text("compiler"),
             text("flags"));
  fmt::print(
      "time: processor time of a call, the median of at most {} undisturbed repetitions in random order, and "
      "the\n"
      "  interval that holds it with 95 %; the row call is the shortest operation of the signature, not "
      "subtracted\n"
      "error: the largest found (a lower bound), 99 % and median of the worst block, in eps of the scalar, "
      "over the\n"
      "  inputs that were timed; dominated: another is faster and errs no more, by latency\n"
      "instructions: {}\n",
      r.options.repetitions,
      r.no_counter.empty() ? "retired in user space, per call" : "not counted, " + r.no_counter);
  print_rows(r);
  fmt::print("\n{} rows in {:.1f} s, seed {}{}\n", r.rows.size(), r.elapsed, r.options.seed,
             r.complete ? "" : "; interrupted: what was done");
  if (!f.json.empty()) write_whole(f.json, record.dump(1) + "\n");
  return r.complete ? within_budget : incomplete;
}

}  // namespace liecheck::properties
