#include <search/shrink.hpp>

#include <algorithm>
#include <campaign/expected.hpp>
#include <campaign/typed_series.hpp>
#include <chrono>
#include <optional>

namespace liecheck::properties {
namespace {

template <class S>
Shrunk shrink_in(const TypedSeries<S>& series, const CaseId& address, int output, int evaluations) {
  const Property<S>& law = series.tested_law();
  const std::vector<S> x = series.numbers(address);
  const auto failure_in = [&](const std::vector<Judged>& judged) -> std::optional<Judged> {
    for (const Judged& j : judged)
      if (j.failed && j.residual.output == output) return j;
    return std::nullopt;
  };
  const std::optional<Judged> first = failure_in(series.measure_twice(x));
  Shrunk s;
  s.reproduced = first && first->residual.outcome != Outcome::not_repeatable;
  std::vector<S> small = x;
  if (s.reproduced) {
    const Outcome outcome =
        first->residual.outcome;  // a simpler input must fail in the same way, and as much
    const auto score = [&](const Judged& j) {
      return std::min(j.budget && j.budget->rule == Rule::excess ? j.excess : j.residual.error,
                      1 / series.eps);
    };
    // Each crash or endless loop costs the start of a process, so their inputs are simplified for 5 s only.
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
    const auto failure_of = [&](const std::vector<S>& y) -> std::optional<Judged> {
      if (!law.valid(y)) return std::nullopt;
      if (outcome == Outcome::crashed && std::chrono::steady_clock::now() > end) return std::nullopt;
      const auto j = failure_in(is_misuse(outcome) ? series.measure_twice(y) : series.measure(y));
      if (!j || (!fails(series, *j) && fails(series, *first))) return std::nullopt;  // an expected failure
      const bool same =
          j->residual.outcome == outcome && (outcome != Outcome::measured || 10 * score(*j) >= score(*first));
      return same ? j : std::nullopt;
    };
    small = shrink_input<S>(
        x, series.fields, [&](const auto& y) { return failure_of(y).has_value(); }, evaluations,
        [&](const auto& y) { return law.simpler(y); });
    s.judged = failure_of(small).value_or(*first);
  } else if (first) {
    s.judged = *first;
  }
  s.id = address;
  s.id.raw = true;
  s.id.input.clear();
  for (const S& v : small) {
    s.id.input.push_back(hexadecimal_float(v));
    s.decimal.push_back(decimal_float(v));
  }
  return s;
}

}  // namespace

Shrunk shrink(const Series& series, const CaseId& id, int output, int evaluations) {
  return with_scalar(series, [&](const auto& s) { return shrink_in(s, id, output, evaluations); });
}

}  // namespace liecheck::properties
