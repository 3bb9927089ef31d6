// scene/event_steps.hpp, scene/switches.hpp: forces that begin, end or bend where the state decides. Every method
// keeps its order across a located event.

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <numbers>

#include "bodies.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

const std::string folder = std::string(LIECHECK_FIXTURES) + "/scenes";
const std::string swing =
    "robot: {body: box, root: revolute, axis: [1, 0, 0], mass: 1 kg, size: [0.02, 0.02, 1], "
    "centre: [0, 0, -0.5]}\ninitial: {joints: {root_joint: 1}}\n";
const std::string chain = "robot: {urdf: chain.urdf, root: spherical}\ninitial: {attitude: [60 deg, 0, 0]}\n";
const std::string slide =
    "robot: {body: ball, root: prismatic, mass: 2 kg, radius: 0.1}\nground: {height: 0}\n"
    "initial: {joints: {root_joint: 0.3 m}}\n";
const std::string thrown =
    "robot: {body: box, mass: 2 kg, size: [0.3, 0.4, 0.6]}\nground: {height: 0}\n"
    "initial: {position: [0, 0, 0.3], angular_velocity: [1, 0.5, 2]}\n";

/// A motion with one event, at which `first` is replaced by `then`. The forces of both are smooth: their motion
/// needs no event. The event is where g changes its sign.
struct Located {
  std::string name, robot, switching, first, then;
  std::function<double(const Vec& q, const Vec& v)> g;
  double duration = 1;
  std::function<void(Model<double>&)> limit = [](Model<double>&) {};  ///< of the motion with the event
};

scene::Scene load(const std::string& text) {
  return loadSceneText(text + "integrator: {name: rkmk4, step: 1 s}\nduration: 1 s\n", "scene", folder);
}

/// The angle of the chain's last hinge after 0.4 s without a limit.
double hingeAngle() {
  const scene::Scene s = load(chain + "effects: [gravity]\n");
  auto system = scene::makeSystem<scene::Tree<double>>(s);
  const auto end = after(system, "gauss12", s.q, s.v, 0.4, 64);
  return end.q[end.q.size() - 1];
}

const std::vector<Located>& motions() {
  static const std::string gravity = "effects:\n  - gravity\n";
  static const double angle = hingeAngle();
  char rest[40];
  std::snprintf(rest, sizeof rest, "%.17g", angle);
  static const std::vector<Located> all = {
      {"a ball that falls on compliant ground", slide,
       gravity + "  - contact: {frames: [body], stiffness: 400 N/m}\n", gravity,
       gravity + "  - joint_spring: {stiffness: 400 N/m}\n", [](const Vec& q, const Vec&) { return q[0]; },
       0.35},
      {"a pendulum that meets its limit", swing,
       gravity + "  - joint_limits: {stiffness: 50, dissipation: 0}\n", gravity,
       gravity + "  - joint_spring: {stiffness: 50, rest: 0.4}\n",
       [](const Vec& q, const Vec&) { return q[0] - 0.4; }, 0.55,
       [](Model<double>& m) { m.lowerPositionLimit[0] = 0.4; }},
      {"a pendulum that leaves the limit of its torque", swing,
       gravity + "actuation:\n  - pd: {stiffness: 8, damping: 1, target: [2]}\n",
       gravity + "actuation:\n  - constant: {force: 5}\n",
       gravity + "actuation:\n  - pd: {stiffness: 8, damping: 1, target: [2]}\n",
       [](const Vec& q, const Vec& v) { return 8 * (2 - q[0]) - v[0] - 5; }, 1,
       [](Model<double>& m) { m.effortLimit[0] = 5; }},
      {"a chain whose last joint meets its limit", chain,
       gravity + "  - joint_limits: {joints: [hinge5], stiffness: 2}\n", gravity,
       gravity + "  - joint_spring: {joints: [hinge5], stiffness: 2, rest: " + rest + "}\n",
       [](const Vec& q, const Vec&) { return q[q.size() - 1] - angle; }, 0.46,
       [](Model<double>& m) {
         (angle > 0 ? m.upperPositionLimit : m.lowerPositionLimit)[m.nq - 1] = angle;
       }}};
  return all;
}

/// The end of the motion in two pieces by gauss12; their cut is found by bisection.
std::pair<Vec, Vec> computeExactEnd(const Located& m) {
  using Tree = scene::Tree<double>;
  const scene::Scene first = load(m.robot + m.first), then = load(m.robot + m.then);
  Tree before = scene::makeSystem<Tree>(first), after_it = scene::makeSystem<Tree>(then);
  const double sign = m.g(first.q, first.v);
  double low = 0, high = m.duration;
  for (int k = 0; k < 50; ++k) {
    const double middle = (low + high) / 2;
    const auto at = after(before, "gauss12", first.q, first.v, middle, 64);
    (m.g(at.q, at.v) * sign > 0 ? low : high) = middle;
  }
  EXPECT_LT(high, 0.9 * m.duration) << m.name << " has no event";
  const auto cut = after(before, "gauss12", first.q, first.v, low, 64);
  const auto end = after(after_it, "gauss12", cut.q, cut.v, m.duration - low, 64);
  EXPECT_LT(m.g(end.q, end.v) * sign, 0) << m.name << " has more than one event";
  return {end.q, end.v};
}

const std::pair<Vec, Vec>& exactEnd(const Located& m) {
  static std::map<std::string, std::pair<Vec, Vec>> known;
  const auto found = known.find(m.name);
  return found != known.end() ? found->second : known.emplace(m.name, computeExactEnd(m)).first->second;
}

/// The order between the two smallest errors above rounding.
template <class Sys, class Error>
void checkOrder(Sys& system, const scene::MethodInfo& info, const scene::Scene& s, double duration,
                const std::string& name, Error error_of) {
  // In double, the errors of gauss12 are rounding errors with few steps already, so that no order shows.
  const bool at_once = info.order == 12;
  const double least = 3e-13;
  double order = 0, before = std::numeric_limits<double>::infinity();
  for (long steps = at_once ? 1 : 32; steps <= 4096; steps *= 2) {
    scene::State<Sys> state(system, s.q, s.v);
    // Without a tolerance, an adaptive method takes one step for each step.
    const auto method = scene::makeMethod<Sys>(info.name, {std::numeric_limits<double>::infinity()});
    const auto outcome = scene::simulate(system, *method, state, {duration, steps, steps},
                                         [](const auto&, long) { return true; });
    ASSERT_FALSE(outcome.diverged) << name << ": " << outcome.why;
    ASSERT_EQ(outcome.events > 0, info.order > 1) << name << ", " << steps << " steps";
    ASSERT_FALSE(outcome.zeno) << name;
    const double error = error_of(state);
    if (at_once && steps == 16) {
      EXPECT_LT(error, 1e-11) << name;
    }
    if (error < least) break;
    order = std::log2(before / error), before = error;
  }
  if (!at_once) {
    EXPECT_NEAR(order, info.order, 0.1) << name;
  }
}

class EachMethodAcrossLocatedEvents : public testing::TestWithParam<scene::MethodInfo> {};

TEST_P(EachMethodAcrossLocatedEvents, KeepsItsOrder) {
  if (GetParam().lone_body_only) return;
  for (const Located& m : motions()) {
    scene::Scene s = load(m.robot + m.switching);
    m.limit(s.model);
    const auto& [q, v] = exactEnd(m);
    auto system = scene::makeSystem<scene::Tree<double>>(s);
    checkOrder(system, GetParam(), s, m.duration, m.name, [&, q = q, v = v](const auto& state) {
      const Moment end = momentOf(system, state);
      return difference(s.model, q, end.q).norm() + (end.v - v).norm();
    });
  }
}

/// Contact at the centre of mass: the height follows a closed form, and the attitude is that of a free body.
TEST_P(EachMethodAcrossLocatedEvents, KeepsItsOrderForABodyThatBounces) {
  const scene::Scene s = load(thrown + "effects: [gravity, contact: {frames: [body], stiffness: 400 N/m}]\n");
  const scene::Scene free = load(thrown);
  const double g = 9.81, m = 2, k = 400, duration = 0.35, w = std::sqrt(k / m);
  const double fall = std::sqrt(2 * 0.3 / g), t = duration - fall, A = g / (w * w), B = -g * fall / w;
  const double z = -A + A * std::cos(w * t) + B * std::sin(w * t);
  const double rate = w * (B * std::cos(w * t) - A * std::sin(w * t));
  ASSERT_LT(z, 0);
  Body alone = scene::makeSystem<Body>(free), system = scene::makeSystem<Body>(s);
  const auto turned = after(alone, "gauss12", free.q, free.v, duration, 64);
  checkOrder(system, GetParam(), s, duration, "a body that bounces", [&](const auto& state) {
    Vec q = turned.q;
    q[2] = z;
    const Moment end = momentOf(system, state);
    return difference(s.model, q, end.q).norm() + (V3(state.v.template head<3>()) - V3(0, 0, rate)).norm() +
           (end.v - turned.v).template tail<3>().norm();
  });
}

INSTANTIATE_TEST_SUITE_P(Scene, EachMethodAcrossLocatedEvents, testing::ValuesIn(scene::methodInfos()),
                         [](const auto& i) { return std::string(i.param.name); });

/// A ball that rests on the ground without touching it, so that its first step begins at an event.
TEST(EventSteps, ABodyMayStartAtAnEvent) {
  const scene::Scene s = loadSceneText(
      "robot: {body: ball, root: prismatic, mass: 2 kg, radius: 0.1}\nground: {height: 0}\n"
      "effects: [gravity, contact: {frames: [body], stiffness: 400 N/m}]\n"
      "integrator: {name: rkmk4, step: 1 ms}\nduration: 1 s\nobservers: [energy]\n");
  const scene::Run run = scene::run(s);
  ASSERT_FALSE(run.outcome.diverged);
  EXPECT_GE(run.outcome.events, 1);
  const double w = std::sqrt(400 / 2.);  // z = g/w^2 (cos w t - 1), which touches 0 once in each period
  auto system = scene::makeSystem<scene::Tree<double>>(s);
  const auto end = after(system, "rkmk4", s.q, s.v, 0.75 * 2 * std::numbers::pi / w, 100);
  EXPECT_NEAR(end.q[0], -9.81 / (w * w), 1e-6);
}

/// Without damping, a ball bounces for ever. A bounce takes 2 v/g of flight and about pi/w of contact, v = sqrt(2 g h).
scene::Run bounce(const std::string& height, const std::string& stiffness, const std::string& tolerance) {
  return scene::run(loadSceneText(
      "robot: {body: ball, root: prismatic, mass: 1 kg, radius: 0.1}\nground: {height: 0}\n"
      "initial: {joints: {root_joint: " +
      height + "}}\neffects: [gravity, contact: {frames: [body], stiffness: " + stiffness +
      "}]\nintegrator: {name: dopri5, tolerance: " + tolerance + "}\nduration: 1 s\noutput: {every: 1 s}\n"));
}
TEST(EventSteps, EveryBounceWithinAnOutputIntervalIsLocated) {
  const scene::Run run = bounce("0.1 mm", "1e6 N/m", "1e-9");
  ASSERT_FALSE(run.outcome.diverged) << run.outcome.why;
  EXPECT_FALSE(run.outcome.zeno);
  const double g = 9.81, v = std::sqrt(2 * g * 1e-4), w = 1e3;
  // The contact lasts from -v to v of z = -g/w^2 (1 - cos w t) - v/w sin w t.
  const double period = 2 * v / g + 2 * (std::numbers::pi - std::atan(v * w / g)) / w;
  EXPECT_NEAR(double(run.outcome.events), 2 / period, 2);
}
TEST(EventSteps, TenThousandEventsInOneStepAreNamedZeno) {
  const scene::Run run = bounce("1e-8 m", "1e12 N/m", "1e-12");
  ASSERT_FALSE(run.outcome.diverged) << run.outcome.why;
  ASSERT_TRUE(run.outcome.zeno);
  EXPECT_LT(*run.outcome.zeno, 1);
  EXPECT_GE(run.outcome.events, 10000);
}

}  // namespace
