#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <coefficients/slices.hpp>
#include <coefficients/sweep.hpp>
#include <nlohmann/json.hpp>
#include <results/coefficients.hpp>
#include <stdexcept>
#include <support/names.hpp>
#include <support/progress.hpp>
#include <support/say.hpp>
#include <support/stop.hpp>
#include "lab_commands.hpp"

namespace liecheck::properties {

namespace {

struct SweepFlags {
  std::vector<std::string> coefficients, operations, axes;
  std::string json;
  unsigned jobs = 1;
  std::uint32_t stride = 1;
};

std::vector<Coefficient> named(const std::vector<std::string>& names) {
  std::vector<Coefficient> all;
  check_known(names, names_of(coefficient_claims(), &CoefficientClaim::name), "--coefficient", "coefficient");
  for (const std::string& name : names)
    all.push_back(std::ranges::find(coefficient_claims(), name, &CoefficientClaim::name)->coefficient);
  return all;
}

/// Rounds an upper bound up. Rounds a measured error to nearest.
std::string bound_or_error(const SweepResult& r, const SweptCoefficient& c) {
  const double x = r.upper_bound() ? std::ceil(c.bound_eps * 1e5) / 1e5 : c.max_eps;
  return std::isfinite(x) ? fmt::format("{:.5f}", x) : "NaN or Inf";
}

void print_rows(const SweepResult& r) {
  say("{:<17}{:<10}{:>11}  {:>13}  {:<16}{:<15}{:>11}{:>9}  {}\n", "coefficient", "error", "floats",
      r.upper_bound() ? "bound [eps]" : "found [eps]", "at", "", "documented", "square", "status");
  for (const SweptCoefficient& c : r.coefficients)
    say("{:<17}{:<10}{:>11}  {:>13}  {:<16}{:<15.9g}{:>11}{:>9}  {}\n", c.claim->name, error_kind(c),
        c.evaluated, bound_or_error(r, c), fmt::format("{:a}", c.max_at), c.max_at, c.claim->documented_eps,
        c.square_eps > 0 ? fmt::format("{:.3f}", c.square_eps) : "-", status_of(r, c));
}

void print_summary(const SweepResult& r) {
  double oracle = 0;
  for (const SweptCoefficient& c : r.coefficients) oracle = std::max(oracle, c.oracle_bound_eps);
  if (r.upper_bound())
    say("\nbound: an upper bound of the error in float over every argument, including the oracle's own error "
        "of at most {:.1e} eps\n",
        oracle);
  else
    say("\nfound: {}, a lower bound of the maximum\n",
        r.complete ? fmt::format("the largest error at every {}th float", r.stride)
                   : "interrupted, the largest error so far");
  say("square: error due to the rounding of x = theta^2, to first order [eps]\n{} in {:.1f} s\n",
      r.failed()        ? "verdict fail: a documented bound is wrong"
      : !r.complete     ? "verdict incomplete"
      : r.upper_bound() ? "verdict pass"
                        : "verdict pass: no documented bound refuted",
      r.elapsed);
}

std::array<double, 3> axis(const std::string& text) {
  std::array<double, 3> v{};
  int end = 0;
  if (std::sscanf(text.c_str(), "%lf,%lf,%lf%n", &v[0], &v[1], &v[2], &end) != 3 || end != int(text.size()) ||
      !(std::hypot(v[0], v[1], v[2]) > 0) || !std::isfinite(std::hypot(v[0], v[1], v[2])))
    throw std::invalid_argument(
        fmt::format("--axis {}: not three numbers x,y,z of a vector other than 0", text));
  return v;
}

int run_slices(const SweepFlags& f) {
  SliceOptions options;
  if (f.operations != std::vector<std::string>{"all"}) options.operations = f.operations;
  for (const std::string& text : f.axes) options.axes.push_back(axis(text));
  options.stride = f.stride, options.jobs = f.jobs, options.stop = &stop_requested;
  Progress progress("sweep");
  options.progress = [&](double share) { progress.show(share, "of the angles"); };
  stop_on_signals();
  const std::vector<Slice> slices = sweep_slices(options);
  nlohmann::json rows = nlohmann::json::array();
  say("{:<24}{:<17}{:<34}{:>11}{:>10}{:>8}  {:<16}{}\n", "operation", "block", "axis", "angles", "max eps",
      "limit", "at theta", "");
  bool failed = false, complete = true;
  for (const Slice& s : slices) {
    failed |= s.failed(), complete &= s.complete;
    say("{:<24}{:<17}{:<34}{:>11}{:>10.4f}{:>8}  {:<16}{}\n", s.operation, s.block,
        fmt::format("{:.7g}, {:.7g}, {:.7g}", s.axis[0], s.axis[1], s.axis[2]), s.evaluated, s.max_eps,
        s.limit, fmt::format("{:a}", s.max_at),
        s.failed()   ? "FAIL"
        : s.complete ? "pass"
                     : "incomplete");
    rows.push_back({{"operation", s.operation},
                    {"block", s.block},
                    {"axis", s.axis},
                    {"rho", s.rho},
                    {"evaluated", s.evaluated},
                    {"max_eps", s.max_eps},
                    {"max_at", s.max_at},
                    {"limit", s.limit},
                    {"complete", s.complete && f.stride == 1}});
  }
  say("\n{}: phi = theta n rounded to float, for every {}theta in [0, pi]; rho is a random unit vector\n",
      complete && f.stride == 1 ? "certain maxima of these slices" : "lower bounds",
      f.stride == 1 ? "" : fmt::format("{}th ", f.stride));
  if (!f.json.empty())
    write_record(f.json, {{"verdict", !complete ? "stopped"
                                      : failed  ? "fail"
                                                : "pass"},
                          {"stride", f.stride},
                          {"slices", rows}});
  return !complete ? incomplete : failed ? property_failed : within_budget;
}

/// Sweeps the named coefficients, or all if none is named, with progress.
SweepResult run_sweep(const std::vector<std::string>& coefficients, unsigned jobs, std::uint32_t stride) {
  SweepOptions options;
  options.coefficients = named(coefficients);
  options.jobs = jobs;
  options.stride = stride;
  options.stop = &stop_requested;
  Progress progress("sweep");
  options.progress = [&](double share) { progress.show(share, "of the floats"); };
  return sweep(options);
}

int run(const SweepFlags& f) {
  if (!f.operations.empty()) return run_slices(f);
  if (!f.axes.empty()) throw std::invalid_argument("--axis needs --operation");
  stop_on_signals();
  const SweepResult r = run_sweep(f.coefficients, f.jobs, f.stride);
  do_both([&] { write_record_of(f.json, r); },
          [&] {
            print_rows(r);
            print_summary(r);
          });
  return !r.complete ? incomplete : r.failed() ? property_failed : within_budget;
}

}  // namespace

Command sweep_command(CLI::App& program) {
  CommandWith<SweepFlags> a(
      program, "sweep",
      "bound the error of each scalar coefficient over every float. Or find the "
      "largest error of whole operations at every float angle in [0, pi] about an axis, for one random rho. "
      "Exit code 0 if the "
      "documented bounds of the coefficients, or the limits of the operations, hold; 1 if one does not; 2 "
      "for bad input; 3 if stopped");
  const Flag coefficients =
      a.list("--coefficient", a->coefficients, "NAME", "a coefficient, repeatable; default all");
  a.list("--operation", a->operations, "OP",
         "a whole operation instead of a coefficient, repeatable, or 'all'")
      .excludes(coefficients);
  a.list("--axis", a->axes, "X,Y,Z",
         "an axis for --operation, repeatable; default x, and the one of 500 random axes with the largest "
         "error");
  a.number("--stride", a->stride, 1, 1u << 30,
           "evaluate only every Nth float, which is faster but gives a lower bound");
  a.jobs(a->jobs);
  a.json(a->json, "write the bounds to FILE");
  return a.runs(run);
}

}  // namespace liecheck::properties
