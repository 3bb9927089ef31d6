// scene/effects/contact.hpp beside closed forms: sliding, rolling, slopes, rebound, and Jellett's integral.

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
V3 slope(double angle) {
  return {std::sin(angle), 0, std::cos(angle)};
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

/// It rolls with 5/7 g sin(a) if tan(a) <= 7/2 mu, and slides with g (sin(a) - mu cos(a)) on a steeper slope.
TEST(Contact, ABallOnASlopeRollsOrSlidesOnBothSidesOfTheCriticalSlope) {
  const double mu = 0.2, critical = std::atan(3.5 * mu), t = 0.4;
  for (const double angle : {0.9 * critical, 1.1 * critical}) {
    const scene::Run e = end(ball("velocity: [0, 0, 0]", "friction: 0.2", slope(angle)), t);
    const double rolls = 5. / 7 * g * std::sin(angle), slides = g * (std::sin(angle) - mu * std::cos(angle));
    EXPECT_NEAR(velocity(e).norm(), t * (angle < critical ? rolls : slides), 2e-4) << angle;
    EXPECT_GT(velocity(e)[0], 0);
  }
}

/// A rolling resistance rho N brakes a rolling ball with 5/7 rho g/r, and torsion stops a spin with tau m g/I.
TEST(Contact, RollingAndTorsionalFrictionBrakeAsTheirClosedForms) {
  const scene::Run rolled = end(ball("velocity: [1, 0, 0], angular_velocity: [0, 10, 0]",
                                     "friction: 0.5, rolling: 2 mm, angular_slip: 1e-4"),
                                1);
  EXPECT_NEAR(velocity(rolled)[0], 1 - 5. / 7 * 0.002 * g / r, 1e-4);
  const scene::Run spun = end(ball("angular_velocity: [0, 0, 30]", "torsion: 1 mm, angular_slip: 1e-4"), 1);
  EXPECT_NEAR(spin(spun)[2], 30 - 0.001 * g / (0.4 * r * r), 1e-4);
}

/// On a slope below the critical angle atan(mu) the box creeps with v_s s/sqrt(1 - s^2), s = tan(a)/mu; above it slides.
TEST(Contact, ABoxOnASlopeCreepsOrSlidesOnBothSidesOfTheCriticalAngle) {
  const double mu = 0.5, slip = 1e-4, stiffness = 1e5, t = 0.3;
  for (const double share : {0.9, 1.1}) {
    const double angle = std::atan(share * mu), depth = m * g * std::cos(angle) / (4 * stiffness);
    const V3 n = slope(angle), at = (0.05 - depth) * n;
    const scene::Run e =
        end("robot: {body: box, mass: 2 kg, size: [2, 2, 0.1]}\nground: {height: 0, normal: " + vector(n) +
                "}\n" + corners(1, 1, -0.05) + "initial: {position: " + vector(at) + ", attitude: [0, " +
                number(angle) +
                ", 0]}\neffects:\n  - gravity\n"
                "  - contact: {frames: [c1, c2, c3, c4], stiffness: 1e5, dissipation: 5, friction: 0.5, "
                "slip: 1e-4}\n",
            t);
    const double along = velocity(e).dot(V3(std::cos(angle), 0, -std::sin(angle)));
    if (share < 1)
      EXPECT_NEAR(along, slip * share / std::sqrt(1 - share * share), 0.02 * slip);
    else
      EXPECT_NEAR(along, t * g * (std::sin(angle) - mu * std::cos(angle)), 1e-3);
  }
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

/// A block of width 2 b and height 2 h that stands tilted by phi on one edge falls back as a pendulum upside down about that
/// edge (Housner 1963): (I + m R^2) phi'' = -m g R sin(a - phi), with R^2 = b^2 + h^2 and tan a = b/h. It lands upright
/// when phi = 0, and then rocks on its other edge.
TEST(Contact, ATiltedBlockFallsBackAsAPendulumAndRocksOnItsOtherEdge) {
  const double b = 0.1, h = 0.5, R = std::hypot(b, h), a = std::atan2(b, h), tilt = a / 2;
  const double I = m / 12 * (4 * b * b + 4 * h * h) + m * R * R, depth = m * g / 2e6;
  double phi = tilt, rate = 0, t = 0;
  const double dt = 1e-5;  // the midpoint rule, with an error of 1e-10
  const auto pull = [&](double x) { return -m * g * R / I * std::sin(a - x); };
  std::vector<double> fall;  // phi at t = 0, dt, 2 dt, ...
  for (; phi > 0; t += dt) {
    fall.push_back(phi);
    const double middle = phi + dt / 2 * rate, faster = rate + dt / 2 * pull(phi);
    phi += dt * faster, rate += dt * pull(middle);
  }
  scene::Scene s = loadSceneText(
      "robot: {body: box, mass: 2 kg, size: [0.2, 0.3, 1]}\nground: {height: 0}\n" +
      corners(0.1, 0.15, -0.5) +
      "initial: {position: " + vector(V3(-R * std::sin(a - tilt), 0, R * std::cos(a - tilt) - depth)) +
      ", attitude: [0, " + number(tilt) +
      ", 0]}\neffects:\n  - gravity\n"
      "  - contact: {frames: [c1, c2, c3, c4], stiffness: 1e6, dissipation: 1, friction: 2, slip: 1e-4}\n"
      "integrator: {name: radau5, tolerance: 1e-7}\nduration: 1 s\n");
  s.span = {1.4 * t, 14, 1};
  auto system = scene::makeSystem<Body>(s);
  scene::State<Body> state(system, s.q, s.v);
  const auto method = scene::makeMethod<Body>(s.integrator, s.options);
  const auto outcome = scene::simulate(system, *method, state, s.span, [&](const auto& now, long n) {
    const double turned = 2 * std::atan2(now.q[4], now.q[6]);
    if (n < 10) {
      EXPECT_NEAR(turned, fall[std::size_t(std::lround(double(n) * t / 10 / dt))], 3e-4) << n;
    } else if (n == 14) {
      EXPECT_LT(turned, -0.01);
    }
    return true;
  });
  EXPECT_FALSE(outcome.diverged) << outcome.why;
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
