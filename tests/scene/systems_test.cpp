// scene/lone_body.hpp, scene/lone_joint.hpp, scene/count_instructions.hpp, scene/plan.cpp: each system has the equations
// of the tree, and a plan counts what it does.

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <liecheck/scene/count_instructions.hpp>

#include "../lib/random_tree.hpp"
#include "../sample.hpp"
#include "bodies.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;
namespace sc = liecheck::scene;

sc::Scene scene(const std::string& text) {
  return loadSceneText(text + "integrator: {name: rkmk4, step: 1 ms}\nduration: 1 s\n");
}

/// The acceleration of the scene's model as a system computes it, and that of the tree, at some states.
template <class Sys>
void expectTheTreesAcceleration(const sc::Scene& s) {
  Sys system = sc::makeSystem<Sys>(s);
  auto tree = sc::makeSystem<sc::Tree<double>>(s);
  for (int seed = 1; seed <= 5; ++seed) {
    Random random{unsigned(seed)};
    const Vec q = integrate(s.model, s.q, random.tangent(s.model.nv, 1.5)), v = random.tangent(s.model.nv, 2);
    Vec expected(s.model.nv);
    tree.acceleration(0, q, v, expected);
    const sc::State<Sys> state(system, q, v);
    auto a = state.v;
    system.acceleration(0, state.q, state.v, a);
    const Vec found = system.here(state, sc::Kinematics::Accelerations, &a).A[1].to_vector();
    auto at = tree.here(sc::State<sc::Tree<double>>(tree, q, v), sc::Kinematics::Accelerations, &expected);
    EXPECT_LE((found - at.A[1].to_vector()).norm(), 256 * eps<double>() * (1 + expected.norm())) << s.source;
  }
}

const std::string box =
    "robot: {body: box, mass: 2, size: [0.4, 0.6, 0.9], centre: [0.1, -0.2, 0.3], turned: [0.3, 0.2, 0.1]}\n"
    "frames:\n  - {name: centre, on: body, position: [0.1, -0.2, 0.3], attitude: [1, 2, 0]}\n"
    "  - {name: corner, on: body, position: [0.3, 0.1, 0.75], attitude: [0, 1, 1]}\n";

/// The forces that become constant coefficients of a lone body, each at its centre of mass and elsewhere.
TEST(LoneBody, HasTheForcesOfTheTree) {
  for (const std::string& effect :
       {std::string("gravity"),
        std::string("drag: {frame: FRAME, linear: 0.3, quadratic: 0.7, angular_linear: 0.2, "
                    "angular_quadratic: 0.5}"),
        std::string("buoyancy: {frame: FRAME, volume: 3 l}"),
        std::string("wrench: {frame: FRAME, force: [1, 2, 3], moment: [0.3, 0.2, 0.1]}"),
        std::string("wrench: {frame: FRAME, force: [1, 2, 3], axes: world}"),
        std::string("wrench: {frame: FRAME, moment: [1, 2, 3], axes: world}"),
        std::string("thruster: {frame: FRAME, thrust: 4, direction: [1, 1, 0], moment_ratio: 0.1}")})
    for (const std::string frame : {"centre", "corner"}) {
      std::string text = effect;
      if (const auto at = text.find("FRAME"); at != std::string::npos) text.replace(at, 5, frame);
      expectTheTreesAcceleration<Body>(
          scene(box + "effects:\n" + (text == "gravity" ? "" : "  - gravity\n") + "  - " + text + "\n"));
    }
}

TEST(LoneJoint, HasTheEquationOfTheTree) {
  const std::string needle =
      "robot: {body: needle, length: 1, radius: 0.1, centre: [0.1, 0.2, -0.5], turned: [0.3, 0.2, 0.1], "
      "root: ";
  const std::string forces =
      "effects:\n  - gravity: {acceleration: [1, 2, -9]}\n  - joint_damping: {coefficient: 0.3}\n"
      "  - joint_spring: {stiffness: 5, rest: 0.2}\n  - armature: {inertia: 0.2}\n";
  for (const char* root : {"revolute, axis: [1, 2, 3]}\n", "prismatic, axis: [1, 2, 3]}\n"}) {
    const sc::Scene s = scene(needle + root + forces);
    EXPECT_EQ(sc::kindOf(s), sc::SystemKind::LoneJoint);
    expectTheTreesAcceleration<sc::LoneJoint<double>>(s);
  }
}

TEST(Systems, AreTheSimplestThatHaveTheForces) {
  const auto kind = [](const std::string& effects) {
    return sc::kindOf(scene(box + "effects: [" + effects + "]\n"));
  };
  EXPECT_EQ(kind(""), sc::SystemKind::ThrownBody);
  EXPECT_EQ(kind("gravity, wrench: {frame: centre, force: [1, 0, 0], axes: world}"),
            sc::SystemKind::ThrownBody);
  EXPECT_EQ(kind("wrench: {frame: corner, moment: [1, 0, 0]}"), sc::SystemKind::ThrownBody);
  EXPECT_EQ(kind("wrench: {frame: corner, force: [1, 0, 0]}"), sc::SystemKind::LoneBody);
  EXPECT_EQ(kind("drag: {frame: centre, linear: 1}"), sc::SystemKind::LoneBody);
  EXPECT_EQ(kind("armature: {joints: root_joint, inertia: 1}"), sc::SystemKind::Tree);
  EXPECT_EQ(sc::kindOf(scene("robot: {body: ball, radius: 1, root: prismatic}\nground: {height: 0}\n"
                             "effects: [contact: {frames: [body], stiffness: 1}]\n")),
            sc::SystemKind::Tree);
}

/// The rotation of a thrown body has the bits of that of a lone body, and its origin is where a parabola is.
TEST(ThrownBody, TurnsAsALoneBodyAndFlowsAlongAParabola) {
  sc::Scene s = scene(box +
                      "initial: {position: [1, 2, 3], velocity: [3, -1, 5], angular_velocity: [1, 2, 3]}\n"
                      "effects: [gravity]\n");
  auto thrown = sc::makeSystem<sc::ThrownBody<double>>(s);
  auto lone = sc::makeSystem<Body>(s);
  const Moment a = after(thrown, "rkmk4", s.q, s.v, 2, 400), b = after(lone, "rkmk4", s.q, s.v, 2, 400);
  EXPECT_EQ(Vec(a.q.tail<4>()), Vec(b.q.tail<4>()));
  EXPECT_EQ(Vec(a.v.tail<3>()), Vec(b.v.tail<3>()));
  const V3 c(0.1, -0.2, 0.3), w(1, 2, 3), p(1, 2, 3), u(3, -1, 5);
  const V3 centre = p + c + 2 * (u + cross<double>(w, c)) + V3(0, 0, -9.81) * 2;
  const SO3<double> Q(Vector4<double>(a.q.tail<4>()));
  EXPECT_LE((V3(a.q.head<3>()) + Q.act(c) - centre).norm(), 16 * eps<double>() * centre.norm());
  EXPECT_LE((V3(b.q.head<3>()) + Q.act(c) - centre).norm(), 64 * eps<double>() * centre.norm());
}

/// 0.1 m/s for 1e5 steps of 1 ms: a plain sum rounds 1e5 times.
TEST(Sums, AreCompensatedWhereTheSceneAsksForIt) {
  const auto error = [](const std::string& key) {
    const sc::Run run = sc::run(loadSceneText(
        "robot: {body: ball, radius: 1, root: prismatic}\ninitial: {joint_velocities: {root_joint: 0.1}}\n"
        "integrator: {name: rkmk4, step: 1 ms" +
        key + "}\nduration: 100 s\noutput: {every: 100 s}\n"));
    return std::abs(run.q[0] - 10);
  };
  EXPECT_LE(error(", compensated: true"), 4e-15);
  EXPECT_GT(error(", compensated: false"), 1e-13);
  EXPECT_EQ(error(""), error(", compensated: false"));
}

/// Angles from 2^-24 to 2 on both sides of where the short series end, against long double.
TEST(RotationStep, StaysWithinItsErrors) {
  using Long = long double;
  Random random{1};
  double worst_turn = 0, worst_rate = 0, worst_matrix = 0;
  for (int n = 0; n < 100000; ++n) {
    const Vec x = random.tangent(10, 1);
    const V3 phi = std::exp2(1 - 25 * (n % 1000) / 1000.) / x.head<3>().norm() * x.head<3>(),
             w = x.segment<3>(3);
    const Vector4<double> Q = x.tail<4>() / x.tail<4>().norm();
    using L3 = Vector3<Long>;
    using L4 = Vector4<Long>;
    const L3 p = phi.cast<Long>(), v = w.cast<Long>();
    const L4 q = Q.cast<Long>().normalized();
    const Long t = p.norm(), half = t / 2, s = std::sin(half) / t;
    L4 turned;
    turned << q[3] * s * p + std::cos(half) * q.head<3>() + s * L3(q.head<3>()).cross(p),
        q[3] * std::cos(half) - s * q.head<3>().dot(p);
    worst_turn = std::max(worst_turn, double((sc::rotated<double>(Q, phi).cast<Long>() - turned).norm()));
    // d = (1 - (t/2) cot(t/2))/t^2 cancels for small t, where d = 1/12 + t^2/720 + O(t^4)
    const Long d =
        t < 1e-3L ? 1 / 12.L + t * t / 720 : (1 - half * std::cos(half) / std::sin(half)) / (t * t);
    const L3 rate = v + p.cross(v) / 2 + d * p.cross(p.cross(v));
    worst_rate = std::max(worst_rate,
                          double((sc::rotationRate<double>(phi, w).cast<Long>() - rate).norm() / v.norm()));
    Matrix3<Long> K;
    K << 0, -q[2], q[1], q[2], 0, -q[0], -q[1], q[0], 0;
    const Matrix3<Long> R = Matrix3<Long>::Identity() + 2 * q[3] * K + 2 * K * K;
    worst_matrix =
        std::max(worst_matrix, double((sc::matrixOf<double>(Q).cast<Long>() - R).cwiseAbs().maxCoeff()));
  }
  EXPECT_LE(worst_turn, 3 * eps<double>());
  EXPECT_LE(worst_rate, 8 * eps<double>());
  EXPECT_LE(worst_matrix, 8 * eps<double>());
  std::printf("%.2f, %.2f and %.2f eps\n", worst_turn / eps<double>(), worst_rate / eps<double>(),
              worst_matrix / eps<double>());
}

TEST(Kept, ServesOneEvaluationOfTheSameState) {
  sc::Kept<double, Vec, Vec> kept;
  const Vec q = Vec::Constant(2, 1.0), v = Vec::Constant(2, 3.0), other = Vec::Constant(2, 2.0);
  EXPECT_FALSE(kept.take(0, q, v));
  for (int k = 0; k < 4; ++k) {
    kept.keep(0, q, v);
    EXPECT_EQ(kept.take(k == 1 ? 1 : 0, k == 2 ? other : q, k == 3 ? other : v), k == 0);
    EXPECT_FALSE(kept.take(0, q, v)) << "twice";
  }
}

TEST(CountInstructions, CountsEveryTurnOfALoop) {
  volatile int sum = 0;
  const auto counted = [&](int n) {
    return sc::InstructionCounter().count([&] {
      for (int i = 0; i < n; ++i) sum = sum + i;
    });
  };
  const auto few = counted(100), many = counted(300), most = counted(500);
  if (!few) GTEST_SKIP() << "this machine does not count";
  EXPECT_GT(*many, *few + 200);
  EXPECT_EQ(*most - *many, *many - *few);
}

/// A sample of the calls of a robot on its feet, and one in a hurry, against each instruction.
TEST(CountInstructions, CountsASampleToFivePercent) {
  const std::string quadruped = std::string(LIECHECK_FIXTURES) + "/scenes/quadruped_drop.yaml";
  std::vector<std::string> files{quadruped};
  if (sample(0, 1))
    for (const auto& f : std::filesystem::directory_iterator(std::filesystem::path(quadruped).parent_path()))
      if (f.path().extension() == ".yaml") files.push_back(f.path());
  for (const std::string& file : files) {
    const sc::Scene s = loadScene(file);
    const auto counted = [&](bool every, bool hurried) {
      const auto method = sc::makeMethod<sc::Tree<double>>(s.integrator, s.options);
      auto tree = sc::makeSystem<sc::Tree<double>>(s);
      const auto start = sc::startOf(s, tree);
      auto state = start;
      const auto steps = [&] {  // from the beginning each time, since an implicit method remembers its last step
        state = start, method->begin(tree, start);
        for (int n = 0; n < 3; ++n) method->step(tree, state, s.span.duration / double(s.span.steps));
      };
      steps();
      return sc::InstructionCounter(every, 1e9, hurried ? 1e15 : 0).count(steps);
    };
    if (sc::methodInfo(s.integrator).lone_body_only) continue;
    const auto all = counted(true, false);
    if (!all) GTEST_SKIP() << "this machine does not count";
    for (const bool hurried : {false, true})
      EXPECT_NEAR(double(*counted(false, hurried)), double(*all), 0.05 * double(*all)) << file << hurried;
  }
}

/// The budget is for all stages, and it ends a count.
TEST(Plan, EndsCountingInTime) {
  const sc::Scene s = loadScene(std::string(LIECHECK_FIXTURES) + "/scenes/quadruped_drop.yaml");
  double at = 0;
  const auto now = [] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  };
  const sc::Plan plan =
      sc::plan(s, sc::Measuring{.seconds = 0.01, .timed = [&](const sc::Plan&) { at = now(); }});
  EXPECT_LT(now() - at, 0.5);
  EXPECT_FALSE(plan.stages.back().nanoseconds == std::nullopt);
}

TEST(Plan, CountsNoStepOfARunThatDivergesBefore) {
  const sc::Scene s = loadSceneText(
      "robot: {body: ball, root: prismatic, mass: 1 kg, radius: 0.1}\ninitial: {joints: {root_joint: 1}}\n"
      "effects: [joint_spring: {stiffness: 1e34}]\nduration: 1 s\nintegrator: {name: euler, step: 10 ms}\n");
  for (const sc::Stage& stage : sc::plan(s, sc::Measuring{}).stages)
    EXPECT_FALSE(stage.when == "step" && stage.instructions) << stage.name;
}

TEST(Plan, CountsTheEvaluationsOfAStep) {
  const std::pair<const char*, double> expected[] = {
      {"euler", 1}, {"rk2", 2}, {"rkmk4", 4}, {"cf4", 4}, {"rkmk6", 7}};
  for (const auto& [method, evaluations] : expected)
    for (const char* effects : {"[]", "[gravity, drag: {frame: corner, linear: 1}]"}) {
      const sc::Scene s =
          loadSceneText(box + "effects: " + effects +
                        "\ninitial: {angular_velocity: [1, 0, 0]}\nintegrator: {name: " + method +
                        ", step: 1 ms}\nduration: 1 s\n");
      EXPECT_EQ(sc::plan(s, sc::Measuring{.seconds = 0}).evaluations, evaluations) << method;
    }
}

}  // namespace
