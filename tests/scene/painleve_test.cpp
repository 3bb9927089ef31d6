// Painleve's paradox is named: a rod that slides with its tip on the ground.

#include <gtest/gtest.h>

#include "contact_run.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

/// A uniform rod of half length l, tilted by `angle` from the ground, whose tip slides ahead of it at 1 m/s,
/// or behind it in the direction 1: n . a = (1 + 3 cos(a) (cos(a) - mu sin(a)))/m f_n + B.
scene::Run slide(double mu, double angle, const std::string& integrator, double direction = -1) {
  const double l = 0.5, depth = 1e-4;
  const std::string text =
      "robot: {body: body, mass: 2, moments: [1e-4, 0.16666666666666666, 0.16666666666666666]}\nground: "
      "{height: 0}\n"
      "frames: [{name: tip, on: body, position: [" +
      number(-l) + ", 0, 0]}]\ninitial: {position: [0, 0, " + number(l * std::sin(angle) - depth) +
      "], attitude: [0, " + number(-angle) +
      ", 0], velocity: " + vector(V3(direction * std::cos(angle), 0, -direction * std::sin(angle))) +
      "}\neffects: [gravity, contact: {frames: [tip], stiffness: 1e5, friction: " + number(mu) +
      ", slip: 1e-4}]\n" + integrator;
  scene::Run run = scene::run(loadSceneText(text), {}, true);
  EXPECT_FALSE(run.outcome.diverged) << run.outcome.why;
  return run;
}
const std::string fine = "integrator: {name: rkmk4, step: 10 us}\nduration: 2 ms\n";

/// A = 0 at mu = (1 + 3 cos^2)/(3 sin cos), which is 4/3 at the least, where tan(a) = 2.
TEST(Painleve, TheParadoxIsNamedOnItsSideOfTheCriticalFriction) {
  for (const double angle : {0.7, std::atan(2.0), 1.3}) {
    const double s = std::sin(angle), c = std::cos(angle), critical = (1 + 3 * c * c) / (3 * s * c);
    EXPECT_EQ(slide(0.98 * critical, angle, fine).estimate->notice, "") << angle;
    EXPECT_EQ(slide(1.02 * critical, angle, fine, 1).estimate->notice, "") << angle;  // it is pulled
    const std::string notice = slide(1.02 * critical, angle, fine).estimate->notice;
    EXPECT_TRUE(notice.starts_with(
        "Painleve's paradox at t = 0 s: where the body of joint 'root_joint' slides on the world at"))
        << notice;
  }
  EXPECT_EQ(slide(1.3, std::atan(2.0), fine).estimate->notice, "");  // 4/3 is the least
}

/// The compliant law has one motion: the force grows exponentially with the rate sqrt(-A k), the tip jams,
/// and the rod leaps.
TEST(Painleve, TheCompliantLawJamsAndLeaps) {
  const double angle = std::atan(2.0);
  const scene::Run run = slide(2, angle, radau(0.1, "1e-9", 200));
  EXPECT_FALSE(run.estimate->notice.empty());
  const V3 up = velocity(run);
  EXPECT_GT(up[2], 0.1);
}

}  // namespace
