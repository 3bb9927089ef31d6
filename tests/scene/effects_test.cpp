// scene/effects, scene/observers, scene/starts.hpp: forces and their energy.

#include <gtest/gtest.h>

#include "../lib/random_tree.hpp"
#include "recorded.hpp"

namespace {

using namespace liecheck;
namespace sc = liecheck::scene;

sc::Scene sceneOf(const std::string& effects,
                  const std::string& robot = "{urdf: chain.urdf, root: free_flyer}") {
  return loadSceneText("robot: " + robot + "\nground: {height: 100}\ninitial: {joints: {}}\neffects: [" +
                           effects + "]\nintegrator: {name: rkmk4, step: 1 ms}\nduration: 1 s\n",
                       "s.yaml", std::string(LIECHECK_FIXTURES) + "/scenes");
}
/// The power of an effect's forces and the rate of its potential, in a random state.
struct Rates {
  double power, potential_rate;
};
Rates rates_of(const std::string& effect) {
  const sc::Scene scene = sceneOf(effect);
  auto tree = sc::makeSystem<sc::Tree<double>>(scene);
  const auto& e = tree.effects().at(0);
  test::Random random(7);
  const VectorX<double> q = integrate(scene.model, scene.q, random.tangent(scene.model.nv, 1.5)),
                        v = random.tangent(scene.model.nv, 2);
  const auto now = tree.here(0.25, q, v, sc::Kinematics::Velocities);
  std::vector<double> tau(std::size_t(scene.model.nv), 0.0);
  std::vector<Force<double>> f(std::size_t(scene.model.njoints), Force<double>::Zero());
  e->add(now, {tau, f});
  Rates rates{0, 0};
  for (std::size_t k = 0; k < tau.size(); ++k) rates.power += tau[k] * v[int(k)];
  for (std::size_t i = 1; i < f.size(); ++i) rates.power += f[i].dot(now.V.inWorld(i));
  const double h = 1e-5;  // the truncation error h^2 and the rounding error eps/h are at most 1e-10
  const auto V = [&](double s) {
    const VectorX<double> moved = integrate(scene.model, q, s * v);
    return e->potential(tree.here(0.25, moved, v, sc::Kinematics::Poses));
  };
  rates.potential_rate = (V(h) - V(-h)) / (2 * h);
  return rates;
}

TEST(Effects, PowerOfConservativeForcesIsTheLossOfTheirPotential) {
  for (const char* effect :
       {"joint_spring: {stiffness: 3, rest: 0.2}", "joint_limits: {joints: hinge1, stiffness: 50}",
        "buoyancy: {frame: bar3, volume: 2 l}", "contact: {frames: [bar5, bar2], stiffness: 40}"}) {
    const Rates rates = rates_of(effect);
    EXPECT_NEAR(rates.power, -rates.potential_rate, 1e-6 * (1 + std::abs(rates.power))) << effect;
    EXPECT_TRUE(std::abs(rates.power) > 1e-3 || std::string(effect).find("limits") != std::string::npos)
        << effect;
  }
}

/// The force [N, world] and moment [N m, body] of all effects at the centre of mass, which is the origin here.
Force<double> forceOn(sc::LoneBody<double>& body, double t, const Vector7<double>& q,
                      const Vector6<double>& v) {
  body.load(t, q, v);
  return Force<double>(body.force(v), body.moment(v));
}

TEST(Effects, ContactNeverPullsAndIsContinuousAtTouchdown) {
  const auto force = [&](double z, double rate) {
    sc::Scene s = loadSceneText(
        "robot: {body: ball, radius: 1}\nground: {height: 0}\neffects: [contact: {frames: body, stiffness: "
        "100, dissipation: 2, "
        "friction: 0.5}]\nintegrator: {name: rkmk4, step: 1 ms}\nduration: 1 s\n");
    auto body = sc::makeSystem<sc::LoneBody<double>>(s);
    s.q[2] = z;
    Vector6<double> v = Vector6<double>::Zero();
    v[2] = rate, v[0] = 10;
    return forceOn(body, 0, s.q, v).linear();
  };
  EXPECT_TRUE(force(0, -1).isZero(0));
  EXPECT_TRUE(force(-0.1, 10).isZero(0));  // the body leaves fast and is not held back
  const auto f = force(-0.1, -0.5);
  EXPECT_DOUBLE_EQ(f[2], 100 * 0.1 * (1 + 2 * 0.5));
  EXPECT_NEAR(f[0], -0.5 * f[2], 1e-6 * f[2]);
}

TEST(Effects, ABodyWithArmatureIsSimulatedAsATree) {
  EXPECT_TRUE(sc::isLoneBody(sceneOf("gravity", "{body: ball, radius: 1}")));
  EXPECT_TRUE(sc::isLoneBody(loadScene(std::string(LIECHECK_FIXTURES) + "/scenes/split_body.yaml")));
  EXPECT_FALSE(
      sc::isLoneBody(sceneOf("armature: {joints: root_joint, inertia: 1}", "{body: ball, radius: 1}")));
}

test::Recorded fixture(const std::string& name) {
  return test::Recorded(loadScene(LIECHECK_FIXTURES "/scenes/" + name + ".yaml"));
}

TEST(Fixtures, AHoveringQuadrotorDoesNotMove) {
  EXPECT_EQ(fixture("quadrotor_hover").figure("largest change of energy"), 0);
}
TEST(Fixtures, AngularMomentumIsConstantInZeroGravity) {
  EXPECT_LE(fixture("chain_zero_gravity").figure("largest change of angular momentum"), 1e-12);
}
TEST(Fixtures, ADroppedQuadrupedComesToRestOnItsFeet) {
  const test::Recorded run = fixture("quadruped_drop");
  EXPECT_GT(run["trunk.z"].back(), 0.25);
  EXPECT_LT(run["kinetic"].back(), 0.001);
  EXPECT_NEAR(run["trunk.accel_z"].back(), 9.81, 0.05);  // an IMU at rest measures +g
}
/// Flips of the body are half a period apart, whatever the step.
TEST(Fixtures, DzhanibekovFlipsAtEqualTimes) {
  const test::Recorded run = fixture("dzhanibekov_1e-2");
  const auto flip = [&](int i) { return run.figure("flip " + std::to_string(i)); };
  const double first = flip(2) - flip(1);
  for (int i = 3; i <= 8; ++i) EXPECT_NEAR(flip(i) - flip(i - 1), first, 1e-6 * first);
}
TEST(Starts, APrecessingTopKeepsItsInclination) {
  const test::Recorded run = fixture("precessing_top");
  const auto x = run["body.qx"], y = run["body.qy"];
  for (std::size_t i = 0; i < x.size(); ++i)  // the cosine is 1 - 2 (x^2 + y^2)
    EXPECT_NEAR(x[i] * x[i] + y[i] * y[i], x[0] * x[0] + y[0] * y[0], 2.5e-9);
}

}  // namespace
