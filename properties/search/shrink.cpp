#include <invariants/property.hpp>
#include <search/shrink.hpp>

#include <algorithm>
#include <campaign/expected.hpp>
#include <campaign/series.hpp>
#include <chrono>
#include <generators/shrinks.hpp>
#include <optional>
#include <support/stop.hpp>

namespace liecheck::properties {

std::optional<Judged> failure_of(const std::vector<Judged>& judged, int output) {
  for (const Judged& j : judged)
    if (j.failed && j.residual.output == output) return j;
  return std::nullopt;
}

double score_of(const Series& series, const Judged& j) {
  return std::min(j.budget && j.budget->rule == Rule::excess ? j.excess : j.residual.error, 1 / series.eps);
}

Shrunk case_with(const Series& series, const CaseId& address, const std::vector<double>& x,
                 const Judged& failure) {
  Shrunk s{address, {}, failure};
  s.id.raw = true;
  s.id.input.clear();
  for (const double v : x) {
    s.id.input.push_back(hexadecimal_float(v));
    s.decimal.push_back(decimal_float(v, series.format()));
  }
  return s;
}

Shrunk shrink(const Series& series, const CaseId& address, int output, int evaluations) {
  const Property& law = series.tested_law();
  const std::vector<double> x = series.numbers(address);
  const std::optional<Judged> first = failure_of(series.measure_twice(x), output);
  const bool reproduced = first && first->residual.outcome != Outcome::not_repeatable;
  std::vector<double> small = x;
  Judged judged = first.value_or(Judged());
  if (reproduced) {
    const Outcome outcome =
        first->residual.outcome;  // a simpler input must fail in the same way, and as much
    // Each crash or endless loop costs the start of a process, so their inputs are simplified for 5 s only.
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
    const auto same_failure = [&](const std::vector<double>& y) -> std::optional<Judged> {
      if (!law.valid(y)) return std::nullopt;
      if (outcome == Outcome::crashed && std::chrono::steady_clock::now() > end) return std::nullopt;
      const auto j = failure_of(is_misuse(outcome) ? series.measure_twice(y) : series.measure(y), output);
      if (!j || (!fails(series, *j) && fails(series, *first))) return std::nullopt;  // an expected failure
      const bool same =
          j->residual.outcome == outcome &&
          (outcome != Outcome::measured || 10 * score_of(series, *j) >= score_of(series, *first));
      return same ? j : std::nullopt;
    };
    small = shrink_input(
        x, series.fields, series.format(), [&](const auto& y) { return same_failure(y).has_value(); },
        evaluations, [&](const auto& y) { return law.simpler(y); });
    judged = same_failure(small).value_or(*first);
  }
  Shrunk s = case_with(series, address, small, judged);
  s.reproduced = reproduced;
  return s;
}

std::vector<double> shrink_input(std::vector<double> input, const std::vector<Field>& fields,
                                 const Scalar& scalar,
                                 const std::function<bool(const std::vector<double>&)>& still_fails,
                                 int evaluations, const Simpler& simpler) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(2);
  const auto exhausted = [&] {
    return evaluations-- <= 0 || stop_requested || std::chrono::steady_clock::now() > deadline;
  };
  const auto any_simpler = [&] {
    for (auto& attempt : simpler(input)) {
      if (exhausted()) return false;
      if (still_fails(attempt)) {
        input = std::move(attempt);
        return true;
      }
    }
    return false;
  };
  bool improved = true;
  while (improved) {
    improved = false;
    while (simpler && any_simpler()) improved = true;
    std::size_t from = 0;
    for (const Field& f : fields) {
      const auto size = static_cast<std::size_t>(f.size);
      const std::vector<double> group(input.begin() + static_cast<std::ptrdiff_t>(from),
                                      input.begin() + static_cast<std::ptrdiff_t>(from + size));
      for (const auto& candidate : shrinks::candidates(scalar, group, f.kind)) {
        if (candidate == group) break;  // later candidates are no simpler
        if (exhausted()) return input;
        std::vector<double> attempt = input;
        std::copy(candidate.begin(), candidate.end(), attempt.begin() + static_cast<std::ptrdiff_t>(from));
        if (still_fails(attempt)) {
          input = attempt;
          improved = true;
          break;
        }
      }
      from += size;
    }
  }
  return input;
}

}  // namespace liecheck::properties
