#include <fmt/format.h>
#include <algorithm>
#include <bounds/bounds.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <results/coefficients.hpp>
#include <stdexcept>
#include <support/progress.hpp>
#include <support/run_state.hpp>
#include <support/say.hpp>
#include <support/stop.hpp>
#include <support/text.hpp>
#include "lab_commands.hpp"

namespace liecheck::properties {

namespace {

struct BoundsFlags {
  BoundOptions options;
  std::string claim, state, json;
};

using nlohmann::json;

/// The bound that an earlier call proved, if it did.
std::optional<ProvedBound> proved_before(const RunState& state, const std::string& operation) {
  const json before = state.get(operation);
  if (before.is_null()) return std::nullopt;
  ProvedBound b = statement_of(operation);
  try {
    b.bound = before.at("bound"), b.worst = printable(before.at("worst").get<std::string>());
    if (before.at("boxes").is_number_unsigned()) b.boxes = before.at("boxes");
  } catch (const json::exception&) {
  }
  if (b.boxes == 0 || !(b.bound > 0 && b.bound < 1e15))
    throw std::invalid_argument(
        fmt::format("{}: '{}': a member is missing or of another type, or its bound is impossible",
                    state.file(), operation));
  return b;
}

/// Proves the bounds of the operations, with progress, and calls `done` for each, in order.
void run_bounds(BoundOptions options, const std::function<void(const ProvedBound&)>& done) {
  Progress progress("proofs");
  options.progress = [&](double share, const std::string& operation, double bound) {
    progress.show(share, fmt::format("{} at most {:.3g} eps", operation, bound));
  };
  prove_bounds(options, done);
}

int run(const BoundsFlags& f) {
  BoundOptions o = f.options;
  if (o.operations.empty()) o.operations = proved_operations();
  double claim = 0;
  if (!f.claim.empty()) {
    std::size_t used = 0;
    try {
      claim = std::stod(f.claim, &used);
    } catch (const std::exception&) {
    }
    if (used != f.claim.size() || !(claim > 0) || !std::isfinite(claim))
      throw std::invalid_argument(fmt::format("--claim: '{}' is not a positive number", f.claim));
    if (o.operations.size() != 1) throw std::invalid_argument("--claim needs one --operation");
    o.wanted = claim;
  }
  o.operations = without_repeats(o.operations);
  RunState state(f.state, {{"bounds_of_liecheck", LIECHECK_VERSION}, {"boxes", o.boxes}});
  stop_on_signals();
  std::vector<ProvedBound> rows;
  bool failed = false;
  say("{:<24}{:<17}{:>10}{:>10}{:>8}{:>8}{:>10}  {}\n", "operation", "block", "hunted", "proved", "ratio",
      "limit", "boxes", "[eps]; the proved bound holds for");
  const auto show = [&](const ProvedBound& b) {
    std::string why;
    if (b.contradicted())
      why = "  FAILED: a search found more than is proved";
    else if (claim > 0 && b.bound > claim && !stop_requested)
      why = fmt::format("  FAILED: {} eps is not proved; the largest bound is at {}", f.claim, b.worst);
    failed = failed || !why.empty();
    if (why.empty() && claim > 0 && b.bound > claim) why = "  stopped before a proof of the claim";
    say("{:<24}{:<17}{:>10.3g}{:>10.3f}{:>8.2f}{:>8.3g}{:>10}  {}{}\n", b.operation, b.block, b.hunted,
        std::ceil(b.bound * 1000) / 1000, b.bound / b.hunted, b.limit, b.boxes, b.inputs, why);
    std::fflush(stdout);
    rows.push_back(b);
  };
  std::vector<std::string> open;
  for (const std::string& name : o.operations)
    if (const auto done = proved_before(state, name))
      show(*done);
    else
      open.push_back(name);
  if (!open.empty()) {
    o.operations = open;
    run_bounds(o, [&](const ProvedBound& b) {
      show(b);
      if (b.boxes >= o.boxes && std::isfinite(b.bound))
        state.put(b.operation, {{"bound", b.bound}, {"boxes", b.boxes}, {"worst", b.worst}});
    });
  }
  // Without a finite bound nothing is proved.
  const bool complete = !stop_requested &&
                        std::all_of(rows.begin(), rows.end(), [](auto& b) { return std::isfinite(b.bound); });
  if (stop_requested)
    warn(fmt::format("interrupted: the bounds hold, and more boxes would lower them{}\n",
                     std::filesystem::exists(f.state) ? "; the same command goes on with " + f.state : ""));
  if (!f.json.empty()) write_record(f.json, record_of(rows, complete, failed));
  return failed ? property_failed : complete ? within_budget : incomplete;
}

}  // namespace

Command bounds_command(CLI::App& lab) {
  CommandWith<BoundsFlags> a(
      lab, "bounds",
      "prove upper bounds of the errors of whole operations. They hold for liecheck in double, "
      "and stand beside the largest errors that searches found. Exit code 0 if they agree; 1 if a search "
      "found more, or a claim is "
      "not proved; 2 for bad "
      "input; 3 if stopped, or if the boxes are too few for a bound");
  a.list("--operation", a->options.operations, "OP",
         "an operation that has a proof, repeatable; default all");
  a.number("--boxes", a->options.boxes, 1, 20'000'000,
           "boxes of inputs to evaluate for each operation: more of them lower the bound");
  a.text("--claim", a->claim, "EPS", "prove this bound of one operation, or fail");
  a.updated("--state", a->state, "FILE", "write each finished operation, and go on from there");
  a.jobs(a->options.jobs);
  a.json(a->json, "write the bounds to FILE");
  return a.runs(run);
}

}  // namespace liecheck::properties
