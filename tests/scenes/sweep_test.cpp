// The parts of the scene sweep: orders, drift, exact motions, errors, and other simulators ("peers").

#include <gtest/gtest.h>

#include <cmath>
#include <integrators/builtin.hpp>
#include <integrators/make_runner.hpp>
#include <integrators/spins.hpp>
#include <integrators/sweep.hpp>
#include <nlohmann/json.hpp>
#include <results/scenes.hpp>
#include <scenes/benchmark.hpp>
#include <set>

namespace {

using namespace liecheck;
using namespace liecheck::properties;

Benchmark builtin(const std::string& name) {
  for (const Benchmark& b : builtin_benchmarks())
    if (b.name == name) return b;
  throw std::invalid_argument(name);
}

std::vector<double> falling(double order, double from, int count, double floor = 0) {
  std::vector<double> errors;
  for (int k = 0; k < count; ++k) errors.push_back(from * std::exp2(-order * k) + floor);
  return errors;
}

TEST(ObservedOrder, IsTheSlopeAboveTheFloor) {
  const ObservedOrder o = observe_order(falling(4, 1e-2, 14, 1e-15), 4);
  EXPECT_NEAR(o.order, 4, 0.01);
  EXPECT_EQ(o.halvings, 5);
  ASSERT_TRUE(o.floor);
  EXPECT_NEAR(*o.floor, 1e-15, 1e-16);
  EXPECT_FALSE(observe_order(falling(1, 1, 8), 1).floor);
}

TEST(ObservedOrder, FindsAnUnexpectedOrderAndIgnoresACoarseStart) {
  EXPECT_NEAR(observe_order(falling(3, 1e-1, 8), 4).order, 3, 1e-12);
  std::vector<double> errors = {2, 3, 2.5};
  for (double e : falling(2, 1, 8)) errors.push_back(e);
  const ObservedOrder o = observe_order(errors, 2);
  EXPECT_NEAR(o.order, 2, 1e-12);
  EXPECT_FALSE(o.floor);
  EXPECT_LT(observe_order({1, 1e-3, 1e-15, 1.2e-15, 1e-15}, 4).halvings, 5);
}

TEST(WrongOrders, NamesMethodsOfWrongOrderOrObservedInFewerThanThreeScenes) {
  const auto row = [](double order, int halvings) {
    OrderRow r{"rk2", "double", 2, false, {}, {}, {}};
    r.observed.order = order, r.observed.halvings = halvings, r.observed.settled = halvings >= 5;
    return r;
  };
  SceneSweep good{builtin("pendulum"), "", true, {}, {}, {row(2.05, 5)}, {}};
  EXPECT_TRUE(wrong_orders({good, good, good}).empty());
  EXPECT_EQ(wrong_orders({good, good}).size(), 1U);
  SceneSweep off = good, coarse = good;
  off.orders = {row(1.89, 5)}, coarse.orders = {row(2, 4)};
  EXPECT_EQ(wrong_orders({good, good, good, off, coarse}).size(), 1U);
  SceneSweep exact = good;
  exact.orders[0].exact = true;
  EXPECT_EQ(wrong_orders({good, good, exact}).size(), 1U);
}

TEST(Drift, IsALineAndTheOscillationAboutIt) {
  std::vector<double> t;
  std::vector<Eigen::VectorXd> x;
  for (int i = 0; i <= 400; ++i) {
    t.push_back(i * 0.1);
    x.push_back(Eigen::VectorXd::Constant(1, 2 - 2e-6 * t.back() + 2e-4 * std::sin(2 * M_PI * t.back())));
  }
  const Drift d = drift_of(t, x);
  EXPECT_NEAR(d.slope, -1e-6, 3e-7);
  EXPECT_NEAR(d.oscillation, 1e-4, 1e-5);
  EXPECT_EQ(d.samples, 401U);
  EXPECT_EQ(drift_of({0, 1}, {x[0], x[1]}).samples, 0U);
}

TEST(MotionError, IsMeasuredOnTheGroup) {
  const Benchmark b = builtin("triaxial");
  Moment exact{{0, 0, 0, 0, 0, 0, 1}, {0, 0, 0, 0, 0, 0}}, found = exact;
  found.q[6] = -1;  // -Q is the same rotation
  EXPECT_EQ(motion_error(b.robot, found, exact).attitude, 0);
  found.q[3] = oracles::Real(sin(oracles::Real(0.05))), found.q[6] = oracles::Real(cos(oracles::Real(0.05)));
  EXPECT_NEAR(motion_error(b.robot, found, exact).attitude, 0.1, 1e-15);
  found.q[0] = 3, found.q[1] = 4;
  EXPECT_EQ(motion_error(b.robot, found, exact).position, 5);
}

/// The largest errors of gauss12 in double with `steps` steps.
MotionError error_of(const Benchmark& b, const Truth& truth, long steps) {
  MotionError worst = MotionError::none();
  make_runner(b, "gauss12", "double")->run({steps, 0}, 4, [&](double t, const Moment& m) {
    worst.take_larger(motion_error(b.robot, m, truth.at(t)));
  });
  return worst;
}

TEST(Truth, IsTheMotionThatTheLibrarySimulates) {
  for (const Benchmark& b : builtin_benchmarks()) {
    const auto truth = truth_of(b);
    ASSERT_TRUE(truth) << b.name;
    EXPECT_EQ(truth->closed, b.name != "chain");
    const MotionError e = error_of(b, *truth, 400);
    for (double x : {e.attitude, e.position, e.angular_velocity, e.linear_velocity})
      EXPECT_FALSE(x > 1e-12) << b.name << " " << x;
  }
}

TEST(Truth, DiffersForAChangedRobotAndIsMissingForAnUnknownEffect) {
  Benchmark b = builtin("top");
  const auto truth = truth_of(b);
  b.robot.inertias[1] = Inertia<double>(1.001, b.robot.inertias[1].lever(), b.robot.inertias[1].inertia());
  EXPECT_GT(error_of(b, *truth, 400).attitude, 1e-5);
  b.others = true;
  EXPECT_FALSE(truth_of(b));
}

TEST(LongSpins, BestErrorIsWithinTenTimesTheLimitOfConditioning) {
  double best = INFINITY;
  for (const LongSpin& s : long_spins(20)) best = std::min(best, s.error / s.limit);
  EXPECT_LE(best, 10);
}

TEST(Dzhanibekov, FlipsWhenTheClosedFormSaysUpToItsHorizon) {
  std::set<double> known;  // log10 of perturbations whose flips are right to 1e-6 in some scalar
  for (const Flips& f : dzhanibekov_flips(2)) {
    ASSERT_EQ(f.relative.size(), 2U);
    if (f.predicted == 2) known.insert(std::round(std::log10(f.perturbation)));
    if (f.perturbation >= 0.99e-8) {
      EXPECT_LE(f.relative[0], 1e-6) << f.perturbation << " " << f.scalar;
      EXPECT_GE(f.predicted, 1U);
    }
    EXPECT_EQ(f.predicted == 0, f.horizon == 0);
    if (f.perturbation < 1e-11 && f.scalar == "double") {
      EXPECT_GT(f.relative[1], 1e-6);  // beyond the horizon of double
    }
  }
  EXPECT_EQ(known, (std::set<double>{-2, -3, -4, -5, -6, -7, -8, -12}));
}

TEST(Peers, AreComparedWithOurFastestPointWhoseErrorIsNoLarger) {
  const auto point = [](double error, double ns) {
    SweepPoint p;
    p.error = MotionError::none();
    p.error.attitude = error;
    p.time.median = ns, p.time.repetitions = 9;
    return p;
  };
  SceneSweep s{builtin("pendulum"), "", true, {}, {}, {}, {}};
  s.series.push_back({"liecheck", "", "rkmk4", 4, false, {point(1e-2, 10), point(1e-6, 100)}, 0, false});
  s.series.push_back(
      {"Other", "1", "RK4", 4, false, {point(1e-3, 400), point(2e-2, 40), point(1e-6, 120)}, 0, false});
  auto c = compare_peers({s});
  ASSERT_EQ(c.size(), 1U);
  EXPECT_DOUBLE_EQ(c[0].ratio, 100.0 / 120);
  EXPECT_EQ(c[0].points, 3U);
  EXPECT_FALSE(c[0].unmatched);
  EXPECT_EQ(c[0].measure, "attitude");
  s.series[1].points.push_back(point(1e-9, 1e6));
  EXPECT_TRUE(compare_peers({s})[0].unmatched);
  // A peer may be behind in the attitude and ahead in the position.
  for (SweepSeries& series : s.series)
    for (SweepPoint& p : series.points) p.error.position = series.subject == "Other" ? 0 : 1e-12;
  c = compare_peers({s});
  ASSERT_EQ(c.size(), 2U);
  EXPECT_EQ(c[1].measure, "position");
  EXPECT_TRUE(c[1].unmatched);
  EXPECT_EQ(c[1].ours, "");
  s.series[0].points[1].error.position = 0;
  c = compare_peers({s});
  EXPECT_FALSE(c[1].unmatched);
  EXPECT_DOUBLE_EQ(c[1].ratio, 100.0 / 40);
}

TEST(SceneSweep, ThatWasStoppedMakesNoFilms) {
  SceneSweepResult r;
  r.for_report = true;
  EXPECT_FALSE(record_of(r).contains("films"));
  r.complete = true;
  EXPECT_TRUE(record_of(r).contains("films"));
}

}  // namespace
