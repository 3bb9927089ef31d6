#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <scenes/confirm.hpp>
#include <scenes/independent.hpp>
#include <scenes/runner.hpp>
#include <scenes/truth.hpp>

namespace liecheck::properties {
namespace {

/// The largest of the four errors.
double largest(const MotionError& e) {
  double all = 0;
  for (const ErrorMeasure& m : error_measures)
    if (!std::isnan(e.*m.of)) all = std::max(all, e.*m.of);
  return all;
}

double distance(const Benchmark& s, const std::vector<Moment>& a, const std::vector<Moment>& b) {
  MotionError worst = MotionError::none();
  for (std::size_t k = 0; k < a.size(); ++k) worst.take_larger(motion_error(s.robot, a[k], b[k]));
  return largest(worst);
}

/// The error of gauss12 in double, or the rounding of its numbers if that is larger.
double error_in_double(const Benchmark& s, const std::vector<Moment>& exact, long steps,
                       const std::atomic<bool>* stop) {
  oracles::Real size(1);
  for (const Moment& m : exact)
    for (const auto* numbers : {&m.q, &m.v})
      for (const oracles::Real& x : *numbers) size = std::max<oracles::Real>(size, abs(x));
  const double rounding = 0x1p-53 * static_cast<double>(size);
  try {
    std::vector<Moment> moments;
    const auto runner = make_runner(s, "gauss12", "double");
    runner->stop = stop;
    runner->run({steps, 0}, long(exact.size()) - 1, [&](double, const Moment& m) { moments.push_back(m); });
    return std::max(rounding, distance(s, moments, exact));
  } catch (const Diverged&) {
    return rounding;
  }
}

}  // namespace

Confirmed confirmed(const Benchmark& s, const std::vector<Moment>& moments, long steps,
                    const std::atomic<bool>* stop) {
  const std::string first = "gauss12 in float128 with two step sizes";
  // A few units in the last place of long double (2^-63), for the rounding errors that extrapolation
  // amplifies.
  const long double tolerance = 0x1p-57L;
  std::vector<Moment> second;
  try {
    second = moments_of<long double>(independent_tree<long double>(s), s, long(moments.size()) - 1, tolerance,
                                     stop);
  } catch (const std::invalid_argument& e) {
    return {fmt::format("{} (unconfirmed: {})", first, e.what()), 0};
  } catch (const std::domain_error& e) {
    return {fmt::format("{} (unconfirmed: {})", first, e.what()), 0};
  } catch (const std::runtime_error&) {
    throw Stopped();
  }
  const double apart = distance(s, second, moments), compared = error_in_double(s, moments, steps, stop);
  if (!(apart < compared))
    throw std::invalid_argument(
        fmt::format("{}: no reference: gauss12 in float128 and maximal coordinates differ by {:.0e}, and a "
                    "run in double from them "
                    "by {:.0e}: take a shorter duration, or effects with fewer events",
                    s.name, apart, compared));
  return {first + ", and extrapolation in maximal coordinates", apart};
}

}  // namespace liecheck::properties
