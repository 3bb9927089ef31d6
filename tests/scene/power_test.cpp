// scene/observers/power.hpp: powers against closed forms, and the energy ledger: it closes with the order of the
// method and to rounding, and stays open for a wrong power or a wrong potential.

#include <gtest/gtest.h>

#include <liecheck/scene/observers/power.hpp>

#include "recorded.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

const std::string drop =
    "robot: {body: ball, mass: 2, radius: 0.1}\ninitial: {velocity: [3, 0, 0]}\n"
    "effects: [drag: {frame: body, linear: 1.5}]\n";

TEST(Power, OfLinearDragIsThatOfTheClosedForm) {
  const Recorded run(drop + "integrator: {name: gauss12, step: 10 ms}\nduration: 1 s\nobservers: [power]\n");
  const auto t = run["t"], power = run["power.drag"], work = run["work.drag"];
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double v = 3 * std::exp(-1.5 / 2 * t[i]);
    EXPECT_NEAR(power[i], -1.5 * v * v, 1e-13 * 13.5);
    EXPECT_NEAR(work[i], (v * v - 9), 1e-13 * 9);
  }
}

TEST(Power, OfGravityIsTheWeightTimesTheVelocityOfTheCentreOfMass) {
  const Recorded run(
      "robot: {urdf: chain.urdf, root: free_flyer}\n"
      "initial: {velocity: [1, 2, 3], joint_velocities: {hinge1: 3}}\neffects: [gravity]\n"
      "integrator: {name: rkmk4, step: 10 ms}\nduration: 0.5 s\nobservers: [power, momentum]\n");
  for (std::size_t i = 0; i < run["t"].size(); i += 10)
    EXPECT_NEAR(run["power.gravity"][i], -9.81 * run["P_z"][i], 1e-11);
  EXPECT_FALSE(has(run.names(), "work.gravity"));  // its potential is in the energy
}

struct Ledger {
  std::string name, text;
  double duration, scale;  ///< of the energies and works [J]
  long steps;              ///< of the coarser of the two runs that show the order
};
std::ostream& operator<<(std::ostream& out, const Ledger& l) {
  return out << l.name;
}

const std::string box =
    "robot: {body: box, mass: 2 kg, size: [0.3, 0.4, 0.6], centre: [0.1, -0.05, 0.02]}\n"
    "initial: {velocity: [0.5, 1, -1], angular_velocity: [1, 0.5, 2]}\n";
const std::string chain =
    "robot: {urdf: chain.urdf, root: spherical}\ninitial: {attitude: [90 deg, 0, 0], joint_velocities: "
    "{hinge1: 2}}\n";

const std::vector<Ledger>& ledgers() {
  static const std::vector<Ledger> all = {
      {"drag",
       box + "effects: [gravity, drag: {frame: body, linear: 0.3, quadratic: 0.2, angular_linear: 0.02, "
             "angular_quadratic: 0.01}]\n",
       1, 50, 40},
      {"damping_and_friction",
       chain + "effects: [gravity, joint_damping: {coefficient: 0.02}, "
               "joint_friction: {joints: [hinge1, hinge2], force: 0.05, slip: 0.5}]\n",
       0.5, 5, 100},
      {"pd",
       chain + "effects: [gravity]\nactuation: [pd: {joints: [hinge1, hinge2], stiffness: 2, damping: 0.05, "
               "target: [0.4, -0.2]}]\n",
       0.5, 5, 100},
      {"thruster",
       box + "effects: [thruster: {frame: body, thrust: 9, direction: [1, 2, 3], moment_ratio: 0.05, "
             "from: 0.205 s, until: 0.71 s}]\n",
       1, 50, 40},
      {"contact",
       box + "ground: {height: -0.31}\neffects: [gravity, contact: {frames: body, radius: 0.3, "
             "stiffness: 900, dissipation: 0.3, friction: 0.4, slip: 0.3, rolling: 0.01, torsion: 0.01, "
             "angular_slip: 0.5}]\n",
       0.5, 50, 200}};
  return all;
}

class EachLedger : public testing::TestWithParam<Ledger> {
 protected:
  static double gap(const std::string& method, double step) {
    const Ledger& l = GetParam();
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.12g", step);
    return Recorded(l.text + "integrator: {name: " + method + ", step: " + digits +
                    "}\nduration: " + std::to_string(l.duration) +
                    "\noutput: {every: " + std::to_string(l.duration / 10) + "}\nobservers: [power]\n")
        .figure("largest gap of the energy ledger");
  }
};

TEST_P(EachLedger, ClosesWithTheOrderOfTheMethod) {
  // Steps of h are shortened after events (phase_check.hpp), so that their gap may be smaller than that of h/4.
  const double h = GetParam().duration / double(GetParam().steps) / 4;
  for (const auto& [method, order] :
       {std::pair{"semi_implicit_euler", 1}, std::pair{"rk2", 2}, std::pair{"rkmk4", 4}}) {
    const double coarse = gap(method, h), fine = gap(method, h / 4);
    EXPECT_LE(fine, coarse / std::pow(4, order - 0.4)) << method << ": " << coarse << " to " << fine;
  }
}

TEST_P(EachLedger, ClosesToRounding) {
  // A step rounds E and the works by about eps of their size; errors of steps add up like a random walk.
  const double h = GetParam().duration / double(GetParam().steps);
  EXPECT_LE(gap("gauss12", h), 8 * eps<double>() * GetParam().scale * std::sqrt(double(GetParam().steps)));
}

INSTANTIATE_TEST_SUITE_P(Power, EachLedger, testing::ValuesIn(ledgers()),
                         [](const auto& l) { return l.param.name; });

TEST(Power, OfAdaptiveMethodsClosesToTheTolerance) {
  for (const char* method : {"dopri5", "radau5"}) {
    const Recorded run(ledgers()[4].text + "integrator: {name: " + method +
                       ", tolerance: 1e-10}\nduration: 0.5 s\noutput: {every: 0.1 s}\nobservers: [power]\n");
    // at most a few hundred steps, each with an error of 1e-10 (1 + |v|)
    EXPECT_LE(run.figure("largest gap of the energy ledger"), 1e-6) << method;
    EXPECT_LT(run.figure("work.contact"), -0.1) << method;
  }
}

TEST(Power, RefusesAMethodThatCannotIntegrateWorks) {
  EXPECT_THROW(
      Recorded(drop + "integrator: {name: variational, step: 10 ms}\nduration: 1 s\nobservers: [power]\n"),
      SceneError);
}

/// An effect with another statement about its energy than the true one.
class Lying final : public scene::Effect<double> {
 public:
  Lying(std::shared_ptr<const scene::Effect<double>> true_one, double share)
      : true_(std::move(true_one)), share_(share) {}
  scene::Acts acts() const override { return true_->acts(); }
  scene::Kinematics needs() const override { return true_->needs(); }
  void add(const scene::Now<double>& now, const scene::Load<double>& load) const override {
    true_->add(now, load);
  }
  bool conservative() const override { return true; }
  double potential(const scene::Now<double>& now) const override { return share_ * true_->potential(now); }

 private:
  std::shared_ptr<const scene::Effect<double>> true_;
  double share_;
};

/// The gap of the ledger at `t` if the only effect of a scene lies.
double gapOfLie(const std::string& text, double share, double t) {
  const scene::Scene s = loadSceneText(text + "integrator: {name: gauss12, step: 10 ms}\nduration: 1 s\n");
  const scene::Effects<double> lie{
      std::make_shared<Lying>(scene::makeEffect<double>(s.effects[0], s.model, s.around), share)};
  scene::Tree<double> tree(s.model, lie);
  scene::PowerObserver observer({}, {&tree.model(), &lie, 0.01, &s});
  std::vector<double> row(observer.columns().size());
  for (const double at : {0.0, t})
    observer.sample(tree.here(at, s.q, s.v, scene::Kinematics::Velocities), row);
  return row.back();
}

TEST(Power, ShowsDissipationThatIsNotStated) {
  const double v = 3 * std::exp(-1.5 / 2);
  EXPECT_NEAR(gapOfLie(drop, 1, 1), v * v - 9, 1e-12);
}

TEST(Power, ShowsAForceThatIsNotThatOfItsPotential) {
  const std::string spring =
      "robot: {body: ball, mass: 2, radius: 0.1, root: prismatic}\ninitial: {joints: {root_joint: 0.4}}\n"
      "effects: [joint_spring: {stiffness: 8}]\n";  // omega = 2/s
  EXPECT_NEAR(gapOfLie(spring, 1, 0.7), 0, 1e-14);
  const double x = 0.4 * std::cos(2 * 0.7);
  EXPECT_NEAR(gapOfLie(spring, 0.9, 0.7), 0.1 * 4 * (0.16 - x * x), 1e-13);
}

}  // namespace
