// What the errors of Euler angles near gimbal lock tell.

#include <fmt/format.h>
#include <cmath>
#include <conventions/reference.hpp>
#include <failures/blocks.hpp>
#include <failures/calls.hpp>
#include <failures/shapes.hpp>
#include <numbers>
#include <oracles/orientations.hpp>
#include <search/condition.hpp>
#include <set>
#include <support/line_fit.hpp>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

/// The errors over a feature: the slope of their logarithms, 0 if it is not known; the largest value at which more than a
/// thousandth is wrong; the largest one below which most errors are of the size of the feature, and the next one.
struct ErrorsOver {
  double slope = 0, wrong_up_to = -1, as_large_up_to = -1, less_from = -1;
};
ErrorsOver errors_over(const Condition& c) {
  ErrorsOver all;
  LineFit fit;
  double as_large = 0;
  for (const auto& [value, error] : c.errors) {
    const double a = std::log(value), b = std::log(error);
    if (!std::isfinite(a) || !std::isfinite(b)) continue;
    fit.add(a, b);
    if (error > 1e-3) all.wrong_up_to = value;
    const bool like = error > 0.05 * value && error < 3 * value;
    as_large += like;
    if (like && as_large >= 3 && as_large >= 0.8 * fit.count())
      all.as_large_up_to = value, all.less_from = -1;
    if (!like && all.less_from < 0) all.less_from = value;
  }
  if (fit.count() >= 5) all.slope = fit.slope();
  return all;
}

/// Where the angles are no longer those of gimbal lock, of which one is 0 and another the sum of two, between two angles from it, by
/// bisection of plain rotations; the middle of both if these show no such place.
double lock_threshold(const FailedBlock& f, double low, double high) try {
  const Series& series = *f.worst->series;
  const Operation& operation = *series.outputs.at(f.worst->output).record;
  const std::string to = operation.name == "euler_from_matrix" ? "euler_to_matrix" : "euler_to_quaternion";
  const auto is_at_lock = [&](int number, double sign, double from_lock) {
    const oracles::Order order(number);
    const bool proper = order.axes[0] == order.axes[2];
    const double right = 0.7, b = proper ? (sign > 0 ? from_lock : std::numbers::pi - from_lock)
                                         : sign * (std::numbers::pi / 2 - from_lock);
    std::vector<double> arguments{double(number)};
    for (const oracles::Real& x :
         conventions::exact_result(conventions::operation_named(to), {number, right, b, 0.4}))
      arguments.push_back(static_cast<double>(x));
    const std::vector<double> angles = result_of(series, operation, arguments);
    return angles.size() == 3 && std::fabs(angles[0] - right) > 0.1;
  };
  std::set<double> orders;
  for (const NotedCall& call : sampled_calls(series, f.worst->output)) orders.insert(call.arguments.at(0));
  for (const double order : orders)
    for (const double sign : {1.0, -1.0}) {
      double from = low / 2, to_angle = high * 2;
      const auto at = [&](double angle) { return is_at_lock(static_cast<int>(order), sign, angle); };
      if (stop_requested || !at(from) || at(to_angle)) continue;
      for (int k = 0; k < 10; ++k) {
        const double middle = std::sqrt(from * to_angle);
        (at(middle) ? from : to_angle) = middle;
      }
      return std::sqrt(from * to_angle);
    }
  return std::sqrt(low * high);
} catch (const GivenUp&) {  // a signal ended a call
  return std::sqrt(low * high);
}

}  // namespace

std::string near_gimbal_lock(const FailedBlock& f) {
  constexpr std::uint64_t any_seed = 42;
  const auto c = condition_of(*f.worst->series, f.worst->output, any_seed);
  if (!c || c->feature != Feature::lock) return "";
  const ErrorsOver errors = errors_over(*c);
  if (4 * f.worst->row->not_finite > f.worst->row->failed) {
    for (const NotedCall& call : sampled_calls(*f.worst->series, f.worst->output))
      if (call.result.size() == 3 &&
          std::isfinite(call.result[1]) &&  // the middle angle has an asin, the others quotients
          !(std::isfinite(call.result[0]) && std::isfinite(call.result[2])))
        return "0/0 at gimbal lock: atan of a quotient in place of atan2";
    return "asin or acos of a number beyond 1 or -1";
  }
  // Rounding makes large errors next to gimbal lock only, another formula wherever it is used.
  if (errors.wrong_up_to > 0 && errors.wrong_up_to < 1e-3 * c->high)
    return "near gimbal lock, atan2 of numbers that are 0 but for rounding: the error grows as 1 / (the "
           "angle from it), "
           "since two angles are computed each by itself";
  if (c->high < 1e-12)
    return "at gimbal lock alone, one of the angles is wrong: there, two turn about one axis, by their sum "
           "or difference";
  if (errors.as_large_up_to > 4 * std::sqrt(f.worst->series->eps) && 10 * errors.as_large_up_to < c->high)
    return fmt::format(
        "a threshold: less than {:.2g} rad from gimbal lock, the angles are computed as if they were at it; "
        "above "
        "it, rounding costs digits, the more the nearer to gimbal lock",
        lock_threshold(f, errors.as_large_up_to, std::max(errors.as_large_up_to, errors.less_from)));
  if (errors.slope > 0.5)
    return fmt::format(
        "a threshold: less than {:.2g} rad from gimbal lock, the angles are computed as if they were at it",
        c->high);
  const BandOf& worst = *f.worst;
  if (errors.slope > -0.3 && f.score * worst.series->eps > 1e-3)
    return fmt::format(
        "another formula at gimbal lock, which is wrong: it is used less than {:.2g} rad from it", c->high);
  const double digits = -std::log10(f.score * worst.series->eps), half = -std::log10(worst.series->eps) / 2;
  return std::fabs(digits - half) < 1 ? "asin or acos of a number near 1 or -1, which keeps half of the "
                                        "digits; atan2 of both parts does not"
                                      : "";
}

}  // namespace liecheck::properties
