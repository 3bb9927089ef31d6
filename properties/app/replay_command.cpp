#include <fmt/format.h>
#include <algorithm>
#include <app/command.hpp>
#include <campaign/expected.hpp>
#include <campaign/robots.hpp>
#include <campaign/selection.hpp>
#include <failures/description.hpp>
#include <failures/result.hpp>
#include <hard_cases/attempt.hpp>
#include <memory>
#include <stdexcept>
#include <support/say.hpp>

namespace liecheck::properties {

namespace {

struct ReplayFlags {
  std::string id;
  RobotFlags robot;
  AdapterFlags adapters;
  LimitsFlags limits;
};

/// Throws std::invalid_argument if the case belongs to no series, or to a series on another robot.
std::unique_ptr<Series> series_of(const CaseId& id, const std::string& text, const Robot& robot,
                                  const LimitsFlags& limits) {
  auto found = select(limits.judging({{id.subject}, {id.property}, {id.scalar}}), robot);
  if (found.empty())
    throw std::invalid_argument(
        fmt::format("{} in {} does not offer {}", id.subject, id.scalar, id.property));
  const Series& series = *found.front();
  if (!series.on_robot && id.robot != series.robot && !(id.raw && id.robot == "none"))
    throw std::invalid_argument(fmt::format("case ID '{}' names robot {}, but {} takes no robot: expected {}",
                                            text, id.robot, id.property, series.robot));
  if (series.on_robot && series.robot != id.robot)
    throw std::invalid_argument(
        fmt::format("case ID names robot {}, but this robot is {}: give the right URDF with --robot",
                    id.robot, series.robot));
  return std::move(found.front());
}

/// A line for each output. A measurement without an error has its outcome in the error's place.
void print_judged(const Series& series, const Judged& j) {
  const Output& o = series.outputs.at(j.residual.output);
  const Outcome outcome = j.residual.outcome;
  const bool measured = outcome == Outcome::measured || outcome == Outcome::ill_posed;
  const std::string error =
      measured
          ? fmt::format("{:>12.5g} eps  {:<22}{}", j.residual.error, fmt::format("{:a}", j.residual.error),
                        j.residual.kappa > 0 ? fmt::format(" kappa {:.3g}", j.residual.kappa) : "")
          : std::string(outcome_words[static_cast<int>(outcome)]);
  say("{:<26}{:<22}{:<24}{:<55} {}\n", o.operation, o.block, series.bands()[j.residual.band].name, error,
      fails(series, j)                     ? "FAIL"
      : j.failed                           ? "expected failure"
      : leaves_open(outcome)               ? "no verdict"
      : outcome == Outcome::outside_domain ? "not judged"
      : j.ill_posed                        ? "ill-posed"
                                           : "pass");
}

/// What was returned beside what is right, for each output that failed, or for all if none did.
void print_results(const Series& series, const CaseId& id, const Trial& trial) {
  const bool any = std::ranges::any_of(trial.judged, &Judged::failed);
  for (const Judged& j : trial.judged) {
    if (any && !j.failed) continue;
    const Output& o = series.outputs.at(j.residual.output);
    say("\n{}, block {}\n{}", o.operation, o.block, case_text(series, id, trial.input, j));
  }
}

int run(const ReplayFlags& f) {
  const CaseId id = CaseId::parse(f.id);
  f.adapters.start();
  const auto series = series_of(id, f.id, f.robot.read(), f.limits);
  const Trial trial = attempt(*series, id);
  say("{}: {}\n  law       {}\n  subject   {} {} in {}\n{}\n", series->property, series->law,
      series->equation, series->subject, series->subject_version, series->scalar,
      input_text(*series, trial.input));
  bool failed = false, open = false, decided = false;
  const bool answered = std::ranges::any_of(
      trial.judged, [](const Judged& j) { return j.residual.outcome == Outcome::wrong_branch; });
  if (!trial.refusal.empty()) say("{}: {}\n", answered ? "not as stated" : "refused", trial.refusal);
  for (const Judged& j : trial.judged) {
    open = open || leaves_open(j.residual.outcome);
    decided = decided || !j.ill_posed;
    if (!j.failed && j.residual.outcome == Outcome::refused) continue;  // refused as required
    failed = failed || fails(*series, j);
    print_judged(*series, j);
  }
  print_results(*series, id, trial);
  if (!failed && (open || !decided))
    say("incomplete: {}\n", open ? "no verdict on every output" : "nothing was measured");
  return failed ? property_failed : open || !decided ? incomplete : within_budget;
}

}  // namespace

Command replay_command(CLI::App& program) {
  CommandWith<ReplayFlags> a(
      program, "replay",
      "run one case again and print its errors, bit for bit. Exit code 0 if they are within "
      "their limits; 1 if "
      "not; 2 for bad input; 3 if an output has no verdict");
  a.text("ID", a->id, "", "the case's address, as a failure or a report prints it").required();
  a->robot.add(a, "the robot that the ID names");
  a->adapters.add(a);
  a->limits.add(a);
  return a.runs(run);
}

}  // namespace liecheck::properties
