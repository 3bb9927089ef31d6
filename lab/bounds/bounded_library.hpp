#pragma once
// What the library computes on the scalar Bounded otherwise than by its own operations: error-free transformations, sums of
// split factors, polynomials, and what is assumed of the inputs. docs/laboratory.md names the sources.

#include <bounds/bounded.hpp>
#include <liecheck/scalar/compensated.hpp>
#include <liecheck/scalar/stumpff.hpp>
#include <liecheck/spatial/jacobians.hpp>
#include <tuple>

namespace liecheck {

// Error-free transformations are exact, by their proofs.
template <>
inline DoubleWord<properties::Bounded> two_sum(const properties::Bounded& a, const properties::Bounded& b) {
  const auto [sum, error] = properties::Bounded::sum_and_error(a, b);
  return {sum, error};
}
template <>
inline DoubleWord<properties::Bounded> fast_two_sum(const properties::Bounded& a,
                                                    const properties::Bounded& b) {
  const auto [sum, error] = properties::Bounded::sum_and_error(a, b);
  return {sum, error};
}
template <>
inline DoubleWord<properties::Bounded> two_prod(const properties::Bounded& a, const properties::Bounded& b) {
  const auto [product, error] = properties::Bounded::product_and_error(a, b);
  return {product, error};
}

/// A split factor stands for its value. What the high parts leave out is an error that the low parts cancel.
template <int BITS>
struct SplitFactor<properties::Bounded, BITS, Precision::standard> {
  properties::Bounded value;
  SplitFactor(const properties::Bounded& x) : value(x) {}
};

/// A sum of at most four products of split factors, |factor| <= 4. The high parts are multiples of 2^-24 (BITS <= 4), and
/// the sum of their products is exact (Rump, Ogita & Oishi 2008). The low parts are below 2^-24, so that the sum of the
/// products with a low part is below 4 * 2 * 4 * 2^-24 = 2^-19; it has at most 16 roundings of numbers below 2^-19,
/// together below 16 * 2^-19 * 2^-53 = 2^-68.
template <int BITS>
struct SplitDot<properties::Bounded, BITS, Precision::standard> {
  using S = properties::Bounded;
  using Factor = SplitFactor<S, BITS, Precision::standard>;
  S high = S(0), low_a = S(0), low_b = S(0);

  static SplitDot square(const Factor& a) { return SplitDot().add_square(a); }
  SplitDot& add_square(const Factor& a) {
    if (a.value.computed().largest() > 4) throw properties::Undecided("a factor that cannot be split");
    sum_ = S::without_rounding(a.value, a.value, sum_);
    std::tie(high, low_a) = sum_.parts(0x1p-19, 0x1p-68);
    return *this;
  }

 private:
  S sum_ = S(0);
};

/// Polynomials: the error of the approximation, which tests/proofs proves, is one more rounding error. `RAW` has the
/// error of the evaluation.
namespace bounded_detail {
/// Relative errors of the polynomials of c_4 and c_5, of h / sin h, and of (h / sin h - 1) / s [eps].
inline constexpr double fourth = 0.27, fifth = 0.45, inverse_sinc = 0.2, inverse_sinc_rest = 13.5;

/// The polynomial with an error of `size(p)` eps.
template <template <class> class Series, int FROM, class Size>
properties::Bounded polynomial(const properties::Bounded& x, Size size) {
  using Raw = properties::BoundedNumber<true>;
  const properties::Bounded p(stumpff_detail::evaluate<Series, FROM>(Raw(x)));
  return p.with_another_error(size(p.exact().largest()) * (1 + 0x1p-40) *
                              std::numeric_limits<double>::epsilon());
}
}  // namespace bounded_detail

namespace stumpff_detail {
template <>
inline properties::Bounded evaluate<Fourth, 0, properties::Bounded>(const properties::Bounded& x) {
  return bounded_detail::polynomial<Fourth, 0>(x, [](double p) { return bounded_detail::fourth * p; });
}
template <>
inline properties::Bounded evaluate<Fifth, 0, properties::Bounded>(const properties::Bounded& x) {
  return bounded_detail::polynomial<Fifth, 0>(x, [](double p) { return bounded_detail::fifth * p; });
}
template <>
inline properties::Bounded evaluate<InverseSincSeries, 1, properties::Bounded>(const properties::Bounded& x) {
  // h / sin h <= pi/2 errs by 0.2 eps of itself, so that (h / sin h - 1) / s errs by that over s.
  return bounded_detail::polynomial<InverseSincSeries, 1>(x, [least = x.exact().low](double p) {
    const double rest = bounded_detail::inverse_sinc_rest * p;
    return least > 0 ? std::min(rest, bounded_detail::inverse_sinc * 1.5708 / least) : rest;
  });
}
}  // namespace stumpff_detail

/// The claim is about the inputs with theta <= pi, for which this is true.
template <>
inline bool within_pi<properties::Bounded>(const properties::Bounded&) {
  return true;
}

/// The claim is about quaternions with | |Q|^2 - 1 | in the box's interval. Error by its contract: eps/16.
template <>
template <>
inline DoubleWord<properties::Bounded> SO3<properties::Bounded>::normExcessDoubleWord<Precision::standard>()
    const {
  return {properties::Bounded::input(properties::BoxFacts::current().norm_excess),
          properties::Bounded::with_error(0, 0x1p-56)};
}

}  // namespace liecheck
