#include <hard_cases/attempt.hpp>

#include <campaign/typed_series.hpp>
#include <hard_cases/input_domain.hpp>

namespace liecheck::properties {
namespace {

template <class S>
Trial attempt_in(const TypedSeries<S>& series, const CaseId& address) {
  Trial trial;
  std::vector<S> x;
  if (address.raw) {
    x = series.parsed(address);
    std::vector<S> in_domain = x;
    trial.in_domain = !set_identity_where_off(series.fields, in_domain);
    series.check_valid(in_domain, address);
  } else {
    x = series.numbers(address);
  }
  for (const S& v : x) trial.input.push_back(hexadecimal_float(v));
  Judge balls = series.judge_of_balls();
  try {
    check_entrance(series.tested_subject().operations, series.fields, x);
    trial.judged = series.measure_by_digits(x, series.limits(), true, &trial.refusal);
    // Hard cases in the domain of the ball arithmetic also test the ball arithmetic.
    if (trial.in_domain && trial.refusal.empty() && series.measure_by_balls(x, balls) &&
        !agree(balls.judged, series.measure_by_digits(x, series.limits())))
      for (Judged& j : trial.judged) j.residual.outcome = Outcome::unresolved;
  } catch (const std::exception& e) {
    trial.refusal = e.what();
    balls.judged.clear();
    balls.outcome(series.outputs.front(), 0, Outcome::refused);
    trial.judged = std::move(balls.judged);
  }
  if (trial.in_domain) return trial;
  for (Judged& j : trial.judged) {
    if (j.residual.outcome == Outcome::refused) j.failed = false;
    // No answer exists for such an input: any result is on a wrong branch.
    if (j.residual.outcome == Outcome::unresolved)
      j.residual.outcome = Outcome::wrong_branch, j.failed = true;
  }
  return trial;
}

}  // namespace

Trial attempt(const Series& series, const CaseId& id) {
  return with_scalar(series, [&](const auto& s) { return attempt_in(s, id); });
}

}  // namespace liecheck::properties
