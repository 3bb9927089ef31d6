#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <rounding/digits.hpp>
#include <stdexcept>
#include <support/environment.hpp>
#include <support/json_number.hpp>
#include <support/say.hpp>
#include <support/stop.hpp>
#include "lab_commands.hpp"

namespace liecheck::properties {

namespace {

struct RoundingFlags {
  std::vector<std::string> subjects, operations;
  std::size_t inputs = 64, samples = 16;
  std::uint64_t seed = 42;
  std::string where, json;
  bool all = false;
};

/// A function without its arguments and those of its templates.
std::string short_name(const std::string& function) {
  std::string name;
  int depth = 0;
  for (const char c : function) {
    if (c == '(' && depth == 0) break;
    depth -= c == '>';
    if (depth == 0 && c != '<' && c != '>') name += c;
    depth += c == '<';
  }
  return name;
}

std::string digits(double x) {
  return std::isfinite(x) ? fmt::format("{:.1f}", x) : "-";
}

nlohmann::json json_of(const DigitsRow& r) {
  return {{"subject", r.subject},
          {"operation", r.operation},
          {"part", r.part},
          {"band", r.band},
          {"actual_digits", number(r.actual)},
          {"estimated_digits", number(r.estimated)},
          {"digits_all_at_random", number(r.without_exemption)},
          {"deceives", r.deceives()}};
}

int run(const RoundingFlags& f) {
  DigitsOptions options;
  options.subjects = without_repeats(f.subjects), options.operations = without_repeats(f.operations);
  options.inputs = f.inputs, options.samples = f.samples, options.seed = f.seed,
  options.stop = &stop_requested;
  if (!f.where.empty() && (f.subjects.size() != 1 || f.operations.size() != 1))
    throw std::invalid_argument("--where needs one --subject and one --operation");
  check_digits(options);
  stop_on_signals();
  nlohmann::json rows = nlohmann::json::array(), lines = rows;
  if (!f.where.empty()) {
    say("{:>7}  {:<44}  {}\n", "share", "line", "function");
    for (const RoundingLine& l : rounding_lines(options, f.where)) {
      if (l.share < 0.005 && !f.all) break;
      say("{:>6.1f}%  {:<44}  {}\n", 100 * l.share, l.place, short_name(l.function));
      lines.push_back({{"share", l.share}, {"line", l.place}, {"function", l.function}});
    }
  } else {
    say("digits of the root mean square error: of the result in double, by the oracle; and as random "
        "rounding estimates "
        "them, with error-free\ntransformations exact, and with all steps at random\n\n");
    say("{:<22}{:<26}{:<14}{:<20}{:>8}{:>11}{:>8}\n", "subject", "operation", "part", "band", "oracle",
        "estimated", "all");
    std::size_t deceived = 0, n = 0;
    measure_digits(options, [&](const DigitsRow& r) {
      ++n, deceived += r.deceives();
      rows.push_back(json_of(r));
      say("{:<22}{:<26}{:<14}{:<20}{:>8}{:>11}{:>8}{}\n", r.subject, r.operation, r.part, r.band,
          digits(r.actual), digits(r.estimated), digits(r.without_exemption),
          r.deceives()              ? "  deceives"
          : std::isnan(r.estimated) ? "  a result at random is not finite"
                                    : "");
      std::fflush(stdout);
    });
    say("\n{} of {} rows: random rounding promises more than a digit that the result does not have\n",
        deceived, n);
  }
  const bool whole = !stop_requested && !(rows.empty() && lines.empty());
  if (!f.json.empty()) {
    nlohmann::json record{{"rounding", 1},
                          {"version", LIECHECK_VERSION},
                          {"environment", environment()},
                          {"verdict", whole ? "measured" : "incomplete"},
                          {"seed", f.seed},
                          {"inputs", f.inputs},
                          {"samples", f.samples},
                          {"rows", rows}};
    if (!f.where.empty()) record["lines"] = lines;
    write_record(f.json, record);
  }
  if (stop_requested)
    warn("interrupted: the table is not complete\n");
  else if (!whole)
    warn(
        "nothing was measured: the subjects do not offer these operations, or no rounding moves their "
        "results in this band\n");
  return whole ? within_budget : incomplete;
}

}  // namespace

Command rounding_command(CLI::App& lab) {
  CommandWith<RoundingFlags> a(
      lab, "rounding",
      "estimate digits by random rounding: every arithmetic operation of a subject that is not exact rounds "
      "up or down by chance, and "
      "the spread of the results shows how many digits are right; print the oracle's beside them. Exit code "
      "0; "
      "2 for bad input; 3 if stopped, or if nothing was measured");
  a.list(
      "--subject", a->subjects, "NAME",
      fmt::format(
          "a subject, repeatable; default {}. Any other one is called in the four rounding modes, which is "
          "coarse",
          fmt::join(stochastic_subjects(), " and ")));
  a.list("--operation", a->operations, "OP", "an operation, repeatable; default every one");
  a.number("--inputs", a->inputs, 1, 1'000'000, "inputs of each band");
  a.number("--samples", a->samples, 2, 10'000, "runs with random rounding for each input");
  a.seed(a->seed, "seed of the inputs and of the rounding");
  a.text("--where", a->where, "BAND",
         "show instead the lines of the source whose roundings change the result most, in the band of this "
         "name; needs one "
         "--subject and one --operation");
  a.toggle("--all", a->all,
           "show every line of the source, not only those with at least half a percent of the spread");
  a.json(a->json, "write the rows to FILE");
  return a.runs(run);
}

}  // namespace liecheck::properties
