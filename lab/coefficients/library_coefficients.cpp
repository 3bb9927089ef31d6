#include <array>
#include <bit>
#include <coefficients/float_interval.hpp>
#include <coefficients/library_coefficients.hpp>
#include <liecheck/scalar/simd.hpp>
#include <liecheck/scalar/stumpff.hpp>
#include <limits>
#include <stdexcept>

namespace liecheck::properties {
namespace {

using enum Coefficient;

// A Code is a function that computes some coefficients of one argument, in any scalar S, as an array.

/// Evaluates four floats at a time. The first one is evaluated again as a scalar float: the bits must agree.
template <class Code>
void in_simd(const float* x, std::size_t n, float* const* out) {
  using Floats = Simd<float, 4>;
  for (std::size_t i = 0; i < n; i += Floats::size) {
    const auto results = Code()(Floats::load(x + i));
    for (std::size_t k = 0; k < results.size(); ++k) results[k].store(out[k] + i);
  }
  const auto alone = Code()(x[0]);
  for (std::size_t k = 0; k < alone.size(); ++k)
    if (std::bit_cast<std::uint32_t>(alone[k]) != std::bit_cast<std::uint32_t>(out[k][0]))
      throw std::logic_error("a coefficient differs between Simd<float> and float");
}

template <class Code>
void one_by_one(const float* x, std::size_t n, float* const* out) {
  for (std::size_t i = 0; i < n; ++i) {
    const auto each = Code()(x[i]);
    out[0][i] = each[0], out[1][i] = each[1];
  }
}

template <class Code>
bool constant_over(float low, float high, float* out) {
  FloatInterval::undecided = false;
  const auto all = Code()(FloatInterval(low, high));
  if (FloatInterval::undecided) return false;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!(all[k].low == all[k].high)) return false;
    out[k] = all[k].low;
  }
  return true;
}

template <class Code>
CoefficientCode simd_code(std::vector<Coefficient> outputs, Code, float part = 1) {
  return {outputs, part * stumpff_detail::series_limit<float>(), in_simd<Code>, constant_over<Code>};
}
template <class Code>
CoefficientCode scalar_code(std::vector<Coefficient> outputs, Code) {
  return {outputs, std::numeric_limits<float>::max(), one_by_one<Code>, constant_over<Code>};
}

}  // namespace

const std::vector<CoefficientCode>& library_coefficients() {
  static const std::vector<CoefficientCode> all = {
      simd_code(
          {c0, c1, c2, c3, c4, c5},
          []<class S>(const S& x) {
            const HalfAngle<S> c(S(4) * x);  // HalfAngle evaluates at a quarter of its argument: at x
            return std::array{c.c0, c.c1, c.c2, c.c3, c.c4, c.c5};
          },
          0.25F),
      simd_code({Coefficient::c3_minus_2c4, Coefficient::c4_minus_3c5},
                []<class S>(const S& x) {
                  const HalfAngle<S> c(x);
                  return std::array{c.second_slope(), c.third_slope()};
                }),
      simd_code({d, d2},
                []<class S>(const S& x) {
                  const InverseCoefficient<S> c(x);
                  return std::array{c.d, c.d2};
                }),
      simd_code({half_sine, half_cosine},
                []<class S>(const S& x) {
                  const HalfAngle<S> c(x);
                  return std::array{c.sine_over_angle(), c.c0};
                }),
      scalar_code({angle_over_sine, alpha}, []<class S>(const S& squared_sine) {
        const LogarithmCoefficients<S> c(squared_sine, S(1));
        return std::array{c.angle_over_sine, c.alpha};
      })};
  return all;
}

const std::vector<CoefficientClaim>& coefficient_claims() {
  static const std::vector<CoefficientClaim> all = {
      {c0, "c0", "cos theta", "theta^2", 0.6,
       "1 - x/2 + x^2 c4, where the rounding error of 1 - x/2 is added back; up to theta = pi/2"},
      {c1, "c1", "sin theta / theta", "theta^2", 0.6, "1 - x/8 + smaller terms, like c0; up to theta = pi/2"},
      {c2, "c2", "(1 - cos theta) / theta^2", "theta^2", 0.7, "1/2 - x c4, up to theta = pi/2"},
      {c3, "c3", "(theta - sin theta) / theta^3", "theta^2", 0.9, "1/6 - x c5, up to theta = pi/2"},
      {c4, "c4", "(1/2 - c2) / theta^2", "theta^2", 1.1, "economised polynomial; first term added last"},
      {c5, "c5", "(1/6 - c3) / theta^2", "theta^2", 1.1, "economised polynomial; first term added last"},
      {Coefficient::c3_minus_2c4, "c3_minus_2c4", "c3 - 2 c4 = -2 dc2/dx", "theta^2", 2.6,
       "c1 (c2 - c3) / 4 at x/4: the difference loses a factor 2 by cancellation"},
      {Coefficient::c4_minus_3c5, "c4_minus_3c5", "c4 - 3 c5 = -2 dc3/dx", "theta^2", 2.4,
       "a sum of positive terms at x/4"},
      {d, "d", "(1 - (theta/2) cot(theta/2)) / theta^2", "theta^2", 2.6, "(c2 - c3) / (4 c1) at x/4"},
      {d2, "d2", "2 dd/dx", "theta^2", 5,
       "(c4 - 3 c5 + c3 (c2 - 2 c3)) / (16 c1^2) at x/4: both differences lose a factor 4"},
      {half_sine, "sine_over_angle", "sin(theta/2) / theta", "theta^2", 0.6, "half of c1 at x/4"},
      {half_cosine, "cosine", "cos(theta/2)", "theta^2", 0.6, "c0 at x/4; it crosses zero at pi"},
      {angle_over_sine, "angle_over_sine", "2 h / tan h", "tan^2 h", 2.5,
       "a square root, a quotient and a polynomial in cos h"},
      {alpha, "alpha", "h cot h", "tan^2 h", 2.5,
       "angle_over_sine times cosine; this product is exact at w = 1 and rounded at other w"}};
  return all;
}

}  // namespace liecheck::properties
