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

Shrunk shrink(const Series& series, const CaseId& address, int output, int evaluations) {
  const Property& law = series.tested_law();
  const std::vector<double> x = series.numbers(address);
  const auto failure_in = [&](const std::vector<Judged>& judged) -> std::optional<Judged> {
    for (const Judged& j : judged)
      if (j.failed && j.residual.output == output) return j;
    return std::nullopt;
  };
  const std::optional<Judged> first = failure_in(series.measure_twice(x));
  Shrunk s;
  s.reproduced = first && first->residual.outcome != Outcome::not_repeatable;
  std::vector<double> small = x;
  if (s.reproduced) {
    const Outcome outcome =
        first->residual.outcome;  // a simpler input must fail in the same way, and as much
    const auto score = [&](const Judged& j) {
      return std::min(j.budget && j.budget->rule == Rule::excess ? j.excess : j.residual.error,
                      1 / series.eps);
    };
    // Each crash or endless loop costs the start of a process, so their inputs are simplified for 5 s only.
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
    const auto failure_of = [&](const std::vector<double>& y) -> std::optional<Judged> {
      if (!law.valid(y)) return std::nullopt;
      if (outcome == Outcome::crashed && std::chrono::steady_clock::now() > end) return std::nullopt;
      const auto j = failure_in(is_misuse(outcome) ? series.measure_twice(y) : series.measure(y));
      if (!j || (!fails(series, *j) && fails(series, *first))) return std::nullopt;  // an expected failure
      const bool same =
          j->residual.outcome == outcome && (outcome != Outcome::measured || 10 * score(*j) >= score(*first));
      return same ? j : std::nullopt;
    };
    small = shrink_input(
        x, series.fields, series.format(), [&](const auto& y) { return failure_of(y).has_value(); },
        evaluations, [&](const auto& y) { return law.simpler(y); });
    s.judged = failure_of(small).value_or(*first);
  } else if (first) {
    s.judged = *first;
  }
  s.id = address;
  s.id.raw = true;
  s.id.input.clear();
  for (const double v : small) {
    s.id.input.push_back(hexadecimal_float(v));
    s.decimal.push_back(decimal_float(v, series.format()));
  }
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
