// scene/effects/collisions.hpp beside closed forms, and scenes of many free bodies.

#include <gtest/gtest.h>

#include <random>

#include "contact_run.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

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

}  // namespace
