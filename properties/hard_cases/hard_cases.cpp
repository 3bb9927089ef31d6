#include <hard_cases/hard_cases.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <atomic>
#include <campaign/expected.hpp>
#include <hard_cases/attempt.hpp>
#include <invariants/tree_laws.hpp>
#include <stdexcept>
#include <support/progress.hpp>
#include <support/stop.hpp>
#include <support/threads.hpp>
#include <tuple>

namespace liecheck::properties {

namespace {

constexpr struct {
  const char* name;
  char letter;
} descriptions[] = {{"stable", 'S'},       {"refused", 'R'},    {"ill-posed", 'P'},
                    {"unmeasured", 'M'},   {"unresolved", 'U'}, {"inaccurate", 'I'},
                    {"wrong branch", 'B'}, {"not finite", 'N'}, {"bad call", 'C'}};

Verdict verdict_of(const Judged& j, const Output& output) {
  switch (j.residual.outcome) {
    case Outcome::not_finite:
      return Verdict::not_finite;
    case Outcome::wrong_branch:
      return Verdict::wrong_branch;
    case Outcome::unresolved:
      return Verdict::unresolved;
    case Outcome::refused:
      return Verdict::refused;
    case Outcome::unmeasured:
      return Verdict::unmeasured;
    case Outcome::not_repeatable:
    case Outcome::argument_written:
    case Outcome::output_unwritten:
    case Outcome::crashed:
    case Outcome::environment_changed:
    case Outcome::printed:
      return Verdict::bad_call;
    case Outcome::outside_domain:  // run() has removed these
    case Outcome::measured:
    case Outcome::ill_posed:
      break;
  }
  if (j.ill_posed) return Verdict::ill_posed;
  if (!j.failed) return Verdict::stable;
  return output.block == "sign" ? Verdict::wrong_branch : Verdict::inaccurate;
}

HardCell cell_of(const Series& series, const CaseId& id, const Trial& trial) {
  HardCell cell;
  cell.subject = series.subject, cell.scalar = series.scalar;
  cell.refusal = trial.refusal;
  cell.id = id, cell.id.input = trial.input;
  cell.flags = subject_flags(series);
  if (trial.judged.empty()) cell.verdict = Verdict::unmeasured, cell.open = true;
  std::tuple<bool, Verdict, double> worst{false, Verdict::stable,
                                          -1};  // a result that fails is worse than one that does not
  for (const Judged& j : trial.judged) {
    const Output& output = series.outputs.at(j.residual.output);
    const Verdict verdict = verdict_of(j, output);
    const bool excess = j.budget->rule == Rule::excess;
    const double figure = excess ? j.excess : j.residual.error;
    // A limit of 0 requires an exact result: any error has an infinite score.
    const double score = figure == 0 ? 0 : figure / j.budget->limit;
    const bool failed = fails(series, j);
    cell.failed = cell.failed || failed;
    if (failed) cell.failing.push_back({output.operation, output.block, &series.bands(), j.residual.band});
    cell.open = cell.open || leaves_open(j.residual.outcome);
    if (std::tuple(failed, verdict, score) <= worst) continue;
    worst = {failed, verdict, score};
    cell.verdict = verdict;
    cell.operation = output.operation, cell.block = output.block;
    cell.band = series.bands()[j.residual.band].name;
    cell.error = j.residual.error, cell.kappa = j.residual.kappa;
    cell.budget = j.budget->limit, cell.excess = excess;
  }
  return cell;
}

/// One row for each case and law, with the series that it runs on.
struct Task {
  HardRow row;
  std::vector<const Series*> series;
};

std::vector<Task> tasks_of(const std::vector<HardCase>& cases, const Selection& selection,
                           const std::vector<std::unique_ptr<Series>>& all) {
  const auto known = property_names();
  std::vector<Task> tasks;
  for (const HardCase& c : cases)
    for (const std::string& property : c.properties) {
      if (!std::ranges::count(known, property))
        throw std::invalid_argument(
            fmt::format("{}: unknown property '{}'; known: {}", c.place(), property, fmt::join(known, ", ")));
      if (!selection.properties.empty() && !std::ranges::count(selection.properties, property)) continue;
      Task task{{&c, property, {}, {}}, {}};
      for (const auto& s : all) {
        if (s->property != property || (!c.scalars.empty() && !std::ranges::count(c.scalars, s->scalar)))
          continue;
        if (s->on_robot && is_tree_law(property)) continue;  // the case contains its tree
        if (s->on_robot)
          throw std::invalid_argument(fmt::format(
              "{}: property {} depends on the robot: no input fits every robot", c.place(), property));
        task.series.push_back(s.get());
        auto& input = task.row.input[s->scalar];
        if (input.empty()) input = numbers_of(c, s->fields, s->format());
      }
      if (!task.series.empty()) tasks.push_back(std::move(task));
    }
  return tasks;
}

/// Returns false if it was stopped; the row then lacks cells.
bool run(Task& task) try {
  for (const Series* s : task.series) {
    if (stop_requested) return false;
    CaseId id = s->id(0, 0);
    id.raw = true;
    id.input = task.row.input.at(s->scalar);
    Trial trial;
    try {
      trial = attempt(*s, id);
    } catch (const std::invalid_argument& e) {
      throw std::invalid_argument(
          fmt::format("{}: {}: {}", task.row.entry->place(), task.row.entry->name, e.what()));
    }
    task.row.input[s->scalar] = trial.input;
    const bool any = !trial.judged.empty();
    std::erase_if(trial.judged,
                  [](const Judged& j) { return j.residual.outcome == Outcome::outside_domain; });
    if (any && trial.judged.empty()) continue;  // wholly outside the subject's domain
    task.row.cells.push_back(cell_of(*s, id, trial));
  }
  return true;
} catch (const GivenUp&) {
  return false;
}

}  // namespace

const char* name_of(Verdict v) {
  return descriptions[static_cast<int>(v)].name;
}
char letter_of(Verdict v) {
  return descriptions[static_cast<int>(v)].letter;
}

std::vector<HardRow> run_hard_cases(const Selection& selection, const Robot& robot,
                                    const std::vector<HardCase>& cases, unsigned jobs) {
  const auto all = select(selection, robot);
  std::vector<Task> tasks = tasks_of(cases, selection, all);
  std::atomic<std::size_t> next{0};
  std::atomic<bool> stop{false};
  std::vector<char> ran(tasks.size(), 0);
  Steps steps("hard cases", tasks.size());
  run_on_threads(jobs, stop, [&] {
    for (std::size_t i = next++; i < tasks.size() && !stop && !stop_requested; i = next++) {
      ran[i] = run(tasks[i]);
      steps.done(tasks[i].row.entry->name);
    }
  });
  std::vector<HardRow> rows;
  for (std::size_t i = 0; i < tasks.size(); ++i)
    if (ran[i]) rows.push_back(std::move(tasks[i].row));
  return rows;
}

bool any_failed(const std::vector<HardRow>& rows) {
  return std::ranges::any_of(
      rows, [](const HardRow& r) { return std::ranges::any_of(r.cells, &HardCell::failed); });
}
bool any_open(const std::vector<HardRow>& rows) {
  return std::ranges::any_of(rows,
                             [](const HardRow& r) { return std::ranges::any_of(r.cells, &HardCell::open); });
}

}  // namespace liecheck::properties
