#include <search/shrink.hpp>

#include <campaign/typed_series.hpp>

namespace liecheck::properties {
namespace {

template <class S>
Shrunk shrink_in(const TypedSeries<S>& series, const CaseId& address, int output, int evaluations) {
  const Property<S>& law = series.tested_law();
  const std::vector<S> x = series.numbers(address);
  std::optional<Outcome> outcome;  // of the original input; a simpler input must fail in the same way
  const auto failure_of = [&](const std::vector<S>& y) -> std::optional<Judged> {
    if (!law.valid(y)) return std::nullopt;
    for (const Judged& j : series.measure(y))
      if (j.failed && j.residual.output == output && (!outcome || j.residual.outcome == *outcome)) return j;
    return std::nullopt;
  };
  if (const auto j = failure_of(x)) outcome = j->residual.outcome;
  const std::vector<S> small = shrink_input<S>(
      x, series.fields, [&](const auto& y) { return failure_of(y).has_value(); }, evaluations,
      [&](const auto& y) { return law.simpler(y); });
  Shrunk s;
  s.id = address;
  s.id.raw = true;
  for (const S& v : small) {
    s.id.input.push_back(hexadecimal_float(v));
    s.decimal.push_back(decimal_float(v));
  }
  if (const auto j = failure_of(small)) s.judged = *j;
  return s;
}

}  // namespace

Shrunk shrink(const Series& series, const CaseId& id, int output, int evaluations) {
  return with_scalar(series, [&](const auto& s) { return shrink_in(s, id, output, evaluations); });
}

}  // namespace liecheck::properties
