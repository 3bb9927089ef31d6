// The sweep over every float: its oracle against 100-digit closed forms, constant intervals, planted errors.

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <coefficients/float_interval.hpp>
#include <coefficients/sweep.hpp>
#include <limits>
#include <map>
#include <oracles/closed_forms.hpp>
#include <random>

namespace liecheck::properties {
namespace {

using oracles::Real100;
using enum oracles::Coefficient;

/// The closed form of a coefficient. With t = sqrt(argument), t is tan h for the two coefficients of the
/// logarithm and theta for all others. For arguments >= 1e-15 cancellation costs at most 75 of the 100
/// digits.
Real100 closed_form(Coefficient which, double argument) {
  const Real100 x(argument), t = sqrt(x);
  if (which == angle_over_sine || which == alpha) return atan2(t, Real100(1)) / t * (which == alpha ? 1 : 2);
  const auto half = oracles::half_angle(oracles::Vec3<Real100>{{Real100(0), t, Real100(0)}});
  const Real100 s = half.s, c = half.c;
  const Real100 f0 = 1 - 2 * s * s, f1 = 2 * s * c / t, f2 = (1 - f0) / x, f3 = (1 - f1) / x,
                f4 = (Real100(1) / 2 - f2) / x, f5 = (Real100(1) / 6 - f3) / x;
  const Real100 inverse = (1 - t / 2 * c / s) / x;
  // d (h cot h) / dx = (cot h - h / sin^2 h) / (4 theta)
  const Real100 slope = (c / s - t / 2 / (s * s)) / (4 * t);
  const std::map<Coefficient, Real100> all = {{c0, f0},
                                              {c1, f1},
                                              {c2, f2},
                                              {c3, f3},
                                              {c4, f4},
                                              {c5, f5},
                                              {Coefficient::c3_minus_2c4, f3 - 2 * f4},
                                              {Coefficient::c4_minus_3c5, f4 - 3 * f5},
                                              {d, inverse},
                                              {d2, 2 * (-slope - inverse) / x},
                                              {half_sine, s / t},
                                              {half_cosine, c}};
  return all.at(which);
}

const CoefficientCode& code_of(Coefficient c) {
  for (const CoefficientCode& code : library_coefficients())
    if (std::count(code.outputs.begin(), code.outputs.end(), c)) return code;
  throw std::logic_error("no function of the library computes this coefficient");
}

TEST(SweepOracle, KeepsItsBoundAgainstClosedFormsAt100Digits) {
  std::mt19937 random(5);
  for (const CoefficientClaim& claim : coefficient_claims()) {
    const bool absolute = oracles::is_absolute(claim.coefficient);
    const std::uint32_t first = std::bit_cast<std::uint32_t>(1e-15f),
                        last = std::bit_cast<std::uint32_t>(code_of(claim.coefficient).last);
    double most = 0;
    for (int i = 0; i < 600; ++i) {
      // Uniform in the bits, so that every binade from 1e-15 on occurs. Every second interval has x >= 0.5.
      const std::uint32_t near = i % 2 ? std::bit_cast<std::uint32_t>(0.5f) : first;
      const std::uint32_t from = std::uniform_int_distribution(near, last)(random) & ~4095u;
      const std::uint32_t to = std::min(last, from + 4095);
      const double low = std::bit_cast<float>(from), high = std::bit_cast<float>(to);
      const auto e = oracles::expand(claim.coefficient, low, high);
      most = std::max(most, e.bound);
      for (const std::uint32_t bits : {from, from + (to - from) / 3, to}) {
        const double x = std::bit_cast<float>(bits);
        const Real100 f = closed_form(claim.coefficient, x), p(e.at(x));
        const Real100 error = absolute ? Real100(p - f) : Real100(p * f - 1);
        ASSERT_LE(static_cast<double>(abs(error)), e.bound) << claim.name << " at " << x;
      }
    }
    EXPECT_LE(most, 1e-12) << claim.name;  // 1e-5 eps of float
  }
}

/// Over wide intervals the truncation error of the oracle's cubic exceeds its rounding errors.
TEST(SweepOracle, KeepsItsBoundOverWideIntervals) {
  for (const CoefficientClaim& claim : coefficient_claims()) {
    const bool absolute = oracles::is_absolute(claim.coefficient);
    double tightest = 0;
    for (const auto& [low, high] : {std::pair(1.0, 9.0), {0.0, 9.5}, {4.0, 5.0}, {2.0, 2.25}, {0.0, 0.5}}) {
      const auto e = oracles::expand(claim.coefficient, low, high);
      for (int i = 1; i <= 64; ++i) {
        const double x = low + (high - low) * i / 64;
        const Real100 f = closed_form(claim.coefficient, x), p(e.at(x));
        const double error = static_cast<double>(abs(absolute ? Real100(p - f) : Real100(p * f - 1)));
        ASSERT_LE(error, e.bound) << claim.name << " at " << x << " in " << low << ", " << high;
        tightest = std::max(tightest, error / e.bound);
      }
    }
    EXPECT_GT(tightest, 1e-4) << claim.name;  // the bound is not too pessimistic
  }
}

TEST(SweepIntervals, ThatAreProvedConstantAreConstant) {
  std::mt19937 random(3);
  for (const CoefficientCode& code : library_coefficients()) {
    int seen = 0, refused = 0;
    std::vector<float> x(4096 + 8);
    std::vector<std::vector<float>> results(6, std::vector<float>(4096 + 8));
    std::vector<float*> out;
    for (auto& r : results) out.push_back(r.data());
    for (int i = 0; i < 400; ++i) {
      const std::uint32_t last = std::bit_cast<std::uint32_t>(code.last);
      const std::uint32_t from =
          std::uniform_int_distribution(i % 2 ? 0u : 0x30000000u, i % 2 ? last : 0x34000000u)(random) &
          ~4095u;
      const std::uint32_t n = std::min(4096u, last - from + 1);
      for (std::uint32_t k = 0; k < x.size(); ++k) x[k] = std::bit_cast<float>(from + std::min(k, n - 1));
      float value[6];
      if (!code.constant(x[0], x[n - 1], value)) {
        ++refused;
        continue;
      }
      ++seen;
      code.evaluate(x.data(), n, out.data());
      for (std::size_t k = 0; k < code.outputs.size(); ++k)
        for (std::uint32_t j = 0; j < n; ++j) ASSERT_EQ(results[k][j], value[k]) << x[j];
    }
    EXPECT_GT(seen, 50);
    EXPECT_GT(refused, 10);
  }
}

TEST(SweepIntervals, AnIntervalContainsTheResultsOfItsPoints) {
  std::mt19937 random(8);
  std::uniform_real_distribution<float> any(-2, 2), share(0, 1);
  for (int i = 0; i < 20000; ++i) {
    const auto interval = [&] {
      const float a = any(random), b = any(random);
      return FloatInterval(std::min(a, b), std::max(a, b));
    };
    const auto inside = [&](const FloatInterval& s) {
      return std::clamp(s.low + share(random) * (s.high - s.low), s.low, s.high);
    };
    const FloatInterval a = interval(), b = interval(), c = interval();
    const float x = inside(a), y = inside(b), z = inside(c);
    const auto holds = [](const FloatInterval& s, float v) { return s.low <= v && v <= s.high; };
    ASSERT_TRUE(holds(a + b, x + y) && holds(a - b, x - y) && holds(a * b, x * y));
    ASSERT_TRUE(holds(mul_add(a, b, c), x * y + z) || holds(mul_add(a, b, c), std::fma(x, y, z)));
    EXPECT_TRUE(b.low <= 0 || holds(a / b, x / y));
  }
}

TEST(Sweep, OfEvery1009thFloatPassesAndGivesALowerBound) {
  SweepOptions options;
  options.stride = 1009;
  const SweepResult r = sweep(options);
  EXPECT_TRUE(r.complete);
  EXPECT_FALSE(r.upper_bound());
  EXPECT_FALSE(r.failed());
  ASSERT_EQ(r.coefficients.size(), static_cast<std::size_t>(oracles::coefficient_count));
  for (const auto& c : r.coefficients) {
    const std::uint32_t last = std::bit_cast<std::uint32_t>(code_of(c.claim->coefficient).last);
    EXPECT_EQ(c.evaluated, last / 1009 + 1) << c.claim->name;
    EXPECT_GT(c.max_eps, 0.25) << c.claim->name;  // correctly rounded results do too
  }
  options.jobs = 2;
  const SweepResult again = sweep(options);
  for (std::size_t k = 0; k < r.coefficients.size(); ++k) {
    EXPECT_EQ(r.coefficients[k].max_eps, again.coefficients[k].max_eps);
    EXPECT_EQ(r.coefficients[k].max_at, again.coefficients[k].max_at);
  }
}

/// The first `terms` terms of the series of c_4.
float short_series(float x, int terms) {
  float sum = 0;
  for (int j = terms; j-- > 0;)
    sum = sum * x + static_cast<float>((j % 2 ? -1 : 1) / std::tgamma(2.0 * j + 5));
  return sum;
}

CoefficientCode planted(const std::function<float(float)>& f) {
  const auto evaluate = [f](const float* x, std::size_t n, float* const* out) {
    for (std::size_t i = 0; i < n; ++i) out[0][i] = f(x[i]);
  };
  return {{c4}, code_of(c4).last, evaluate, [](float, float, float*) { return false; }};
}

TEST(Sweep, FailsASeriesThatIsOneTermShort) {
  SweepOptions options;
  options.stride = 10007;
  const auto terms = [&](int n) {
    return sweep(options, {planted([n](float x) { return short_series(x, n); })});
  };
  // The first omitted term at x = (pi/2)^2, relative to 1/4!, is x^5 4!/14! = 0.2 eps for a series of five
  // terms, and x^4 4!/12! = 16 eps for a series of four.
  EXPECT_FALSE(terms(5).failed());
  const SweepResult r = terms(4);
  EXPECT_TRUE(r.failed());
  EXPECT_GT(r.coefficients[0].max_at, 2.4f);
}

TEST(Sweep, FailsNaN) {
  SweepOptions options;
  options.stride = 10007;
  const auto r =
      sweep(options, {planted([](float x) { return x > 2 ? std::sqrt(2 - x) : short_series(x, 9); })});
  EXPECT_TRUE(r.failed());
  EXPECT_TRUE(std::isinf(r.coefficients[0].max_eps));
}

TEST(Sweep, OfEveryFloatFindsTheOneThatIsWrong) {
  const float wrong = 0x1.2c3d5ep+1f;
  CoefficientCode code = code_of(half_sine);
  code.evaluate = [whole = code.evaluate, wrong](const float* x, std::size_t n, float* const* out) {
    whole(x, n, out);
    for (std::size_t i = 0; i < n; ++i)
      if (x[i] == wrong) out[0][i] *= 1 + 3 * std::numeric_limits<float>::epsilon();
  };
  SweepOptions options;
  options.coefficients = {half_sine};
  options.stride = 1009;
  EXPECT_FALSE(sweep(options, {code}).failed());
  options.stride = 1;
  const SweepResult r = sweep(options, {code});
  ASSERT_EQ(r.coefficients.size(), 1U);
  EXPECT_TRUE(r.upper_bound());
  EXPECT_TRUE(r.failed());
  EXPECT_EQ(r.coefficients[0].max_at, wrong);
  EXPECT_EQ(r.coefficients[0].evaluated, std::uint64_t{std::bit_cast<std::uint32_t>(code.last)} + 1);
  EXPECT_GE(r.coefficients[0].bound_eps, r.coefficients[0].max_eps);
}

TEST(Sweep, StopsOnRequestAndThenGivesNoUpperBound) {
  std::atomic<bool> stop{false};
  SweepOptions options;
  options.coefficients = {half_cosine};
  options.stop = &stop;
  options.progress = [&](double) { stop = true; };
  const SweepResult r = sweep(options);
  EXPECT_FALSE(r.complete);
  EXPECT_FALSE(r.upper_bound());
}

TEST(Sweep, StopsAfterTheBlockOfFloatsInWhichTheRequestCame) {
  std::atomic<bool> stop{false};
  SweepOptions options;
  options.stop = &stop;
  const SweepResult r = sweep(options, {planted([&](float x) {
                                stop = true;
                                return short_series(x, 9);
                              })});
  EXPECT_FALSE(r.complete);
  EXPECT_EQ(r.coefficients.at(0).evaluated, 1U << 12);
}

}  // namespace
}  // namespace liecheck::properties
