// scene/effects/collisions.hpp beside closed forms, and scenes of many free bodies.

#include <gtest/gtest.h>

#include <random>

#include "contact_run.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

/// Two balls of 1 kg and `heavy` that meet at 3 m/s.
std::string meeting(const std::string& heavy, const std::string& contact, const std::string& offset = "0") {
  return "robot:\n  bodies:\n    - {name: a, body: ball, mass: 1, radius: 0.1, position: [0, " + offset +
         ", 0], velocity: [2, 0, 0]}\n    - {name: b, body: ball, mass: " + heavy +
         ", radius: 0.2, position: [0.5, 0, 0], velocity: [-1, 0, 0]}\neffects: [collisions: {stiffness: "
         "1e4, " +
         contact + "}]\n";
}

/// v_a' = ((m_a - m_b) v_a + 2 m_b v_b)/(m_a + m_b), and with a and b exchanged.
TEST(Collisions, AnElasticCollisionExchangesVelocitiesAsTheMassesSay) {
  const scene::Run run = runOf(meeting("3", "dissipation: 0") + radau(0.3, "1e-11"));
  EXPECT_NEAR(run.v[0], ((1 - 3) * 2 + 2 * 3 * -1.) / 4, 1e-8);
  EXPECT_NEAR(run.v[6], ((3 - 1) * -1 + 2 * 1 * 2.) / 4, 1e-8);
  EXPECT_GE(run.outcome.events, 2);
}

/// The relative velocity obeys the equation of a rebound: c v0 - ln(1 + c v0) = -c v1 - ln(1 - c v1).
TEST(Collisions, ACollisionHasTheRestitutionOfHuntAndCrossley) {
  const double c = 0.4, v0 = 3;
  const scene::Run run = runOf(meeting("3", "dissipation: 0.4") + radau(0.4, "1e-11"));
  const double v1 = run.v[6] - run.v[0];
  EXPECT_NEAR(c * v0 - std::log1p(c * v0), -c * v1 - std::log1p(-c * v1), 1e-8);
  EXPECT_NEAR(run.v[0] + 3 * run.v[6], 2 - 3, 1e-10);
}

/// An impact off the centres, with friction, keeps momentum, and angular momentum about the origin: the
/// reaction acts at the same point. Smooth balls keep their spin; rough ones get the spin of mu times the
/// normal impulse, r J/I.
TEST(Collisions, AnObliqueCollisionKeepsMomentumAndAngularMomentum) {
  const auto momenta = [](const Vec& q, const Vec& v) {
    V3 P = V3::Zero(), L = V3::Zero();
    const double mass[] = {1, 3}, r[] = {0.1, 0.2};
    for (int i = 0; i < 2; ++i) {
      const SO3<double> R = attitude(q, 7 * i);
      const V3 p = mass[i] * R.act(V3(v.segment<3>(6 * i))), x = q.segment<3>(7 * i);
      P += p;
      L += x.cross(p) + 0.4 * mass[i] * r[i] * r[i] * R.act(V3(v.segment<3>(6 * i + 3)));
    }
    return std::pair(P, L);
  };
  const scene::Scene s =
      loadSceneText(meeting("3", "friction: 0.3, slip: 0.01, rolling: 1 mm, torsion: 1 mm", "0.15") +
                    "integrator: {name: rkmk4, step: 50 us}\nduration: 0.3 s\n");
  const auto before = momenta(s.q, s.v);
  const scene::Run run = scene::run(s);
  const auto after = momenta(run.q, run.v);
  EXPECT_LT((after.first - before.first).norm(), 1e-8);
  EXPECT_LT((after.second - before.second).norm(), 1e-8);
  EXPECT_GT(std::abs(run.v[5]), 1);  // it spins
}

/// A ball between a wall of the world and another ball: what stands in the world does not move.
TEST(Collisions, ABallReboundsFromABoxThatStandsInTheWorld) {
  const auto thrown = [](const std::string& box) {
    return runOf(
        "robot: {body: ball, mass: 2, radius: 0.1}\nshapes:\n  - {shape: sphere, on: body, radius: 0.1}\n"
        "  - {shape: box, on: universe, " +
        box + "}\ninitial: {velocity: [0, 0, -1]}\neffects: [collisions: {stiffness: 1e5}]\n" +
        radau(0.6, "1e-11"));
  };
  // below its face, then turned so that an edge is below: the ball meets it in the same way, at the height of
  // the edge
  const scene::Run face = thrown("size: [1, 1, 0.2], position: [0.2, 0.1, -0.3]");
  const scene::Run edge = thrown("size: [0.4, 2, 0.4], position: [0, 0, -" +
                                 number(0.2 + 0.2 * std::sqrt(2)) + "], attitude: [0, 45 deg, 0]");
  EXPECT_NEAR(face.v[2], 1, 1e-8);
  EXPECT_NEAR(edge.v[2], 1, 1e-8);
}

/// Two capsules at right angles touch where their axes cross: at the distance 2 r, as spheres there.
TEST(Collisions, CrossedCapsulesMeetAsSpheresWhereTheirAxesCross) {
  const auto run = [](const std::string& first, const std::string& second) {
    return runOf(
        "robot:\n  bodies:\n    - {name: a, body: body, moments: [1, 1, 1], position: [0, 0, 0.3], velocity: "
        "[0, 0, -1]}\n"
        "    - {name: b, body: body, moments: [1, 1, 1]}\nshapes: [{on: a, " +
        first + "}, {on: b, " + second + "}]\neffects: [collisions: {stiffness: 1e4, exponent: 1.5}]\n" +
        radau(0.4, "1e-10"));
  };
  const scene::Run
      spheres = run("shape: sphere, radius: 0.1", "shape: sphere, radius: 0.1"),
      crossed =
          run("shape: capsule, radius: 0.1, length: 1, position: [0.2, 0, 0], attitude: [0, 90 deg, 0]",
              "shape: capsule, radius: 0.1, length: 1, position: [0, -0.1, 0], attitude: [90 deg, 0, 0]");
  EXPECT_LT((spheres.v - crossed.v).norm(), 1e-8);
  EXPECT_NEAR(spheres.v[8], -1, 1e-8);
}

/// The accelerations of 40 balls, more than 64 pairs, are those of a sum over all pairs.
TEST(Collisions, TheSweepFindsTheForcesOfAllPairs) {
  const scene::Scene s = loadSceneText(
      "robot: {bodies: [{name: a, body: ball, mass: 1, radius: 0.1, copies: [5, 4, 2], spacing: [0.1, 0.1, "
      "0.1]}]}\n"
      "effects: [collisions: {stiffness: 100}]\nintegrator: {name: rkmk4, step: 1 ms}\nduration: 1 s\n");
  auto system = scene::makeSystem<scene::Tree<double>>(s);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(-0.3, 0.3);
  long touching = 0;
  for (int n = 0; n < 20; ++n) {
    Vec q = s.q, v = s.v, a = s.v;
    std::vector<V3> x;
    for (int i = 0; i < 40; ++i) {
      x.emplace_back(place(random), place(random), place(random));
      q.segment<3>(7 * i) = x.back();
    }
    system.acceleration(0, q, v, a);
    for (int i = 0; i < 40; ++i) {
      V3 force = V3::Zero();
      for (int j = 0; j < 40; ++j)
        if (const V3 d = x[std::size_t(i)] - x[std::size_t(j)]; i != j && d.norm() < 0.2)
          force += 100 * (0.2 - d.norm()) * d / d.norm(), ++touching;
      EXPECT_LT((a.segment<3>(6 * i) - force).norm(), 1e-12 * (1 + force.norm())) << i;
    }
  }
  EXPECT_GT(touching, 1000);
}

/// 666 balls above the ground, in three dimensions (SimBenchmark; Hwangbo et al.).
std::string balls666(const std::string& contact) {
  return "robot:\n  bodies:\n"
         "    - {name: a, body: ball, mass: 1, radius: 0.1, position: [0, 0, 0.12], copies: [6, 6, 9], "
         "spacing: [0.24, 0.25, 0.41]}\n"
         "    - {name: b, body: ball, mass: 1, radius: 0.1, position: [0.04, 0.03, 0.33], copies: [6, 6, 9], "
         "spacing: [0.23, 0.24, 0.41]}\n"
         "    - {name: c, body: ball, mass: 1, radius: 0.1, position: [0.02, 0.07, 3.9], copies: [6, 3, 1], "
         "spacing: [0.26, 0.5, 0]}\n"
         "ground: {height: 0}\nobservers: [energy, momentum]\neffects: [gravity, collisions: {" +
         contact + "}, contact: {bodies: all, " + contact + "}]\n";
}

/// Without dissipation the energy of 666 balls is constant, and horizontal momentum stays 0: inner forces
/// cancel, and the smooth ground pushes upwards only.
TEST(Collisions, SixHundredAndSixtySixElasticBallsKeepEnergyAndHorizontalMomentum) {
  const scene::Run run =
      runOf(balls666("stiffness: 2e4, exponent: 1.5") +
            "integrator: {name: rkmk4, step: 1 ms}\nduration: 0.4 s\noutput: {every: 20 ms}\n");
  const auto energy = column(run, "energy");
  const auto kinetic = column(run, "kinetic");
  for (const double E : energy)
    EXPECT_NEAR(E, energy[0], 1e-3 * *std::max_element(kinetic.begin(), kinetic.end()));
  for (const char* P : {"P_x", "P_y"})
    for (const double p : column(run, P)) EXPECT_NEAR(p, 0, 1e-9);
  EXPECT_EQ(run.q.size(), 7 * 666);
}

/// A heap of balls that lose energy settles: energy never rises, and all end at rest. None sinks in.
TEST(Collisions, AHeapOfBallsComesToRestAndItsEnergyNeverRises) {
  const std::string law =
      "stiffness: 1e4, dissipation: 1, friction: 0.5, slip: 0.01, rolling: 1 cm, torsion: 5 mm, "
      "angular_slip: 0.1";
  const scene::Run run = runOf(
      "robot:\n  bodies:\n"
      "    - {name: a, body: ball, radius: 0.1, position: [0, 0, 0.12], copies: [3, 3, 3], spacing: [0.22, "
      "0.23, 0.38]}\n"
      "    - {name: b, body: ball, radius: 0.1, position: [0.1, 0.12, 0.3], copies: [2, 2, 3], spacing: "
      "[0.21, 0.24, 0.38]}\n"
      "ground: {height: 0}\nobservers: [energy]\neffects: [gravity, collisions: {" +
      law + "}, contact: {bodies: all, " + law +
      "}]\nintegrator: {name: rkmk4, step: 0.5 ms}\nduration: 3 s\noutput: {every: 10 ms}\n");
  const auto energy = column(run, "energy"), kinetic = column(run, "kinetic");
  for (std::size_t i = 1; i < energy.size(); ++i) EXPECT_LE(energy[i], energy[i - 1] + 1e-6) << i;
  EXPECT_GT(*std::max_element(kinetic.begin(), kinetic.end()), 10);
  EXPECT_LT(kinetic.back(), 1e-3);
  for (int i = 0; i < 39; ++i) EXPECT_GT(run.q[7 * i + 2], 0.1 - 0.02) << i;
}

}  // namespace
