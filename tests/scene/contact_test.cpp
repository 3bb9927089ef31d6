// scene/effects/contact.hpp beside closed forms: sliding, rolling, rebound, and Jellett's integral. tests/scenes compares
// each of its terms with another formulation.

#include <gtest/gtest.h>

#include <numbers>

#include "contact_run.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

constexpr double m = 2, r = 0.1;

/// The end of a motion by radau5; `text` has all but integrator and duration.
scene::Run end(const std::string& text, double duration, const std::string& tolerance = "1e-9") {
  return runOf(text + radau(duration, tolerance));
}

/// A ball of 2 kg and 0.1 m whose contact starts with the compression at rest. `normal` is that of the ground, which
/// contains the origin.
std::string ball(const std::string& start, const std::string& contact, const V3& normal = V3(0, 0, 1)) {
  const double stiffness = 1e5, height = r - m * g * normal[2] / stiffness;  // along the normal
  return "robot: {body: ball, mass: 2 kg, radius: 0.1}\nground: {height: 0, normal: " + vector(normal) +
         "}\ninitial: {position: " + vector(height * normal) + ", " + start +
         "}\neffects:\n  - gravity\n  - contact: {frames: [body], radius: 0.1, stiffness: 1e5 N/m, slip: "
         "1e-5, " +
         contact + "}\n";
}

/// mu m g brakes the ball and turns it by mu m g r/I, I = 2/5 m r^2, until v = omega r = 5/7 v0 at 2 v0/(7 mu g).
TEST(Contact, ABallThatSlidesRollsAfterTheTimeOfTheClosedForm) {
  const double v0 = 2, mu = 0.3, rolls = 2 * v0 / (7 * mu * g);
  const std::string text = ball("velocity: [2, 0, 0]", "friction: 0.3");
  const scene::Run before = end(text, 0.9 * rolls), after = end(text, 2 * rolls);
  EXPECT_NEAR(velocity(before)[0], v0 - mu * g * 0.9 * rolls, 1e-4);
  EXPECT_NEAR(spin(before)[1], mu * g * 0.9 * rolls / (0.4 * r), 1e-3);
  EXPECT_NEAR(velocity(after)[0], v0 * 5 / 7, 1e-4);
  EXPECT_NEAR(spin(after)[1] * r, v0 * 5 / 7, 1e-4);
}

/// Without gravity, m x'' = -k x (1 + c x') conserves x'/c - ln(1 + c x')/c^2 + k x^2/(2 m): x' before and after a rebound
/// solve c v0 - ln(1 + c v0) = -c v1 - ln(1 - c v1).
TEST(Contact, AReboundHasTheRestitutionOfHuntAndCrossley) {
  for (const double c : {0.1, 0.5, 2.0}) {
    const double v0 = 1.5;
    const scene::Run e =
        end("robot: {body: ball, mass: 2 kg, radius: 0.1}\nground: {height: 0}\n"
            "initial: {position: [0, 0, 0.2], velocity: [0, 0, -1.5]}\neffects:\n"
            "  - contact: {frames: [body], radius: 0.1, stiffness: 1e4, dissipation: " +
                std::to_string(c) + "}\n",
            0.3, "1e-11");
    const double v1 = velocity(e)[2];
    EXPECT_GT(v1, 0);
    EXPECT_NEAR(c * v0 - std::log1p(c * v0), -c * v1 - std::log1p(-c * v1), 1e-8) << c;
  }
}

/// A ball with dissipation bounces lower each time and comes to rest on its compression m g/k.
TEST(Contact, ABouncingBallLosesEnergyUntilItRests) {
  const scene::Scene s = loadSceneText(
      "robot: {body: ball, mass: 2 kg, radius: 0.1}\nground: {height: 0}\ninitial: {position: [0, 0, "
      "0.3]}\neffects:\n"
      "  - gravity\n  - contact: {frames: [body], radius: 0.1, stiffness: 1e4, dissipation: 3}\n"
      "integrator: {name: radau5, tolerance: 1e-9}\nduration: 60 s\noutput: {every: 20 ms}\nobservers: "
      "[energy]\n");
  const scene::Run run = scene::run(s, {}, true);
  ASSERT_FALSE(run.outcome.diverged) << run.outcome.why;
  EXPECT_TRUE(run.estimate && run.estimate->alarms.empty());
  std::size_t total = 0;
  while (run.columns.at(total).name != "energy") ++total;
  const std::size_t n = run.columns.size();
  for (std::size_t i = n; i < run.rows.size(); i += n)
    EXPECT_LE(run.rows[i + total], run.rows[i - n + total] + 1e-7) << run.rows[i] << " s";
  const double rest = m * g * (r - m * g / 1e4) + 0.5 * m * g * m * g / 1e4;
  EXPECT_NEAR(run.rows[run.rows.size() - n + total], rest, 2e-3);
}

/// A tippe top: a ball whose centre of mass is below its centre turns over, its spin axis passing the horizontal. The
/// friction at the contact point keeps Jellett's integral L . (contact point - centre of mass) (Jellett 1872).
TEST(Contact, ATippeTopTurnsOverAndKeepsJellettsIntegral) {
  const double offset = 0.003, radius = 0.015, I = 8e-7, I3 = 7e-7, mass = 0.006;
  Model<double> model = freeBody({mass, V3(0, 0, -offset), Matrix3<double>(V3(I, I, I3).asDiagonal())});
  scene::Scene s = loadSceneText(
      "robot: {body: ball, mass: 6 g, radius: 15 mm}\nground: {height: 0}\n"
      "initial: {position: [0, 0, 0.015], attitude: [0.1, 0, 0], angular_velocity: [0, 0, 155]}\neffects:\n  "
      "- gravity\n"
      "  - contact: {frames: [body], radius: 15 mm, stiffness: 200, dissipation: 5, friction: 0.3, slip: "
      "0.01}\n"
      "integrator: {name: rkmk6, step: 0.1 ms}\nduration: 8 s\n");
  s.model = model;
  auto system = scene::makeSystem<Body>(s);
  scene::State<Body> state(system, s.q, s.v);
  const auto method = scene::makeMethod<Body>(s.integrator, s.options);
  double lowest = 1;
  std::optional<double> jellett;
  const auto outcome = scene::simulate(system, *method, state, s.span, [&](const auto& now, long) {
    const SO3<double> Q(Vector4<double>(now.q.template tail<4>()));
    const V3 axis = Q.act(V3(0, 0, 1)), w = now.v.template tail<3>();
    const V3 L = Q.act(V3(I * w[0], I * w[1], I3 * w[2]));
    const double J = L.dot(V3(offset * axis - radius * V3(0, 0, 1)));
    if (!jellett) jellett = J;
    EXPECT_NEAR(J / *jellett, 1, 1e-9) << now.t;
    lowest = std::min(lowest, axis[2]);
    return true;
  });
  EXPECT_FALSE(outcome.diverged) << outcome.why;
  EXPECT_LT(lowest, -0.9);
}

}  // namespace
