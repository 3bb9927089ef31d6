#include <app/sweep_command.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <app/store_commands.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <support/environment.hpp>
#include <support/files.hpp>
#include <support/progress.hpp>
#include <support/stop.hpp>

namespace liecheck::properties {
namespace {

using nlohmann::json;

std::vector<Coefficient> named(const std::vector<std::string>& names) {
  std::vector<Coefficient> all;
  std::vector<std::string> known;
  for (const CoefficientClaim& c : coefficient_claims()) known.push_back(c.name);
  for (const std::string& name : names) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end())
      throw std::invalid_argument(
          fmt::format("--coefficient: unknown coefficient '{}'; known: {}", name, fmt::join(known, ", ")));
    all.push_back(coefficient_claims()[static_cast<std::size_t>(found - known.begin())].coefficient);
  }
  return all;
}

const char* kind(const SweptCoefficient& c) {
  return oracles::is_absolute(c.claim->coefficient) ? "absolute" : "relative";
}

/// pass and fail are of every float; a sample that refutes nothing passes nothing.
const char* status(const SweepResult& r, const SweptCoefficient& c) {
  return r.failed(c) ? "fail" : r.upper_bound() ? "pass" : "sampled";
}

json number(double x) {
  return std::isfinite(x) ? json(x) : json("inf");
}

std::string shown(double x) {  // a bound: rounded up
  return std::isfinite(x) ? fmt::format("{:.5f}", std::ceil(x * 1e5) / 1e5) : "NaN or Inf";
}

}  // namespace

SweepResult run_sweep(const SweepFlags& f) {
  SweepOptions options;
  options.coefficients = named(f.coefficients);
  options.jobs = f.jobs;
  options.stride = f.stride;
  options.stop = &stop_requested;
  Progress progress("sweep");
  options.progress = [&](double share) {
    progress.show(share, [](double) { return std::string("of the floats"); });
  };
  return sweep(options);
}

json sweep_record(const SweepResult& r) {
  json rows = json::array();
  for (const SweptCoefficient& c : r.coefficients)
    rows.push_back({{"name", c.claim->name},
                    {"equation", c.claim->equation},
                    {"argument", c.claim->argument},
                    {"kind", kind(c)},
                    {"evaluated", c.evaluated},
                    {"constant", c.constant},
                    {"max_eps", number(c.max_eps)},
                    {"max_at", fmt::format("{:a}", c.max_at)},
                    {"max_at_decimal", c.max_at},
                    {"bound_eps", r.upper_bound() ? number(c.bound_eps) : json()},
                    {"oracle_bound_eps", c.oracle_bound_eps},
                    {"square_eps", c.square_eps},
                    {"documented_eps", c.claim->documented_eps},
                    {"reason", c.claim->reason},
                    {"status", status(r, c)}});
  return {{"version", LIECHECK_VERSION},
          {"verdict", r.failed()    ? "fail"
                      : !r.complete ? "incomplete"
                                    : "pass"},
          {"bound", r.upper_bound() ? "upper" : "lower"},
          {"scalar", "float"},
          {"stride", r.stride},
          {"elapsed", r.elapsed},
          {"environment", json::parse(environment_text())},
          {"coefficients", rows}};
}

void add_sweep(json& record, const SweepResult& result) {
  record["sweep"] = sweep_record(result);
  record["sweep"].erase("environment");  // the record's
  if (result.failed()) record["verdict"] = "fail";
}

int run_sweep_command(const SweepFlags& f) {
  if (!f.json.empty()) check_writable(f.json);
  const SweepResult r = run_sweep(f);
  fmt::print("{:<17}{:<10}{:>11}  {:>13}  {:<16}{:<15}{:>11}{:>9}  {}\n", "coefficient", "error", "floats",
             r.upper_bound() ? "bound [eps]" : "found [eps]", "at", "", "documented", "square", "status");
  for (const SweptCoefficient& c : r.coefficients)
    fmt::print("{:<17}{:<10}{:>11}  {:>13}  {:<16}{:<15.9g}{:>11}{:>9}  {}\n", c.claim->name, kind(c),
               c.evaluated,
               r.upper_bound()            ? shown(c.bound_eps)
               : std::isfinite(c.max_eps) ? fmt::format("{:.5f}", c.max_eps)
                                          : "NaN or Inf",
               fmt::format("{:a}", c.max_at), c.max_at, c.claim->documented_eps,
               c.square_eps > 0 ? fmt::format("{:.3f}", c.square_eps) : "-", status(r, c));
  double oracle = 0;
  for (const SweptCoefficient& c : r.coefficients) oracle = std::max(oracle, c.oracle_bound_eps);
  if (r.upper_bound())
    fmt::print(
        "\nbound: an upper bound of the error in float over every argument, the oracle's own error of at "
        "most "
        "{:.1e} eps included\n",
        oracle);
  else
    fmt::print("\nfound: {}, a lower bound of the maximum\n",
               r.complete ? fmt::format("the largest error at every {}th float", r.stride)
                          : "interrupted, the largest error so far");
  fmt::print(
      "square: what the rounding of x = theta^2 adds to first order, seen from theta [eps]\n{} in {:.1f} s\n",
      r.failed()        ? "verdict fail: a documented bound is false"
      : !r.complete     ? "verdict incomplete"
      : r.upper_bound() ? "verdict pass"
                        : "verdict pass: no documented bound refuted",
      r.elapsed);
  if (!f.json.empty()) write_whole(f.json, sweep_record(r).dump(1) + "\n");
  return !r.complete ? incomplete : r.failed() ? property_failed : within_budget;
}

}  // namespace liecheck::properties
