// scene/integrators, scene/lone_body.hpp, scene/tree.hpp, scene/simulate.hpp: the properties of each method.

#include <gtest/gtest.h>

#include "../lib/count_allocations.hpp"
#include "../sample.hpp"
#include "bodies.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;
using scene::MethodInfo, scene::State;

const Vec start_v = [] {
  Vec v(6);
  v << 0.5, 1, -1, 1, 0.5, 2;
  return v;
}();

class EachMethod : public testing::TestWithParam<MethodInfo> {};

/// The order is estimated from the errors with 80 and 160 steps. The estimate differs from the order by up to
/// 0.15, because these steps are not infinitely small.
TEST_P(EachMethod, HasItsDocumentedOrder) {
  const MethodInfo info = GetParam();
  Body body(freeBody(awkward()), gravity());
  const Model<double>& m = body.model();
  const Vec q = neutral(m);
  const auto exact = after(body, "gauss12", q, start_v, 2, 640);
  // With 80 steps the error of gauss12 is mere rounding.
  const long few = info.order == 12 ? 4 : 80;
  const auto error = [&](long steps) {
    const auto s = after(body, info.name, q, start_v, 2, steps,
                         1e-6 * std::pow(2.0, -5 * std::log2(double(steps) / 80)));
    return difference(m, Vec(exact.q), Vec(s.q)).norm() + (s.v - exact.v).norm();
  };
  EXPECT_NEAR(std::log2(error(few) / error(2 * few)), info.order, info.order == 12 ? 1.5 : 0.15);
}

/// A tree of one body moves on SE(3) and a lone body on R^3 x SO(3), so that their errors differ by O(h^p).
TEST_P(EachMethod, MovesATreeOfOneBodyAsItMovesALoneBody) {
  const MethodInfo info = GetParam();
  if (info.lone_body_only) GTEST_SKIP() << "for a lone body only";
  const Model<double> m = freeBody(awkward());
  Body body(m, gravity());
  scene::Tree<double> tree(m, gravity());
  const auto gap = [&](long steps) {
    const auto a =
        after(body, info.name, neutral(m), start_v, 1, steps, std::numeric_limits<double>::infinity());
    const auto b =
        after(tree, info.name, neutral(m), start_v, 1, steps, std::numeric_limits<double>::infinity());
    return difference(m, a.q, b.q).norm() + (a.v - b.v).norm();
  };
  // Rounding: the two systems compute the acceleration by different formulas, 64 eps are allowed for each step.
  const long few = info.order == 12 ? 4 : 40;
  const double coarse = gap(few), fine = gap(2 * few);
  if (fine > 64 * eps<double>() * 2 * double(few)) {
    EXPECT_NEAR(std::log2(coarse / fine), info.order, info.order == 12 ? 1.5 : 0.3);
  }
  EXPECT_LE(gap(few << 4),
            std::max(2 * coarse * std::pow(16., -info.order), 64 * eps<double>() * double(few << 4)));
}

TEST_P(EachMethod, KeepsQuaternionsAtUnitNorm) {
  Body body(freeBody(triaxial()));
  State<Body> state(body, neutral(body.model()), start_v);
  const auto method = scene::makeMethod<Body>(GetParam().name);
  double worst = 0;
  scene::simulate(body, *method, state, {100, 20000, 1}, [&](const auto& s, long) {
    const double excess = SO3<double>(Vector4<double>(s.q.template tail<4>())).normExcess();
    worst = std::max(worst, std::abs(excess / 2));
    return true;
  });
  EXPECT_LE(worst, 4 * eps<double>());
}

TEST_P(EachMethod, AllocatesNothingInAStep) {
#ifndef LIECHECK_COUNTS_ALLOCATIONS
  GTEST_SKIP() << "allocations are not counted in this build";
#else
  const auto count = [&](auto& system, const Vec& q, double h) {
    using Sys = std::remove_reference_t<decltype(system)>;
    const auto method = scene::makeMethod<Sys>(GetParam().name);
    State<Sys> state(system, q, Vec::Constant(system.nv(), 0.1));
    method->begin(system, state);
    method->step(system, state, h);
    const long before = allocations;
    for (int i = 0; i < 10; ++i) method->step(system, state, h);
    return allocations - before;
  };
  const long before = allocations;
  Vec(3).setZero();
  EXPECT_EQ(allocations - before, 1);  // the counter works
  const Model<double> one = freeBody(awkward());
  Body body(one);
  EXPECT_EQ(count(body, neutral(one), 1e-3), 0);
  if (GetParam().lone_body_only) return;
  const scene::Scene drop = loadScene(std::string(LIECHECK_FIXTURES) + "/scenes/quadruped_drop.yaml");
  auto tree = scene::makeSystem<scene::Tree<double>>(drop);
  EXPECT_EQ(count(tree, drop.q, 1e-5), 0);
#endif
}

TEST_P(EachMethod, StopsAtADivergingStepWithTheLastGoodState) {
  const MethodInfo info = GetParam();
  Body body(freeBody(triaxial()));
  Vec v = start_v;
  v.tail<3>() *= 1e200;  // its square overflows
  State<Body> state(body, neutral(body.model()), v);
  const auto method = scene::makeMethod<Body>(info.name);
  const auto outcome =
      scene::simulate(body, *method, state, {1, 10, 1}, [](const auto&, long) { return true; });
  EXPECT_TRUE(outcome.diverged);
  EXPECT_EQ(outcome.steps, 0);
  EXPECT_FALSE(outcome.why.empty());
  EXPECT_EQ(Vec(state.v), v);
  EXPECT_EQ(Vec(state.q), neutral(body.model()));
}

INSTANTIATE_TEST_SUITE_P(Scene, EachMethod, testing::ValuesIn(scene::methodInfos()),
                         [](const auto& i) { return std::string(i.param.name); });

TEST(Methods, AnUnknownNameIsRefusedWithTheNearestNames) {
  try {
    scene::makeMethod<Body>("rkmk5");
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(), "no integrator is named 'rkmk5', the nearest are 'rkmk4', 'rkmk6' and 'rk2'");
  }
}

TEST(Variational, KeepsTheMomentumVectorAndTheEnergyWithoutDrift) {
  const long n = liecheck::sample(1'000'000L, 10'000'000L);
  Body body(freeBody(awkward()));
  const Inertia<double> I = awkward();
  State<Body> state(body, neutral(body.model()), start_v);
  const auto method = scene::makeMethod<Body>("variational");
  const double h = 0.01;
  const auto momentum = [&](const auto& s) {
    const SO3<double> Q(Vector4<double>(s.q.template tail<4>()));
    return Q.act(V3(I.inertia() * s.v.template tail<3>()));
  };
  const V3 L = momentum(state);
  double norm = 0, worst = 0, t1 = 0, e1 = 0, tt = 0, te = 0, ee = 0, least = 1e300, most = -1e300, first = 0,
         middle = 0, before = 0;
  long crossings = 0;
  scene::simulate(body, *method, state, {h * double(n), n, 1}, [&](const auto& s, long k) {
    norm = std::max(norm, std::abs(SO3<double>(Vector4<double>(s.q.template tail<4>())).normExcess()) / 2);
    if (k > 0)
      worst =
          std::max(worst, (momentum(s) - L).norm() / (8 * std::sqrt(double(k)) * eps<double>() * L.norm()));
    const double energy = I.kineticEnergy(Motion<double>(Vector6<double>(body.toModel(s).second)));
    if (k == 0) first = energy;
    const double t = double(k) / double(n) - 0.5, e = energy / first - 1;
    t1 += t, e1 += e, tt += t * t, te += t * e, ee += e * e;
    least = std::min(least, e), most = std::max(most, e);
    if (k == n / 20) middle = (least + most) / 2;
    if (k > n / 20 && before < middle && e >= middle) ++crossings;
    before = e;
    return true;
  });
  const double count = double(n) + 1, slope = (te - t1 * e1 / count) / (tt - t1 * t1 / count);
  std::printf(
      "%ld steps: | |q| - 1 | <= %.2f eps, relative momentum error after k steps <= %.3f * 8 sqrt(k) eps, "
      "energy oscillates by %.3g and drifts by %.3g\n",
      n, norm / eps<double>(), worst, most - least, slope);
  EXPECT_LE(norm, 4 * eps<double>());
  EXPECT_LE(worst, 1);
  // The least-squares line of an oscillation can have a slope even if nothing drifts. Over the whole
  // duration it rises or falls by at most about (6/pi) * amplitude / (number of periods).
  const double periods = double(crossings) / 0.95;
  EXPECT_GT(periods, 100);
  EXPECT_LE(std::abs(slope), 2 * (most - least) / periods);
}

/// An explicit method does not keep the momentum. This shows that the test above can fail.
TEST(Variational, AnExplicitMethodLosesMomentum) {
  Body body(freeBody(awkward()));
  const Inertia<double> I = awkward();
  const auto s = after(body, "rkmk4", neutral(body.model()), start_v, 100, 10000);
  const SO3<double> Q(Vector4<double>(s.q.tail<4>()));
  const V3 L0 = I.inertia() * V3(start_v.tail<3>()), L = Q.act(V3(I.inertia() * s.v.tail<3>()));
  EXPECT_GT((L - L0).norm(), 8 * std::sqrt(10000.0) * eps<double>() * L0.norm());
}

/// The velocity after a step is found by iteration. With these coefficients it oscillates, or overflows.
TEST(Variational, AFailedStepLeavesTheStateUnchanged) {
  for (const std::string drag : {"linear: 4", "quadratic: 100"}) {
    const scene::Scene s = loadSceneText(
        "robot: {body: ball, radius: 1}\nintegrator: {name: variational, step: 1 s}\nduration: 1 s\n"
        "effects: [drag: {frame: body, " +
        drag + "}]\n");
    auto body = scene::makeSystem<Body>(s);
    const State<Body> start(body, s.q, start_v);
    State<Body> state = start;
    scene::Variational<double> method;
    method.begin(body, state);
    EXPECT_THROW(method.step(body, state, 1), scene::StepFailed) << drag;
    EXPECT_TRUE(state.q == start.q && state.v == start.v) << drag;
  }
}

/// Compares 100 revolutions in 4000 and in 8000 steps, which differ only in their rounding errors.
TEST(Gauss12, RoundingErrorsStayWithinTenEpsOfTheAngleTurned) {
  Body body(freeBody(triaxial()));
  Vec v = Vec::Zero(6);
  v.tail<3>() << 0.5, 0.25, 1;
  const double revolutions = 100, duration = revolutions * 2 * pi<double>();
  const auto a = after(body, "gauss12", neutral(body.model()), v, duration, 4000);
  const auto b = after(body, "gauss12", neutral(body.model()), v, duration, 8000);
  const double angle = differenceSE3<double>(a.q, b.q).tail<3>().norm();
  EXPECT_LE(angle, 10 * revolutions * 2 * pi<double>() * eps<double>());
}

TEST(LoneBody, WithoutInertiaIsRefused) {
  EXPECT_THROW(Body(freeBody({1, V3::Zero(), Matrix3<double>(V3(1, 1, 0).asDiagonal())})), SingularInertia);
  EXPECT_THROW(Body(freeBody({0, V3::Zero(), Matrix3<double>::Identity()})), SingularInertia);
}

}  // namespace
