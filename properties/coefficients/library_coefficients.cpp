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

constexpr std::size_t most_outputs = 6;

// Each struct computes some coefficients of one argument, in any scalar S.

struct SixStumpff {
  static inline const std::vector<Coefficient> outputs = {c0, c1, c2, c3, c4, c5};
  template <class S>
  static void of(const S& x, S* out) {
    const HalfAngle<S> c(S(4) * x);  // HalfAngle evaluates at a quarter of its argument: at x
    out[0] = c.c0, out[1] = c.c1, out[2] = c.c2, out[3] = c.c3, out[4] = c.c4, out[5] = c.c5;
  }
};
struct Differences {
  static inline const std::vector<Coefficient> outputs = {Coefficient::c3_minus_2c4,
                                                          Coefficient::c4_minus_3c5};
  template <class S>
  static void of(const S& x, S* out) {
    const HalfAngle<S> c(x);
    out[0] = c.second_slope(), out[1] = c.third_slope();
  }
};
struct Inverse {
  static inline const std::vector<Coefficient> outputs = {d, d2};
  template <class S>
  static void of(const S& x, S* out) {
    const InverseCoefficient<S> c(x);
    out[0] = c.d, out[1] = c.d2;
  }
};
struct Half {
  static inline const std::vector<Coefficient> outputs = {half_sine, half_cosine};
  template <class S>
  static void of(const S& x, S* out) {
    const HalfAngle<S> c(x);
    out[0] = c.sine_over_angle(), out[1] = c.c0;
  }
};
struct Logarithm {
  static inline const std::vector<Coefficient> outputs = {angle_over_sine, alpha};
  template <class S>
  static void of(const S& squared_sine, S* out) {
    const LogarithmCoefficients<S> c(squared_sine, S(1));
    out[0] = c.angle_over_sine, out[1] = c.alpha;
  }
};

/// Evaluates four floats at a time. The first one is evaluated again as a scalar float: the bits must agree.
template <class Code>
void in_simd(const float* x, std::size_t n, float* const* out) {
  const std::size_t outputs = Code::outputs.size();
  using Floats = Simd<float, 4>;
  for (std::size_t i = 0; i < n; i += Floats::size) {
    Floats results[most_outputs];
    Code::of(Floats::load(x + i), results);
    for (std::size_t k = 0; k < outputs; ++k) results[k].store(out[k] + i);
  }
  float alone[most_outputs];
  Code::of(x[0], alone);
  for (std::size_t k = 0; k < outputs; ++k)
    if (std::bit_cast<std::uint32_t>(alone[k]) != std::bit_cast<std::uint32_t>(out[k][0]))
      throw std::logic_error("a coefficient differs between Simd<float> and float");
}

template <class Code>
void one_by_one(const float* x, std::size_t n, float* const* out) {
  for (std::size_t i = 0; i < n; ++i) {
    float each[most_outputs];
    Code::of(x[i], each);
    out[0][i] = each[0], out[1][i] = each[1];
  }
}

template <class Code>
bool constant_over(float low, float high, float* out) {
  FloatInterval all[most_outputs];
  FloatInterval::undecided = false;
  Code::of(FloatInterval(low, high), all);
  if (FloatInterval::undecided) return false;
  for (std::size_t k = 0; k < Code::outputs.size(); ++k) {
    if (!(all[k].low == all[k].high)) return false;
    out[k] = all[k].low;
  }
  return true;
}

template <class Code>
CoefficientCode simd_code(float part = 1) {
  return {Code::outputs, part * stumpff_detail::series_limit<float>(), in_simd<Code>, constant_over<Code>};
}

}  // namespace

const std::vector<CoefficientCode>& library_coefficients() {
  static const std::vector<CoefficientCode> all = {
      simd_code<SixStumpff>(0.25F), simd_code<Differences>(), simd_code<Inverse>(), simd_code<Half>(),
      CoefficientCode{Logarithm::outputs, std::numeric_limits<float>::max(), one_by_one<Logarithm>,
                      constant_over<Logarithm>}};
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
