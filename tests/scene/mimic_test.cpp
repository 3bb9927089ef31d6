// Scenes of robots with mimic joints: compared with the same robot whose tie is eliminated by hand.

#include <gtest/gtest.h>

#include "recorded.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

/// tied_rods.urdf in the plane: x = hip, the angle of the shank is 0.3 - x. Centres: p1 = c of the thigh, p2 of the
/// shank, as (y, z).
struct TiedRods {
  static constexpr double m1 = 1, m2 = 0.6, I1 = 0.03, I2 = 0.01, g = 9.81, length = 0.5, multiplier = -2,
                          offset = 0.3;
  static double turned(double angle, double y, double z, bool vertical) {
    return vertical ? std::sin(angle) * y + std::cos(angle) * z : std::cos(angle) * y - std::sin(angle) * z;
  }
  /// The centres' coordinates (y1, z1, y2, z2).
  static Vector4<double> centres(double x) {
    const double shank = x + multiplier * x + offset;
    Vector4<double> p;
    for (int k = 0; k < 2; ++k) {
      p[k] = turned(x, 0, -0.25, k);
      p[2 + k] = turned(x, 0, -length, k) + turned(shank, 0.02, -0.2, k);
    }
    return p;
  }
  /// dp/dx and d^2p/dx^2, by hand: each term turns with its angle.
  static std::pair<Vector4<double>, Vector4<double>> rates(double x) {
    const double s = 1 + multiplier, shank = s * x + offset;
    Vector4<double> d, dd;
    const double quarter = std::acos(-1.0) / 2;
    for (int k = 0; k < 2; ++k) {
      d[k] = turned(x + quarter, 0, -0.25, k), dd[k] = -turned(x, 0, -0.25, k);
      d[2 + k] = turned(x + quarter, 0, -length, k) + s * turned(shank + quarter, 0.02, -0.2, k);
      dd[2 + k] = -turned(x, 0, -length, k) - s * s * turned(shank, 0.02, -0.2, k);
    }
    return {d, dd};
  }
  /// x_ddot of M(x) x_ddot + M'(x)/2 x_dot^2 + V'(x) + damping x_dot = 0.
  static double acceleration(double x, double v, double damping) {
    const auto [d, dd] = rates(x);
    const Vector4<double> m(m1, m1, m2, m2);
    const double s = 1 + multiplier, M = d.cwiseProduct(m).dot(d) + I1 + s * s * I2;
    return -(d.cwiseProduct(m).dot(dd) * v * v + g * (m1 * d[1] + m2 * d[3]) + damping * v) / M;
  }
  static double energy(double x, double v) {
    const auto [d, dd] = rates(x);
    const Vector4<double> m(m1, m1, m2, m2), p = centres(x);
    const double s = 1 + multiplier;
    return (d.cwiseProduct(m).dot(d) + I1 + s * s * I2) / 2 * v * v + g * (m1 * p[1] + m2 * p[3]);
  }
};

std::string tiedRods(const std::string& effects, const std::string& method) {
  return "robot: {urdf: tied_rods.urdf, root: fixed}\ninitial: {joints: {hip: 1.2}, joint_velocities: {hip: "
         "0.5}}\n"
         "effects: [gravity" +
         effects + "]\nintegrator: {name: " + method +
         "}\nduration: 2 s\noutput: {every: 0.1 s}\nobservers: [state, energy, frame: {frame: shank}]\n";
}

TEST(Mimic, MovesAsTheRobotWhoseTieIsEliminatedByHand) {
  for (const double damping : {0.0, 0.4}) {
    const Recorded run(
        tiedRods(damping > 0 ? ", joint_damping: {coefficient: 0.4}" : "", "gauss6, step: 5 ms"));
    ASSERT_EQ(run.scene.model.nv, 1);
    Eigen::Vector2d x(1.2, 0.5);
    for (std::size_t i = 1; i < run["t"].size(); ++i) {
      rungeKutta(x, 1e-3, 100, [&](const auto& y) {  // its error is below 1e-11
        return Eigen::Vector2d(y[1], TiedRods::acceleration(y[0], y[1], damping));
      });
      EXPECT_NEAR(run["q.hip"][i], x[0], 1e-9);
      EXPECT_NEAR(run["v.hip"][i], x[1], 1e-9);
      EXPECT_NEAR(run["a.hip"][i], TiedRods::acceleration(run["q.hip"][i], run["v.hip"][i], damping), 1e-11);
      EXPECT_NEAR(run["energy"][i], TiedRods::energy(run["q.hip"][i], run["v.hip"][i]), 1e-13 * 10);
      // the tie: the shank's angle about x is 0.3 - hip, exactly at all times
      const double angle = 2 * std::atan2(run["shank.qx"][i], run["shank.qw"][i]);
      EXPECT_NEAR(std::remainder(angle - (0.3 - run["q.hip"][i]), 2 * std::acos(-1.0)), 0, 1e-14);
    }
  }
}

TEST(Mimic, IsAccusedOfNothingByTheEstimate) {
  const auto s = loadSceneText(tiedRods("", "rkmk4, step: 5 ms"), "s.yaml", LIECHECK_FIXTURES "/scenes");
  const auto run = scene::run(s, {}, true);
  ASSERT_TRUE(run.estimate);
  EXPECT_TRUE(run.estimate->alarms.empty());
}

}  // namespace
