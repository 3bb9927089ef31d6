#include <failures/causes.hpp>

#include <algorithm>
#include <cmath>
#include <conventions/probe.hpp>
#include <conventions/reference.hpp>
#include <failures/calls.hpp>
#include <failures/pairs.hpp>
#include <failures/relations.hpp>
#include <failures/result.hpp>
#include <stdexcept>

namespace liecheck::properties {

namespace {

/// The numbers of a call's result that a block judges.
std::vector<std::size_t> numbers_of_block(const Output& output, const Operation& operation) {
  const Layout& layout = *operation.results[0];
  std::vector<std::size_t> all;
  std::size_t from = 0;
  for (const auto& part : layout.parts) {
    const auto size = static_cast<std::size_t>(part.size);
    for (std::size_t i = 0; i < size; ++i) {
      if (!is_in_block(output, size, i)) continue;
      if (operation.name != output.operation || is_judged(output, layout, part)) all.push_back(from + i);
    }
    from += size;
  }
  return all;
}

/// Compares some numbers of results.
struct Judging {
  std::vector<std::size_t> of;
  bool either_sign = false;  ///< Q and -Q are one rotation, and at pi, phi and -phi are, too

  double distance(const Numbers& a, const Numbers& b) const {
    double same = 0, opposite = 0;
    for (const std::size_t i : of)  // squares of tiny numbers are 0
      same = std::hypot(same, a[i] - b[i]), opposite = std::hypot(opposite, a[i] + b[i]);
    return either_sign ? std::min(same, opposite) : same;
  }
  bool finite(const Numbers& x) const {
    return std::ranges::all_of(of, [&](std::size_t i) { return std::isfinite(x[i]); });
  }
  /// Whether the predictions are wrong as `got` is: the first one in the same direction, or, where rounding decides how wrong
  /// each is, some of them as much.
  template <class Predicted>
  bool explains(const Numbers& got, const Numbers& right, const Predicted& predicted) const {
    const Numbers first = predicted(0);
    if (first.size() != right.size()) return false;
    if (same_error(got, right, first)) return true;
    if (!finite(got) || !finite(first)) return false;
    const double error = distance(got, right);
    double most = distance(first, right), apart = 0;
    for (const int k : {-2, -1, 1, 2}) {
      const Numbers other = predicted(k);
      if (!finite(other)) return false;
      most = std::max(most, distance(other, right)), apart = std::max(apart, distance(other, first));
    }
    return apart > 0.3 * most && error < 3 * most && error > most / 30;
  }
  /// Whether `predicted` is as wrong as `got`, in the same direction: nearer to it than a third of its error. What two
  /// calculations with the same wrong part differ by is their own rounding, far below an error that fails.
  /// A NaN anywhere in a result makes each of its blocks one.
  bool same_error(const Numbers& got, const Numbers& right, const Numbers& predicted) const {
    bool any = false;
    for (std::size_t i = 0; i < got.size(); ++i)
      if (!std::isfinite(got[i])) {
        if (std::isfinite(predicted[i]) || predicted[i] == unknown_number) return false;
        any = true;
      }
    return any || (finite(predicted) && distance(got, predicted) < 0.3 * distance(got, right));
  }
};

Judging judging_of(const Output& output, const Operation& operation, const Numbers& right) {
  Judging all{numbers_of_block(output, operation)};
  if (right.size() == 3 && output.block == "rotation vector")
    all.of = {0, 1, 2};  // perhaps of an axis and an angle
  double square = 0;
  for (const std::size_t i : all.of) square += right[i] * right[i];
  const double near_pi = 3.1415;
  const bool is_rotation = operation.name != "normalize" && operation.name != "velocity_to_rate";
  all.either_sign = (all.of.size() == 4 && is_rotation) ||
                    (output.definition->unit == "rad" && all.of.size() == 3 && square > near_pi * near_pi);
  return all;
}

/// An axis and an angle as a rotation vector, any other result as it is.
Numbers seen(const Output& output, const Numbers& x) {
  if (x.size() != 4 || output.block != "rotation vector") return x;
  return {x[3] * x[0], x[3] * x[1], x[3] * x[2]};
}

}  // namespace

std::vector<std::string_view> explained_by(const Series& series, const Output& output,
                                           const NotedCall& call) {
  std::vector<std::string_view> parts;
  const auto exact_numbers = expected_of(call);
  if (exact_numbers.empty() || exact_numbers.size() != call.result.size()) return parts;
  Numbers right;
  for (const oracles::Real& x : exact_numbers) right.push_back(static_cast<double>(x));
  right = seen(output, right);
  const Numbers got = seen(output, call.result);
  const Judging judging = judging_of(output, *call.operation, right);
  if (judging.of.empty()) return parts;
  for (const Relation& r : relations()) {
    if (call.operation->name != r.of) continue;
    const Operation& part = conventions::operation_named(r.part);
    /// The result as it follows from the part at its arguments times 1 + k eps.
    const auto predicted = [&](int k) {
      const auto own = [&](const Operation& operation, Numbers x) {
        for (double& number : x) number = series.format().rounded(number * (1 + k * series.format().epsilon));
        Numbers result = result_of(series, operation, x);
        if (result.empty()) throw std::domain_error("refused");
        return result;
      };
      return seen(output,
                  r.result({call.arguments, call.result, [&](const Numbers& x) { return own(part, x); },
                            [&](const char* name, const Numbers& x) {
                              return own(conventions::operation_named(name), x);
                            }}));
    };
    try {
      if (judging.explains(got, right, predicted)) parts.push_back(part.name);
    } catch (const std::exception&) {  // refused, or outside what the oracle knows
    }
  }
  // Where the linear part follows exactly from the angular one that was returned, nothing else is wrong with it.
  if (std::ranges::find(parts, call.operation->name) != parts.end())
    std::erase(parts, std::string_view("left_jacobian3_inverse"));
  return parts;
}

}  // namespace liecheck::properties
