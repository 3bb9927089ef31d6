#include <environments/measure.hpp>

#include <algorithm>
#include <atomic>
#include <campaign/robots.hpp>
#include <campaign/series.hpp>
#include <cmath>
#include <hard_cases/attempt.hpp>
#include <invariants/tree_laws.hpp>
#include <limits>
#include <mutex>
#include <support/stop.hpp>
#include <support/threads.hpp>

namespace liecheck::properties::environments {

namespace {

/// Sets mode_of_calls while it exists.
struct InMode {
  explicit InMode(const FloatMode& mode) { mode_of_calls = mode; }
  InMode(const InMode&) = delete;
  InMode& operator=(const InMode&) = delete;
  ~InMode() { mode_of_calls = {}; }
};

Verdict verdict_of(const Judged& j) {
  const bool excess = j.budget->rule == Rule::excess;
  return {j.residual.output, j.residual.outcome, j.failed, j.ill_posed, excess ? j.excess : j.residual.error,
          j.budget->limit};
}

bool is_small(const Scalar& scalar, double x) {
  return x != 0 && std::fabs(x) < scalar.least_denominator();
}

Case measured(const Series& s, const CaseId& id) {
  const std::vector<double> x = s.numbers(id);
  Case c;
  c.small = std::ranges::any_of(x, [&](double number) { return is_small(s.format(), number); }),
  c.id = id.text();
  const std::hash<std::string> hash;
  const Series::Checking checking(s, true);
  std::vector<Judged> judged = s.measure(x);
  checking.judge(judged);
  for (const CallLog::Noted& n : checking.log().results) {
    c.calls.emplace_back(hash(std::string(n.operation->name) + n.arguments + static_cast<char>(n.tree)),
                         hash(n.result));
    const auto at = std::ranges::find(s.outputs, n.operation->name, &Output::operation);
    c.call_operations.push_back(static_cast<std::uint16_t>(at - s.outputs.begin()));
  }
  for (const Judged& j : judged) c.verdicts.push_back(verdict_of(j));
  return c;
}

Case hard(const Series& s, const HardCase& h) {
  const CaseId id = raw_case(s, h);
  const Trial trial = attempt(s, id);
  Case c;
  c.id = id.text();
  for (const std::string& number : trial.input)
    c.small = c.small || is_small(s.format(), parse_float(number, s.format()));
  for (const Judged& j : trial.judged) c.verdicts.push_back(verdict_of(j));
  return c;
}

/// Case-wise, `now` beside `before`.
void compare(const Measured::Law& law, const Case& before, const Case& now, Promise promise,
             std::map<std::pair<std::string, std::string>, Figures>& all) {
  const auto of = [&](std::uint16_t output) -> Figures& { return all[{law.outputs[output], law.scalar}]; };
  std::vector<bool> used(before.verdicts.size(), false);
  const double allowed = promise == Promise::fourfold ? 4 : 1;
  for (const Verdict& v : now.verdicts) {
    Figures& f = of(v.output);
    ++f.cases;
    std::size_t i = 0;
    while (i < used.size() && (used[i] || before.verdicts[i].output != v.output)) ++i;
    const Verdict* const was = i < used.size() ? &before.verdicts[i] : nullptr;
    if (was) used[i] = true;
    f.same_verdicts +=
        was && was->outcome == v.outcome && was->failed == v.failed && was->ill_posed == v.ill_posed;
    if (promise == Promise::flushed && now.small) {
      ++f.small;
      continue;
    }
    // A check that had no verdict there was not right.
    const bool was_right = was ? was->right() : std::ranges::all_of(before.verdicts, &Verdict::right);
    if (v.outcome != Outcome::measured) {
      const bool bad = v.failed || leaves_open(v.outcome);
      if (!was_right || !bad) continue;
      f.not_finite += v.outcome == Outcome::not_finite, f.wrong_branch += v.outcome == Outcome::wrong_branch;
      f.refused += v.outcome == Outcome::refused;
      ++f.worse;
      if (f.of_limit < std::numeric_limits<double>::infinity())
        f.of_limit = std::numeric_limits<double>::infinity(), f.worst = now.id,
        f.block = law.blocks[v.output];
      continue;
    }
    if (v.ill_posed) continue;
    const double ratio = v.error == 0 ? 0 : v.error / v.limit;
    if (was_right) f.worse += ratio > allowed;
    if (ratio > f.of_limit) f.of_limit = ratio, f.worst = now.id, f.block = law.blocks[v.output];
    if (was && was->outcome == Outcome::measured && !was->ill_posed)
      f.digits_lost =
          std::max(f.digits_lost, std::log10(std::max(1.0, v.error)) - std::log10(std::max(1.0, was->error)));
  }
  for (std::size_t k = 0; k < now.calls.size(); ++k) {
    if (now.call_operations[k] >= law.outputs.size()) continue;
    const auto same =
        std::ranges::find(before.calls, now.calls[k].first, &std::pair<std::size_t, std::size_t>::first);
    if (same == before.calls.end()) continue;  // it was called with another result of this environment
    Figures& f = of(now.call_operations[k]);
    ++f.calls, f.same_calls += same->second == now.calls[k].second;
  }
}

}  // namespace

void Figures::add(const Figures& o) {
  cases += o.cases, calls += o.calls, same_calls += o.same_calls, same_verdicts += o.same_verdicts;
  small += o.small, worse += o.worse, not_finite += o.not_finite, wrong_branch += o.wrong_branch;
  refused += o.refused;
  if (o.of_limit > of_limit) of_limit = o.of_limit, worst = o.worst, block = o.block;
  digits_lost = std::max(digits_lost, o.digits_lost);
}

std::optional<Measured> measure(const std::string& subject, Profile profile, const FloatMode& mode,
                                const MeasureOptions& options) {
  Selection selection;
  selection.subjects = {subject}, selection.properties = options.properties;
  selection.scalars = options.scalars.empty() ? std::vector<std::string>{"float", "double"} : options.scalars;
  selection.profiles[subject] = profile;
  const auto all = select(selection, built_in_robot());
  Measured m;
  struct Task {
    std::size_t law, at;
    const HardCase* hard;
  };
  std::vector<Task> tasks;
  for (const auto& s : all) {
    Measured::Law law{s->property, s->scalar, {}, {}, {}};
    for (const Output& o : s->outputs)
      law.outputs.emplace_back(o.operation), law.blocks.emplace_back(o.block);
    std::size_t n = 0;
    for (; n < options.cases; ++n) tasks.push_back({m.laws.size(), n, nullptr});
    for (const HardCase& h : built_in_corpus())
      if (options.hard_cases && concerns(h, *s)) tasks.push_back({m.laws.size(), n++, &h});
    law.cases.resize(n);
    m.laws.push_back(std::move(law));
  }
  const InMode in(mode);
  std::atomic<std::size_t> next{0};
  std::atomic<bool> stop{false};
  std::mutex mutex;
  std::size_t done = 0;
  run_on_threads(options.jobs, stop, [&] {
    for (std::size_t i = next++; i < tasks.size() && !stop && !stop_requested; i = next++) {
      const Task& t = tasks[i];
      m.laws[t.law].cases[t.at] =
          t.hard ? hard(*all[t.law], *t.hard) : measured(*all[t.law], all[t.law]->id(options.seed, t.at));
      const std::lock_guard lock(mutex);
      if (options.progress) options.progress(static_cast<double>(++done) / static_cast<double>(tasks.size()));
    }
  });
  if (stop_requested) return std::nullopt;
  return m;
}

std::map<std::pair<std::string, std::string>, Figures> compared(const Measured& before, const Measured& now,
                                                                Promise promise) {
  std::map<std::pair<std::string, std::string>, Figures> all;
  for (const Measured::Law& law : now.laws) {
    const auto same = std::ranges::find_if(before.laws, [&](const Measured::Law& l) {
      return l.property == law.property && l.scalar == law.scalar;
    });
    if (same == before.laws.end()) continue;
    for (std::size_t i = 0; i < law.cases.size() && i < same->cases.size(); ++i)
      compare(law, same->cases[i], law.cases[i], promise, all);
  }
  return all;
}

}  // namespace liecheck::properties::environments
