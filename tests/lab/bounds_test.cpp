// Proved bounds of whole operations: the scalar that carries a bound of its rounding error, and what it proves.

#include <gtest/gtest.h>
#include <boost/multiprecision/float128.hpp>
#include <bounds/bounded_library.hpp>
#include <bounds/bounds.hpp>
#include <campaign/campaign.hpp>
#include <random>
#include <search/hunt.hpp>

namespace liecheck::properties {
namespace {

using Wide = boost::multiprecision::float128;

double size_of_error(const Bounded& x) {
  double sum = 0;
  for (const auto& t : x.error()) sum += t.c.largest();
  return sum;
}
bool contains(const Interval& i, double x) {
  return i.low <= x && x <= i.high;
}

/// A formula with every operation, on numbers of any type.
template <class T>
T formula(const T& x, const T& y, const T& z) {
  using std::fabs, std::sqrt;
  const T a = x * y - z, b = (x - y) / (T(3) + z * z), c = sqrt(x * x + y * y);
  return a / c + fabs(b * z) - T(1) / T(3) + two_sum<T>(x, y).low + two_prod<T>(x, z).low;
}

TEST(BoundedNumber, EnclosesTheResultAndItsErrorOnEveryBox) {
  std::mt19937 bits(7);
  std::uniform_real_distribution<double> centre(0.5, 2), width(0, 0.1), inside(0, 1);
  double closest = 0;
  for (int box = 0; box < 300; ++box) {
    std::array<Interval, 3> range;
    for (auto& r : range) r.low = centre(bits), r.high = r.low + width(bits) * (box % 3);
    BoxFacts::current() = {};
    const Bounded bound =
        formula(Bounded::input(range[0]), Bounded::input(range[1]), Bounded::input(range[2]));
    for (int i = 0; i < 50; ++i) {
      std::array<double, 3> x;
      for (int k = 0; k < 3; ++k) x[k] = range[k].low + inside(bits) * (range[k].high - range[k].low);
      const double computed = formula(x[0], x[1], x[2]);
      const Wide X(x[0]), Y(x[1]), Z(x[2]);
      const Wide exact = (X * Y - Z) / sqrt(X * X + Y * Y) + fabs((X - Y) / (3 + Z * Z) * Z) - Wide(1) / 3;
      const auto error = static_cast<double>(fabs(computed - exact));
      ASSERT_TRUE(contains(bound.computed(), computed)) << box;
      ASSERT_TRUE(contains(bound.exact(), static_cast<double>(exact))) << box;
      ASSERT_LE(error, size_of_error(bound)) << box;
      closest = std::max(closest, error / size_of_error(bound));
    }
  }
  EXPECT_GT(closest, 0.3);  // the bound is not far above the errors
}

TEST(BoundedNumber, KnowsWhichOperationsAreExact) {
  BoxFacts::current() = {};
  const Bounded x = Bounded::input({0.5, 0.75});
  EXPECT_TRUE((Bounded(1) - x).error().empty());  // Sterbenz's lemma
  EXPECT_TRUE((x * Bounded(0.25)).error().empty());
  EXPECT_FALSE((x * Bounded(3)).error().empty());
  EXPECT_FALSE((x - Bounded::input({0, 0.25})).error().empty());
  const auto parts = two_sum(x, Bounded::input({0.001, 0.002}));
  EXPECT_EQ((parts.high + parts.low).error().size(), 1u);  // the last rounding only
  EXPECT_TRUE((x - x).exact().is(0));
  EXPECT_TRUE(((Bounded(1) - (Bounded(1) - x)) - x).exact().is(0));
}

TEST(BoundedNumber, SeesTheCancellationOfATextbook) {
  // (1 - cos theta)/theta^2 with a cosine that errs by half an ulp: 1/theta^2 eps relative to 1/2.
  for (const double theta : {1e-1, 1e-3, 1e-5}) {
    BoxFacts::current() = {};
    const Bounded x = Bounded::input({theta * theta * (1 - 1e-12), theta * theta * (1 + 1e-12)}),
                  cosine = Bounded::with_error({std::cos(theta) - 1e-15, std::cos(theta)}, 0x1p-54);
    const double bound = 2 * size_of_error((Bounded(1) - cosine) / x) / 0x1p-52;
    EXPECT_GT(bound, 0.4 / (theta * theta));
    EXPECT_LT(bound, 2 / (theta * theta));
  }
}

TEST(BoundedNumber, RefusesWhatHasNoAnswerForTheWholeBox) {
  BoxFacts::current() = {};
  const Bounded x = Bounded::input({-1, 1});
  EXPECT_THROW(static_cast<void>(x < Bounded(0)), Undecided);
  EXPECT_THROW(Bounded(1) / x, Undecided);
  EXPECT_THROW(sqrt(x), Undecided);
  EXPECT_THROW(sin(x), Undecided);
}

ProvedBound proved(const std::string& operation, std::uint64_t boxes, double wanted = 0) {
  ProvedBound result;
  BoundOptions options;
  options.operations = {operation}, options.boxes = boxes, options.wanted = wanted;
  prove_bounds(options, [&](const ProvedBound& b) { result = b; });
  return result;
}

class Bounds : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Of, Bounds, testing::ValuesIn(proved_operations()),
                         [](const auto& i) { return i.param; });

/// The worst input that a search finds, and the bound for the tiny box about it.
TEST_P(Bounds, AreNotBelowWhatASearchFinds) {
  const ProvedBound whole = proved(GetParam(), 3000);
  ASSERT_TRUE(std::isfinite(whole.bound));
  EXPECT_GE(whole.bound, whole.hunted);
  HuntOptions options;
  options.operation = whole.operation, options.block = whole.block, options.evaluations = 20000;
  const std::string law = whole.operation.starts_with("exp")   ? "exp_oracle"
                          : whole.operation.starts_with("log") ? "log_oracle"
                                                               : "jacobian_oracle";
  const auto series = std::move(select({{"liecheck"}, {law}, {"double"}}, built_in_robot()).at(0));
  const Worst worst = hunt(*series, options).worst.at(0);
  EXPECT_GT(worst.score, whole.hunted / 3);
  EXPECT_GE(whole.bound, worst.score) << worst.id.text();
  if (whole.operation.starts_with("log")) return;  // its input is a pose
  std::array<double, 3> rho, phi;
  ASSERT_EQ(worst.id.input.size(), 6u);
  for (int k = 0; k < 3; ++k)
    rho[k] = std::strtod(worst.id.input[k].c_str(), nullptr),
    phi[k] = std::strtod(worst.id.input[k + 3].c_str(), nullptr);
  const double there = bound_at(whole.operation, phi, rho);
  EXPECT_GE(there, worst.score) << worst.id.text();
  EXPECT_LT(there, 4 * worst.score) << worst.id.text();
}

TEST_P(Bounds, OfAnErrorThatASearchFindsAreNotProvedBelowIt) {
  const double hunted = proved(GetParam(), 1).hunted;
  EXPECT_GT(proved(GetParam(), 1500, 0.99 * hunted).bound, 0.99 * hunted);
}

TEST(BoundsOfOperations, AreWithinFourTimesWhatASearchFound) {
  for (const char* operation :
       {"exp3_quaternion", "log3_quaternion", "left_jacobian3", "left_jacobian3_inverse"}) {
    const ProvedBound b = proved(operation, 6000);
    EXPECT_LE(b.bound, 4 * b.hunted) << operation;
  }
}

TEST(BoundsOfOperations, NameAnUnknownOperation) {
  EXPECT_THROW(proved("exp7", 1), std::invalid_argument);
}

}  // namespace
}  // namespace liecheck::properties
