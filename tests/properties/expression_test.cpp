// The expressions of hard cases: their exact bits in float and double, and the messages of invalid ones.

#include <gtest/gtest.h>

#include <campaign/case_id.hpp>
#include <cmath>
#include <hard_cases/expression.hpp>
#include <limits>

#include "../refusal.hpp"

namespace liecheck::properties {
namespace {

template <class S>
std::vector<S> values(const std::string& text) {
  std::vector<S> all;
  for (const std::string& hexadecimal : evaluate(text, oracles::scalar_of<S>))
    all.push_back(static_cast<S>(parse_float(hexadecimal, oracles::scalar_of<S>)));
  return all;
}
template <class S>
S value(const std::string& text) {
  const auto all = values<S>(text);
  EXPECT_EQ(all.size(), 1u) << text;
  return all.at(0);
}

template <class S>
class Expression : public testing::Test {
 protected:
  using L = std::numeric_limits<S>;
  static constexpr S infinity = L::infinity();
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Expression, Scalars);

TYPED_TEST(Expression, ConstantsAreThoseOfTheScalar) {
  using S = TypeParam;
  using L = std::numeric_limits<S>;
  EXPECT_EQ(value<S>("pi"), S(M_PIl));
  EXPECT_EQ(value<S>("2*pi"), S(2 * M_PIl));
  EXPECT_EQ(value<S>("eps"), L::epsilon());
  EXPECT_EQ(value<S>("min_normal"), L::min());
  EXPECT_EQ(value<S>("denorm_min"), L::denorm_min());
  EXPECT_EQ(value<S>("max"), L::max());
  EXPECT_EQ(value<S>("sqrt(min_normal)/2"), S(std::sqrt(L::min()) / 2));
  EXPECT_EQ(value<S>("eps^(1/4)"), S(std::pow(2.0L, (1 - L::digits) / 4.0L)));
}

TYPED_TEST(Expression, DecimalAndHexadecimalNumbersAreRoundedOnce) {
  using S = TypeParam;
  EXPECT_EQ(value<S>("1e-3"), S(1e-3L));
  EXPECT_EQ(value<S>("0.1"), S(0.1L));
  EXPECT_EQ(value<S>("0x1.8p-3"), S(0x1.8p-3));
  EXPECT_EQ(value<S>("1 + eps/2"), S(1));  // a tie is rounded to even
  EXPECT_EQ(value<S>("1 + 3*eps/2"), S(1) + 2 * std::numeric_limits<S>::epsilon());  // likewise
  EXPECT_EQ(value<S>("1 + eps/2 + eps^3"), S(1) + std::numeric_limits<S>::epsilon());
  EXPECT_TRUE(std::signbit(value<S>("-0")));
  EXPECT_FALSE(std::signbit(value<S>("0")));
  EXPECT_EQ(value<S>("-2^2"), S(-4));
}

TYPED_TEST(Expression, NeighboursAreThoseOfNextafter) {
  using S = TypeParam;
  const S up = this->infinity, pi = S(M_PIl);
  EXPECT_EQ(value<S>("nextup(pi)"), std::nextafter(pi, up));
  EXPECT_EQ(value<S>("nextdown(pi)"), std::nextafter(pi, -up));
  EXPECT_EQ(value<S>("nextdown(1)"), std::nextafter(S(1), -up));
  EXPECT_EQ(value<S>("nextup(-1)"), std::nextafter(S(-1), up));
  EXPECT_EQ(value<S>("nextdown(-1)"), std::nextafter(S(-1), -up));
  EXPECT_EQ(value<S>("nextup(0)"), std::numeric_limits<S>::denorm_min());
  EXPECT_EQ(value<S>("nextdown(min_normal)"), std::nextafter(std::numeric_limits<S>::min(), S(0)));
  EXPECT_EQ(value<S>("nextup(1, 3)"), S(1) + 3 * std::numeric_limits<S>::epsilon());
  EXPECT_EQ(value<S>("round(pi) - pi + pi"), pi);
}

TYPED_TEST(Expression, ListsAreCombinedElementByElement) {
  using S = TypeParam;
  EXPECT_EQ(values<S>("2*(1, 2, 3) - (0, 1, 0), 7"), (std::vector<S>{2, 3, 6, 7}));
  EXPECT_EQ(values<S>("unit(2, -3, 6)"), (std::vector<S>{S(2.0L / 7), S(-3.0L / 7), S(6.0L / 7)}));
  EXPECT_EQ(values<S>("about(0, 0, 5, 1)"), (std::vector<S>{0, 0, S(std::sin(0.5L)), S(std::cos(0.5L))}));
  EXPECT_EQ(values<S>("rotation(0, 0, 3, 3)"), (std::vector<S>{0, -1, 0, 1, 0, 0, 0, 0, 1}));
}

TYPED_TEST(Expression, ComputedNumbersMayRoundToZero) {
  using S = TypeParam;
  EXPECT_EQ(values<S>("1, 1e-40 * scaled(1e-300)"), (std::vector<S>{1, 0}));
  EXPECT_EQ(values<S>("1, 1e-60 * 1e60"), (std::vector<S>{1, 1}));
  EXPECT_EQ(values<S>("1, 0.000, -0x0p-99"), (std::vector<S>{1, 0, 0}));
}

TEST(ExpressionScaled, MapsTheExponentRangeOfDoubleToThatOfTheScalar) {
  EXPECT_EQ(value<double>("scaled(1e150)"), 1e150);
  EXPECT_NEAR(value<float>("scaled(1e150)") / 5.62e18f, 1, 1e-2);
  EXPECT_EQ(value<double>("-scaled(1e150)"), value<double>("scaled(-1e150)"));
}

TEST(ExpressionErrors, NameTheTextAndWhatIsWrong) {
  const auto refusal = [](const std::string& text) {
    return test::refusal([&] { evaluate(text, oracles::scalar_of<float>); });
  };
  const std::pair<const char*, std::vector<std::string>> wrong[] = {
      {"')' is missing", {"(1, 2"}},
      {"'2' is not expected", {"1 2"}},
      {"'tau' is unknown", {"tau"}},
      {"missing", {"", "1 +", "1, "}},
      {"'tan' is unknown", {"tan(1)"}},
      {"pi is a constant", {"pi(1)"}},
      {"unknown", {"sqrt"}},
      {"not a number", {"1.2.3", "1e"}},
      {"not '#'", {"#"}},
      {"beyond the range of float", {"1e39"}},
      {"rounds to zero in float", {"1e-60"}},
      {"not a finite", {"1/0", "0/0", "sqrt(-1)", "unit(0, 0, 0)"}},
      {"'1e-60' rounds to zero in float", {"1, - 1e-60 , 2"}},
      {"'0x1p-200' rounds to zero in float", {"1, 0x1p-200"}},
      {"range", {"1e4000^1000"}},
      {"beyond the range", {"2*max", "1, 1e-6000", "1, 1e-99999999999", "1e9999999999"}},
      {"2 numbers with 3", {"(1, 2) + (1, 2, 3)"}},
      {"takes 4 numbers", {"about(1, 2, 3)"}},
      {"integer", {"nextup(1, 0.5)"}},
      {"nested", {std::string(100, '('), std::string(100, '-') + "1"}},
      {"at most 1000", {"nextup(1, 1e9)"}},
      {"60 characters", {std::string(100, '1')}}};
  for (const auto& [part, texts] : wrong)
    for (const std::string& text : texts)
      EXPECT_NE(refusal(text).find(part), std::string::npos) << text << " gave: " << refusal(text);
  EXPECT_THROW(oracles::scalar_named("half"), std::invalid_argument);
}

}  // namespace
}  // namespace liecheck::properties
