// scene/pieces.hpp, scene/simulate.hpp: forces that a scene file turns on and off. A step ends at each of these
// times, so that every method keeps its order across them.

#include <gtest/gtest.h>

#include "bodies.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

/// A scene with forces that change at `cuts`. The text of a piece has the forces of that piece alone, without
/// times: its motion needs no event.
struct Timed {
  std::string name, robot, effects, timed;
  std::vector<double> cuts;         ///< without the start and the end
  std::vector<std::string> pieces;  ///< the forces between the cuts
  double duration = 2;
};

const std::string box =
    "robot: {body: box, mass: 2 kg, size: [0.3, 0.4, 0.6], centre: [0.1, -0.05, 0.02]}\n"
    "initial: {velocity: [0.5, 1, -1], angular_velocity: [1, 0.5, 2]}\n";
const std::string chain = "robot: {urdf: chain.urdf, root: spherical}\ninitial: {attitude: [90 deg, 0, 0]}\n";
const std::string swing =
    "robot: {body: box, root: revolute, axis: [1, 0, 0], mass: 1 kg, size: [0.02, 0.02, 1], "
    "centre: [0, 0, -0.5]}\ninitial: {joints: {root_joint: 1}}\n";

const std::vector<Timed>& timedScenes() {
  static const std::string gravity = "  - gravity\n",
                           push = "frame: body, force: [3, -2, 1], moment: [1, 2, -1]",
                           fan = "frame: body, thrust: 4 N, direction: [1, 2, 3], moment_ratio: 0.2",
                           pull = "frame: bar5, force: [1 N, 0, 0.5 N], axes: world";
  static const auto wrench = [](const std::string& keys) { return "  - wrench: {" + keys + "}\n"; };
  static const std::vector<Timed> all = {
      {"a wrench on grid points",
       box,
       gravity,
       wrench(push + ", from: 1 s, until: 1.5 s"),
       {1, 1.5},
       {"", wrench(push), ""}},
      {"a wrench in the world's axes between grid points",
       box,
       gravity + "  - drag: {frame: body, linear: 0.3, angular_linear: 0.1}\n",
       wrench(push + ", axes: world, from: 0.37 s, until: 1.23 s"),
       {0.37, 1.23},
       {"", wrench(push + ", axes: world"), ""}},
      {"a thruster that starts and never ends",
       box,
       "",
       "  - thruster: {" + fan + ", from: 0.61 s}\n",
       {0.61},
       {"", "  - thruster: {" + fan + "}\n"}},
      {"a table of forces on a pendulum",
       swing,
       gravity + "  - joint_damping: {coefficient: 0.1}\n",
       "actuation:\n  - table: {times: [0.3, 0.9, 1], forces: [0, 3, -1]}\n",
       {0.3, 0.9, 1},
       {"", "actuation:\n  - table: {times: [0, 0.6], forces: [0, 3]}\n",
        "actuation:\n  - table: {times: [0, 0.1], forces: [3, -1]}\n",
        "actuation:\n  - constant: {force: -1}\n"}},
      {"a chain that is pulled",
       chain,
       gravity + "  - joint_spring: {stiffness: 2}\n",
       wrench(pull + ", from: 0.7 s, until: 1 s"),
       {0.7, 1},
       {"", wrench(pull), ""},
       1.2}};
  return all;
}

scene::Scene load(const Timed& s, const std::string& forces) {
  const std::string effects = s.effects.empty() && forces.empty() ? "" : "effects:\n" + s.effects;
  return loadSceneText(s.robot + effects + forces + "integrator: {name: rkmk4, step: 1 s}\nduration: 1 s\n",
                       s.name, std::string(LIECHECK_FIXTURES) + "/scenes");
}

/// The motion in pieces without events, by gauss12.
template <class Sys>
std::pair<Vec, Vec> exactEnd(const Timed& s) {
  Vec q, v;
  for (std::size_t i = 0; i <= s.cuts.size(); ++i) {
    const scene::Scene piece = load(s, s.pieces[i]);
    if (i == 0) q = piece.q, v = piece.v;
    const double from = i == 0 ? 0 : s.cuts[i - 1], to = i == s.cuts.size() ? s.duration : s.cuts[i];
    Sys system = scene::makeSystem<Sys>(piece);
    const auto end = after(system, "gauss12", q, v, to - from, 64);
    q = end.q, v = end.v;
  }
  return {q, v};
}

/// Compares the order between the two smallest errors above rounding with that of the method.
template <class Sys>
void check(const Timed& s, const scene::MethodInfo& info) {
  const scene::Scene whole = load(s, s.timed);
  const auto [q, v] = exactEnd<Sys>(s);
  Sys system = scene::makeSystem<Sys>(whole);
  // The rounding errors are about 1e-14. In double, the error of gauss12 exceeds them only for long steps.
  const double least = info.order == 12 ? 1e-12 : 2e-13;
  double order = 0, before = std::numeric_limits<double>::infinity(), first = 0;
  int halvings = 0;
  for (long steps = info.order == 12 ? 4 : 32; steps <= 4096; steps *= 2) {
    // Without a tolerance, an adaptive method takes one step for each step.
    const auto end = after(system, info.name, whole.q, whole.v, s.duration, steps,
                           std::numeric_limits<double>::infinity());
    const double error = difference(whole.model, Vec(q), Vec(end.q)).norm() + (Vec(end.v) - v).norm();
    if (error < least) break;
    order = std::log2(before / error), before = error;
    first == 0 ? first = error : ++halvings;
  }
  // The leading error of dopri5 on a lone body is so small beside the next ones that it hardly shows above rounding:
  // errors decrease faster at first. There the mean order over all halvings must reach that of the method, and a tree
  // of the same body, which moves on SE(3), shows the order of the last halving.
  if (info.name == std::string("dopri5") && std::is_same_v<Sys, Body>) {
    EXPECT_GT(std::log2(first / before) / halvings, info.order - 0.1) << s.name;
    check<scene::Tree<double>>(s, info);
  } else {
    EXPECT_NEAR(order, info.order, info.order == 12 ? 1.2 : 0.1) << s.name;
  }
}

class EachMethodAcrossEvents : public testing::TestWithParam<scene::MethodInfo> {};

TEST_P(EachMethodAcrossEvents, KeepsItsOrder) {
  for (const Timed& s : timedScenes()) {
    const bool lone = scene::isLoneBody(load(s, s.timed));
    if (lone)
      check<scene::LoneBody<double>>(s, GetParam());
    else if (!GetParam().lone_body_only)
      check<scene::Tree<double>>(s, GetParam());
  }
}

INSTANTIATE_TEST_SUITE_P(Scene, EachMethodAcrossEvents, testing::ValuesIn(scene::methodInfos()),
                         [](const auto& i) { return std::string(i.param.name); });

}  // namespace
