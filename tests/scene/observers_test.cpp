// scene/observers: state, joint_forces, contact_forces, centre_of_mass. References are closed forms, and Newton's law
// for the whole robot by differences between samples.

#include <gtest/gtest.h>

#include "recorded.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

const std::string fixed_step =
    "integrator: {name: rkmk6, step: 2 ms}\nduration: 1 s\noutput: {every: 2 ms}\n";
/// A rod that hangs from its upper end and turns about x; c = (0, 0, -l).
const double m = 2, l = 0.5, g = 9.81, I_c = m / 12 * (0.02 * 0.02 + 1), I_O = I_c + m * l * l, d = 0.3;
const std::string rod =
    "robot: {body: box, root: revolute, axis: [1, 0, 0], mass: 2, size: [0.02, 0.02, 1], centre: [0, 0, "
    "-0.5]}\n"
    "initial: {joints: {root_joint: 1}, joint_velocities: {root_joint: 0.7}}\n"
    "effects: [gravity, joint_damping: {coefficient: 0.3}]\n";

TEST(StateObserver, RecordsPositionsVelocitiesAndTheAccelerationOfThePendulum) {
  const Recorded run(rod + fixed_step + "observers: [state]\n");
  EXPECT_EQ(run.unit("q.root_joint"), "rad");
  EXPECT_EQ(run.unit("a.root_joint"), "rad/s^2");
  const auto q = run["q.root_joint"], v = run["v.root_joint"], a = run["a.root_joint"];
  EXPECT_EQ(q[0], 1);
  EXPECT_EQ(v[0], 0.7);
  for (std::size_t i = 0; i < q.size(); ++i)
    EXPECT_NEAR(a[i], (-m * g * l * std::sin(q[i]) - d * v[i]) / I_O, 1e-12);
}

TEST(StateObserver, NamesTheNumbersOfEveryKindOfJoint) {
  const Recorded flyer("robot: {body: ball, radius: 1}\n" + fixed_step + "observers: [state]\n");
  EXPECT_EQ(flyer.names(),
            "t q.root_joint.x q.root_joint.y q.root_joint.z q.root_joint.qx q.root_joint.qy "
            "q.root_joint.qz q.root_joint.qw v.root_joint.x v.root_joint.y v.root_joint.z "
            "v.root_joint.wx v.root_joint.wy v.root_joint.wz a.root_joint.x a.root_joint.y "
            "a.root_joint.z a.root_joint.wx a.root_joint.wy a.root_joint.wz");
  EXPECT_EQ(flyer.unit("q.root_joint.z") + flyer.unit("q.root_joint.qw") + flyer.unit("v.root_joint.z") +
                flyer.unit("v.root_joint.wx") + flyer.unit("a.root_joint.x"),
            "m1m/srad/sm/s^2");
  const auto of = [](const std::string& root) {
    return Recorded("robot: {body: ball, radius: 1, root: " + root + "}\n" + fixed_step +
                    "observers: [state]\n");
  };
  EXPECT_EQ(of("planar").names(),
            "t q.root_joint.x q.root_joint.y q.root_joint.cos q.root_joint.sin v.root_joint.x v.root_joint.y "
            "v.root_joint.wz a.root_joint.x a.root_joint.y a.root_joint.wz");
  EXPECT_EQ(of("continuous").names(), "t q.root_joint.cos q.root_joint.sin v.root_joint a.root_joint");
  EXPECT_EQ(of("prismatic").unit("v.root_joint"), "m/s");
  EXPECT_EQ(of("spherical").unit("v.root_joint.wz"), "rad/s");
}

TEST(JointForces, AreThoseOfThePendulumInClosedForm) {
  const Recorded run(rod + fixed_step + "observers: [state, joint_forces]\n");
  const auto q = run["q.root_joint"], v = run["v.root_joint"], a = run["a.root_joint"];
  for (std::size_t i = 0; i < q.size(); i += 50) {
    const double s = std::sin(q[i]), c = std::cos(q[i]);
    EXPECT_NEAR(run["tau.gravity.root_joint"][i], -m * g * l * s, 1e-12);
    EXPECT_NEAR(run["tau.joint_damping.root_joint"][i], -d * v[i], 1e-12);
    // m (c_ddot - g) in the axes of the rod
    EXPECT_NEAR(run["reaction.root_joint.fx"][i], 0, 1e-12);
    EXPECT_NEAR(run["reaction.root_joint.fy"][i], m * (a[i] * l + g * s), 1e-12);
    EXPECT_NEAR(run["reaction.root_joint.fz"][i], m * (v[i] * v[i] * l + g * c), 1e-12);
    EXPECT_NEAR(run["reaction.root_joint.nx"][i], -d * v[i], 1e-12);  // the torque of the joint
  }
}

TEST(JointForces, OfTheRootCarryTheWholeRobotAndItsLoads) {
  const Recorded run(
      "robot: {urdf: chain.urdf, root: spherical}\ninitial: {attitude: [1, 0.3, 0], angular_velocity: [0, 1, "
      "2]}\n"
      "effects: [gravity, wrench: {frame: bar5, force: [1, 2, 3], axes: world}]\n" +
      fixed_step + "observers: [state, momentum, {joint_forces: {joints: root_joint}}]\n");
  double mass = 0;
  for (const auto& I : run.scene.model.inertias) mass += I.mass();
  const auto column = [&](const char* before, const char* parts, std::size_t i) {
    Vec x(3);
    for (int k = 0; k < 3; ++k) x[k] = run[std::string(before) + parts[k]][i];
    return V3(x);
  };
  const double h = run["t"][1];
  for (std::size_t i = 100; i < 400; i += 100) {
    const V3 rate = (column("P_", "xyz", i + 1) - column("P_", "xyz", i - 1)) / (2 * h);
    const V3 wanted = rate - mass * V3(0, 0, -9.81) - V3(1, 2, 3);
    const std::string Q = "q.root_joint.q";
    const Eigen::Quaterniond R(run[Q + "w"][i], run[Q + "x"][i], run[Q + "y"][i], run[Q + "z"][i]);
    EXPECT_LE((R * column("reaction.root_joint.f", "xyz", i) - wanted).norm(), 1e-3 * wanted.norm());
  }
}

const std::string skid =
    "robot: {body: box, mass: 2 kg, size: [0.4, 0.4, 0.2]}\nground: {height: 0.02, normal: [0.1, 0, 1]}\n"
    "frames:\n  - {name: a, on: body, position: [0.2, 0, -0.1]}\n  - {name: b, on: body, position: [-0.2, 0, "
    "-0.1]}\n"
    "initial: {position: [0.1, 0, 0.1], velocity: [1, 0.5, -0.2]}\n"
    "effects:\n  - gravity\n  - contact: {frames: [a, b], stiffness: 4000, dissipation: 0.3, friction: 0.4, "
    "slip: 0.1}\n"
    "integrator: {name: rkmk4, step: 0.1 ms}\nduration: 0.2 s\noutput: {every: 0.1 ms}\n";

TEST(ContactForces, AreThoseOfTheLawOfContactAtEachPoint) {
  const Recorded run(skid + "observers: [contact_forces]\n");
  const V3 n = V3(0.1, 0, 1).normalized(), v(1, 0.5, -0.2);
  V3 sum = V3::Zero();
  double normals = 0;
  for (const auto& [name, x] : {std::pair{"a", 0.3}, std::pair{"b", -0.1}}) {
    const double depth = n[2] * 0.02 - n.dot(V3(x, 0, 0)),
                 f_n = std::max(0.0, 4000 * depth * (1 - 0.3 * n.dot(v)));
    const V3 u = v - n.dot(v) * n, f_t = -0.4 * f_n / std::sqrt(u.squaredNorm() + 0.01) * u;
    const std::string at = std::string("contact.") + name;
    EXPECT_NEAR(run[at + ".normal"][0], f_n, 1e-12 * (1 + f_n)) << name;
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(run[at + ".t" + "xyz"[k]][0], f_t[k], 1e-12 * (1 + f_n)) << name << k;
    sum += f_t, normals += f_n;
  }
  EXPECT_GT(normals, 10);
  EXPECT_NEAR(run["contacts.normal"][0], normals, 1e-12 * normals);
  EXPECT_NEAR(run["contacts.tx"][0], sum[0], 1e-12 * normals);
}

TEST(ContactForces, NeedAContact) {
  EXPECT_THROW(Recorded("robot: {body: ball, radius: 1}\n" + fixed_step + "observers: [contact_forces]\n"),
               SceneError);
}

TEST(CentreOfMass, OfAThrownChainFallsAlongAParabola) {
  const Recorded run(
      "robot: {urdf: chain.urdf, root: free_flyer}\n"
      "initial: {velocity: [1, 2, 3], angular_velocity: [1, 2, 1], joint_velocities: {hinge1: 3}}\n"
      "effects: [gravity]\n" +
      fixed_step + "observers: [centre_of_mass]\n");
  const auto t = run["t"];
  for (const char* axis : {"x", "y", "z"}) {
    const auto c = run[std::string("com.") + axis], v = run[std::string("com.v") + axis];
    const double a = *axis == 'z' ? -9.81 : 0;
    for (std::size_t i = 0; i < t.size(); i += 100) {
      EXPECT_NEAR(c[i], c[0] + v[0] * t[i] + a * t[i] * t[i] / 2, 1e-9) << axis << t[i];
      EXPECT_NEAR(v[i], v[0] + a * t[i], 1e-9) << axis << t[i];
    }
  }
}

/// A ball that lies on the ground by its own shape.
TEST(ContactForces, NameBodiesThatTouchByTheirShapes) {
  for (const char* bodies : {"all", "[body]"}) {
    const Recorded run(
        "robot: {body: ball, mass: 2, radius: 0.1}\nground: {height: 0}\n"
        "initial: {position: [0, 0, 0.098038]}\neffects:\n  - gravity\n  - contact: {bodies: " +
        std::string(bodies) + ", stiffness: 1e4}\n" + fixed_step + "observers: [contact_forces]\n");
    EXPECT_NEAR(run["contact.body.normal"].back(), 2 * g, 1e-9);
    EXPECT_EQ(run["contacts.normal"].back(), run["contact.body.normal"].back());
  }
}

}  // namespace
