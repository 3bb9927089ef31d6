// scene/effects/closed_loops.hpp: the forces of a four-bar linkage, and the decay of gaps.

#include <gtest/gtest.h>

#include <complex>
#include <iomanip>

#include "recorded.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

/// four_bar.urdf as a mechanism of one degree of freedom, the angle of the crank. Loop closure in the complex plane:
/// a e^(i crank) + b e^(i coupler) = d + c e^(i rocker).
struct FourBar {
  static constexpr double a = 0.25, b = 0.7, c = 0.5, d = 0.8;
  double crank, coupler, rocker, coupler_rate, rocker_rate;  ///< the rates for one of the crank

  explicit FourBar(double angle) : crank(angle) {
    const std::complex<double> P = std::polar(a, crank), PD = d - P;
    const double f = std::abs(PD);
    coupler = std::arg(PD) + std::acos((b * b + f * f - c * c) / (2 * b * f));
    rocker = std::arg(P + std::polar(b, coupler) - d);
    coupler_rate = -a * std::sin(crank - rocker) / (b * std::sin(coupler - rocker));
    rocker_rate = a * std::sin(crank - coupler) / (c * std::sin(rocker - coupler));
  }
};

const double start = 1, start_rate = 14;

std::string linkage(const std::string& integrator, const std::string& more = "") {
  const FourBar bar(start);
  std::ostringstream text;
  text << std::setprecision(17)
       << "robot: {urdf: four_bar.urdf, root: fixed}\ninitial:\n  joints: {crank_joint: " << start
       << ", coupler_joint: " << bar.coupler - start << ", rocker_joint: " << bar.rocker
       << "}\n  joint_velocities: {crank_joint: " << start_rate
       << ", coupler_joint: " << (bar.coupler_rate - 1) * start_rate
       << ", rocker_joint: " << bar.rocker_rate * start_rate
       << "}\neffects: [closed_loops: {frames: [coupler_end, rocker_end]}, gravity" << more
       << "]\nintegrator: {" << integrator << "}\nduration: 1 s\noutput: {every: 10 ms}\n"
       << "observers: [state, energy, loop_gaps, joint_forces, power]\n";
  return text.str();
}

TEST(ClosedLoops, LoseTheirGapWithTheOrderOfTheMethod) {
  for (const auto& [method, order] : {std::pair{"rk2", 2}, std::pair{"rkmk4", 4}}) {
    const auto gap = [&](const char* step) {
      return Recorded(linkage(std::string("name: ") + method + ", step: " + step))
          .figure("largest gap of a loop");
    };
    const double coarse = gap("2 ms"), fine = gap("0.5 ms");
    EXPECT_LE(fine, coarse / std::pow(4, order - 0.4)) << method << ": " << coarse << " to " << fine;
  }
}

TEST(ClosedLoops, FollowFromAllOtherForces) {
  // a static check of the forces: with a motor torque on the crank, its power is all that changes the energy
  const Recorded run(
      linkage("name: rkmk6, step: 1 ms", "]\nactuation: [constant: {joints: crank_joint, force: 2}"));
  const auto q = run["q.crank_joint"], E = run["energy"];
  for (std::size_t i = 0; i < q.size(); i += 20) EXPECT_NEAR(E[i] - E[0], 2 * (q[i] - q[0]), 1e-7);
  EXPECT_LE(run.figure("largest gap of the energy ledger"), 1e-7);
  // Each coordinate's generalised force of the loop is that of one force at the cut: the torques of the rocker and of the
  // two joints of the coupler's chain are its moments about three pivots.
  for (std::size_t i = 0; i < q.size(); i += 20) {
    const FourBar bar(q[i]);
    const std::complex<double> P = std::polar(bar.a, bar.crank), Q = P + std::polar(bar.b, bar.coupler);
    const double t1 = run["tau.closed_loops.crank_joint"][i], t2 = run["tau.closed_loops.coupler_joint"][i],
                 t3 = run["tau.closed_loops.rocker_joint"][i];
    // moments Q x f = t1 and (Q - P) x f = t2 give f; then -(Q - d) x f = t3
    const double det = Q.real() * -(Q - P).imag() + Q.imag() * (Q - P).real();
    const double fz = (-(Q - P).imag() * t1 + Q.imag() * t2) / det,
                 fy = (-(Q - P).real() * t1 + Q.real() * t2) / det;
    EXPECT_NEAR(-((Q - bar.d).real() * fz - (Q - bar.d).imag() * fy), t3, 1e-7 * (1 + std::abs(t3)));
  }
}

/// A body that is tied to the world with an initial gap.
std::string tied(const std::string& keys, const std::string& initial) {
  return "robot: {body: body, mass: 2, moments: [0.3, 0.5, 0.6]}\nframes: [{name: hook, on: universe, "
         "position: [1, 2, 3]}]\ninitial: {" +
         initial + "}\neffects: [gravity, closed_loops: {frames: [body, hook], rate: 8" + keys +
         "}]\nintegrator: {name: gauss12, step: 10 ms}\nduration: 1 s\noutput: {every: 0.1 s}\nobservers: "
         "[loop_gaps, state]\n";
}

TEST(ClosedLoops, CloseAGapAsACriticallyDampedSpringWithoutMass) {
  const Recorded run(tied("", "position: [1, 2.5, 3], angular_velocity: [0, 0, 3]"));
  for (std::size_t i = 0; i < run["t"].size(); ++i) {
    const double t = run["t"][i], decay = std::exp(-8 * t);
    EXPECT_NEAR(run["loop_gap"][i], 0.5 * (1 + 8 * t) * decay, 1e-11);
    EXPECT_NEAR(run["loop_gap_rate"][i], 0.5 * 64 * t * decay, 1e-10);
    EXPECT_NEAR(run["v.root_joint.wz"][i], 3, 1e-12) << "a point leaves the rotation free";
  }
}

TEST(ClosedLoops, WeldRotationsToo) {
  const Recorded run(tied(", type: weld", "position: [1, 2, 3], attitude: [0, 0.7, 0]"));
  for (std::size_t i = 0; i < run["t"].size(); ++i) {
    const double t = run["t"][i];
    EXPECT_NEAR(run["loop_angle"][i], 0.7 * (1 + 8 * t) * std::exp(-8 * t), 1e-11);
    EXPECT_NEAR(run["loop_gap"][i], 0, 1e-13);
  }
}

TEST(ClosedLoops, ThatAreOpenAtTheStartAreWarnedAbout) {
  const auto warnings = [](const std::string& initial, const std::string& keys = "") {
    std::vector<std::string> all;
    loadSceneText(tied(keys, initial), "s.yaml", ".", &all);
    return all;
  };
  EXPECT_TRUE(warnings("position: [1, 2.0009, 3]").empty());
  const auto open = warnings("position: [1, 2.2, 3]");
  ASSERT_EQ(open.size(), 1u);
  EXPECT_EQ(open[0],
            "s.yaml:4: the loop of 'body' and 'hook' is open by 0.200000 m at the start: give initial joints "
            "that close it");
  const std::string turned = "position: [1, 2, 3], attitude: [0, 0.7, 0]";
  EXPECT_TRUE(warnings(turned).empty());
  const auto weld = warnings(turned, ", type: weld");
  ASSERT_EQ(weld.size(), 1u);
  EXPECT_TRUE(has(weld[0], "is open by 0.700000 rad at the start"));
}

TEST(ClosedLoops, RefuseWhatIsNoLoop) {
  EXPECT_THROW(Recorded(tied(", frames: body", "")), SceneError);
  const std::string odd =
      "robot: {body: ball, radius: 1}\neffects: [closed_loops: {frames: [body]}]\nintegrator: {name: rkmk4, "
      "step: 1 ms}\nduration: 1 s\n";
  EXPECT_THROW(Recorded{odd}, SceneError);
}

}  // namespace
