// Other simulators ("peers") get the same robot and the same forces as liecheck: their runs converge to
// liecheck's motion, in position, attitude and both velocities. A peer that this build lacks is skipped.

#include <gtest/gtest.h>

#include <liecheck/scene_file/scene_file.hpp>
#include <map>
#include <integrators/reference.hpp>
#include <integrators/sweep.hpp>

namespace {

using namespace liecheck;
using namespace liecheck::properties;

/// A crooked tree that moves for 0.1 s, with a root and lines of a scene file.
Benchmark tree(const std::string& root, const std::string& more) {
  const bool free = root == "free_flyer";
  Benchmark b = benchmark_of(loadSceneText(
      "robot: {urdf: crooked_tree.urdf, root: " + root + "}\ninitial:\n" +
          (free ? "  position: [0.1, 0.2, 0.3]\n  attitude: [0.4, -0.2, 0.3]\n  velocity: [0.3, -0.2, 0.1]\n"
                  "  angular_velocity: [1, 2, -1.5]\n"
                : "") +
          "  joints: {shoulder: 0.4, spin: 2.5, slide: 0.1}\n"
          "  joint_velocities: {shoulder: 1.5, spin: -3, slide: 0.5}\n"
          "integrator: {name: gauss6, step: 1 ms}\nduration: 0.1 s\n" +
          more,
      "crooked tree, " + root, LIECHECK_FIXTURES "/scenes"));
  b.what = more;
  return b;
}

MotionError error_of(Runner& runner, const Benchmark& b, const Reference& reference, const Effort& effort) {
  MotionError worst = MotionError::none();
  std::size_t k = 0;
  runner.run(effort, 4, [&](double, const Moment& m) {
    if (k > 0) worst.take_larger(motion_error(b.robot, m, reference.at[k]));
    ++k;
  });
  return worst;
}

/// The reference of a scene, which its name and effects tell from others.
const Reference& reference_for(const Benchmark& b) {
  const std::string key = b.name + b.what;
  static std::map<std::string, Reference> known;
  const auto found = known.find(key);
  if (found != known.end()) return found->second;
  return known.emplace(key, reference_of(b, 4, nullptr, [](const std::string&) {})).first->second;
}

/// A quarter of the step leaves about a quarter of the error of order 1, and less than half while terms of the
/// next order matter; an error of rounding stays. An error in the robot or its forces does not become smaller.
void expect_convergence(const Peer& peer, const Benchmark& b) {
  ASSERT_EQ(peer.why_not(b), "") << peer.name;
  const Reference& reference = reference_for(b);
  ASSERT_LT(reference.disagreement.leading(), 1e-12) << reference.name;
  for (const PeerMethod& m : peer.methods(b)) {
    const auto runner = peer.make(b, m.name);
    const bool adaptive = m.adaptive;
    const MotionError coarse = error_of(*runner, b, reference, adaptive ? Effort{4, 1e-5} : Effort{200, 0}),
                      fine = error_of(*runner, b, reference, adaptive ? Effort{4, 1e-10} : Effort{800, 0});
    for (const ErrorMeasure& e : error_measures) {
      if (std::isnan(reference.disagreement.*e.of)) continue;
      EXPECT_LT(fine.*e.of, std::max(coarse.*e.of / 2, 1e-9))
          << peer.name << " " << m.name << ", " << e.name << " on " << b.name << "\n"
          << b.what;
    }
  }
}

class EveryPeer : public testing::TestWithParam<const char*> {
 protected:
  const Peer& peer() const {
    for (const Peer& p : peers())
      if (p.name == GetParam()) return p;
    throw std::invalid_argument(GetParam());
  }
  void SetUp() override {
    for (const std::string& name : absent_peers())
      if (name == GetParam()) GTEST_SKIP() << "absent from this build";
  }
};
INSTANTIATE_TEST_SUITE_P(All, EveryPeer, testing::Values("Bullet", "DART", "MuJoCo", "ODE", "Simbody"),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(EveryPeer, FollowsATreeOnTheWorld) {
  expect_convergence(peer(), tree("fixed", "effects: [gravity]\n"));
}
TEST_P(EveryPeer, FollowsATreeOnAFreeRoot) {
  expect_convergence(peer(), tree("free_flyer", "effects: [gravity]\n"));
}
TEST_P(EveryPeer, FollowsForcesOnJointsAndBodies) {
  expect_convergence(
      peer(),
      tree("free_flyer",
           "effects:\n"
           "  - joint_damping: {coefficient: 0.3}\n"
           "  - joint_spring: {joints: [shoulder, slide], stiffness: 20, rest: 0.2}\n"
           "  - wrench: {frame: rotor, force: [1, 2, 3], moment: [0.1, -0.2, 0.3], axes: world}\n"
           "  - drag: {frame: arm, linear: 2, angular_linear: 0.1}\n"
           "actuation:\n"
           "  - constant: {joints: [spin], force: 0.4}\n"
           "  - pd: {joints: [shoulder, slide], stiffness: 30, damping: 0.5, target: [-0.1, 0.3]}\n"));
}
TEST_P(EveryPeer, FollowsATreeInContact) {
  expect_convergence(
      peer(),
      tree("free_flyer",
           "ground: {height: 0.1, normal: [0.1, 0, 1]}\n"
           "effects:\n"
           "  - gravity\n"
           "  - contact: {frames: [trunk, rotor, tail], radius: 0.3, stiffness: 1 kN/m, dissipation: 0.2,\n"
           "              friction: 0.5, slip: 0.1, rolling: 0.01, torsion: 0.01, angular_slip: 0.5}\n"));
}
TEST_P(EveryPeer, FollowsALoneBodyInContact) {
  expect_convergence(
      peer(), benchmark_of(loadSceneText(
                  "robot: {body: box, mass: 2, size: [0.1, 0.2, 0.3], centre: [0.01, 0.02, 0.03], turned: "
                  "[0.3, 0.2, 0.1]}\n"
                  "ground: {height: 0}\n"
                  "initial: {position: [0, 0, 0.1], velocity: [0.5, 0, 0], angular_velocity: [1, 2, 3]}\n"
                  "effects: [gravity, {contact: {frames: [body], radius: 0.15, stiffness: 1 kN/m, friction: "
                  "0.5, slip: 0.1}}]\n"
                  "integrator: {name: gauss6, step: 1 ms}\nduration: 0.1 s\n")));
}

TEST_P(EveryPeer, SaysWhatItCannotRun) {
  const Benchmark motors = tree("fixed", "effects: [{armature: {inertia: 0.01}}]\n");
  if (peer().name == std::string("MuJoCo"))
    expect_convergence(peer(), motors);
  else
    EXPECT_NE(peer().why_not(motors).find("armature"), std::string::npos);
  const Benchmark top =
      benchmark_of(loadSceneText("robot: {body: top, transverse: 1, axial: 2, root: spherical}\nintegrator: "
                                 "{name: gauss6, step: 1 ms}\nduration: 1 s\n"));
  EXPECT_NE(peer().why_not(top).find("'root_joint'"), std::string::npos);
}

TEST(Sweep, NamesThePeersThatCannotRunAScene) {
  SceneSweepOptions options;
  options.integrators = {"gauss6"}, options.steps = {16}, options.order_scenes = 0, options.seconds = 0;
  const auto all = sweep_scenes({tree("fixed", "effects: [{armature: {inertia: 0.01}}]\n")}, options);
  ASSERT_EQ(all.size(), 1U);
  std::size_t run = 0;
  for (const SweepSeries& s : all[0].series) run += s.subject == "MuJoCo" && s.integrator == "RK4";
  EXPECT_EQ(all[0].left_out.size() + run, peers().size());
  for (const LeftOut& l : all[0].left_out) EXPECT_NE(l.why, "") << l.peer;
}

}  // namespace
