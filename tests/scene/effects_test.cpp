// scene/effects, scene/observers, scene/starts.hpp: forces and their energy.

#include <gtest/gtest.h>

#include "../lib/random_tree.hpp"
#include "bodies.hpp"

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
  EXPECT_FALSE(
      sc::isLoneBody(sceneOf("armature: {joints: root_joint, inertia: 1}", "{body: ball, radius: 1}")));
}

double figure(const sc::Run& run, const std::string& name) {
  for (const auto& f : run.figures)
    if (f.name == name) return f.value.value();
  ADD_FAILURE() << name;
  return 0;
}
sc::Run fixture(const std::string& name) {
  return sc::run(loadScene(std::string(LIECHECK_FIXTURES) + "/scenes/" + name + ".yaml"));
}

TEST(Fixtures, AHoveringQuadrotorDoesNotMove) {
  EXPECT_EQ(figure(fixture("quadrotor_hover"), "largest change of energy"), 0);
}
TEST(Fixtures, ABodySplitIntoLinksMovesAsTheSameBodyMadeByHand) {
  auto s = loadScene(std::string(LIECHECK_FIXTURES) + "/scenes/split_body.yaml");
  EXPECT_TRUE(sc::isLoneBody(s));
  s.observers.resize(2);  // energy and momentum, which use no frames
  const sc::Run split = sc::run(s);
  // The numbers of split_body.urdf: mass, centre of mass in the first link's axes, moments, rotation.
  struct Part {
    double mass;
    Vector3<double> centre, moments;
    Eigen::Matrix3d R;
  };
  const Eigen::Matrix3d left = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()).toRotationMatrix(),
                        right = Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const Part parts[] = {{2, {0, 0, 0}, {0.002, 0.03, 0.031}, Eigen::Matrix3d::Identity()},
                        {0.5, {0.22, 0.05, 0}, {0.0004, 0.0005, 0.0006}, left},
                        {0.5, {-0.2, 0.02, 0.05}, {0.0006, 0.0005, 0.0004}, right}};
  Vector3<double> c = Vector3<double>::Zero();
  for (const Part& p : parts) c += p.mass / 3 * p.centre;
  Eigen::Matrix3d I = Eigen::Matrix3d::Zero();
  for (const Part& p : parts) {
    const Eigen::Vector3d d = p.centre - c;
    I += p.R * p.moments.asDiagonal() * p.R.transpose() +
         p.mass * (d.squaredNorm() * Eigen::Matrix3d::Identity() - d * d.transpose());
  }
  s.model = test::freeBody({3, c, I});
  const sc::Run twin = sc::run(s);
  ASSERT_EQ(split.rows.size(), twin.rows.size());
  // The inertias differ by a few eps, and t omega = 50 amplifies this in the phase. The rounding errors of
  // 10^4 steps add up at random, to 100 eps. The bound is 8 times their sum, for values of at most 10.
  for (std::size_t i = 0; i < split.rows.size(); ++i)
    EXPECT_NEAR(split.rows[i], twin.rows[i], 8 * (50 + 100) * eps<double>() * 10);
}
TEST(Fixtures, AngularMomentumIsConstantInZeroGravity) {
  EXPECT_LE(figure(fixture("chain_zero_gravity"), "largest change of angular momentum"), 1e-12);
}
TEST(Fixtures, ADroppedQuadrupedComesToRestOnItsFeet) {
  const sc::Run run = fixture("quadruped_drop");
  const std::size_t last = run.rows.size() - run.columns.size();
  for (std::size_t i = 0; i < run.columns.size(); ++i) {
    const std::string& name = run.columns[i].name;
    const double x = run.rows[last + i];
    EXPECT_TRUE(name != "trunk.z" || x > 0.25) << x;
    EXPECT_TRUE(name != "kinetic" || x < 0.001) << x;
    EXPECT_TRUE(name != "trunk.accel_z" || std::abs(x - 9.81) < 0.05) << x;  // an IMU at rest measures +g
  }
}
/// Flips of the body are half a period apart, whatever the step.
TEST(Fixtures, DzhanibekovFlipsAtEqualTimes) {
  const sc::Run run = fixture("dzhanibekov_1e-2");
  const double first = figure(run, "flip 2") - figure(run, "flip 1");
  for (int i = 3; i <= 8; ++i)
    EXPECT_NEAR(figure(run, "flip " + std::to_string(i)) - figure(run, "flip " + std::to_string(i - 1)),
                first, 1e-6 * first);
}
TEST(Starts, APrecessingTopKeepsItsInclination) {
  const sc::Run run = fixture("precessing_top");
  const std::size_t n = run.columns.size();
  double least = 1, most = -1;
  for (std::size_t r = 0; r + n <= run.rows.size(); r += n)
    for (std::size_t i = 0; i + 3 < n; ++i)
      if (run.columns[i].name == "body.qx") {
        const double x = run.rows[r + i], y = run.rows[r + i + 1], cosine = 1 - 2 * (x * x + y * y);
        least = std::min(least, cosine), most = std::max(most, cosine);
      }
  EXPECT_LE(most - least, 1e-8);
}

}  // namespace
