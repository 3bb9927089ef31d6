#pragma once
// Robots and helpers for the tests of scenes.

#include <gtest/gtest.h>

#include <liecheck/multibody/configuration.hpp>
#include <liecheck/scene/integrators/registry.hpp>
#include <liecheck/scene/run.hpp>
#include <liecheck/scene_file/scene_file.hpp>

#include "../refusal.hpp"

namespace liecheck::test {

using Vec = VectorX<double>;
using V3 = Vector3<double>;
using Body = scene::LoneBody<double>;

/// One free body.
inline Model<double> freeBody(const Inertia<double>& inertia) {
  Model<double> m;
  m.addJointFrame(m.addJoint(0, FreeFlyer<double>(), SE3<double>::Identity(), "root_joint"));
  m.addBodyFrame("body", 1);
  m.appendBodyToJoint(1, inertia);
  return m;
}
inline Inertia<double> triaxial() {
  return {2, V3::Zero(), Matrix3<double>(V3(1, 2, 2.5).asDiagonal())};
}
inline Inertia<double> awkward() {
  const Matrix3<double> R = exp3<double>(V3(0.3, -0.7, 1.1)),
                        I = R * V3(1, 2, 2.5).asDiagonal() * R.transpose();
  return {1.5, V3(0.1, -0.2, 0.3), Matrix3<double>((I + I.transpose()) / 2)};
}

/// Gravity that is parallel to no axis. The acceleration in body axes then depends on q.
inline scene::Effects<double> gravity() {
  scene::Request request{"gravity", {}, 0};
  request.parameters.values["acceleration"] = {{1, -2, -9.81}, {}};
  return {scene::makeEffect<double>(request, Model<double>(), {})};
}

/// The frames c1 ... c4 of a body: corners of its lower side, at the height z.
inline std::string corners(double x, double y, double z) {
  std::string all = "frames:\n";
  for (int k = 0; k < 4; ++k)
    all += "  - {name: c" + std::to_string(k + 1) + ", on: body, position: [" +
           std::to_string(k % 3 ? -x : x) + ", " + std::to_string(k < 2 ? y : -y) + ", " + std::to_string(z) +
           "]}\n";
  return all;
}
/// The first lines of a scene: a box that slides on its four lower corners c1 ... c4. The list of effects is open.
inline const std::string sliding_box =
    "robot: {body: box, mass: 2 kg, size: [0.4, 0.4, 0.2]}\nground: {height: 0}\n" + corners(0.2, 0.2, -0.1) +
    "initial: {position: [0, 0, 0.1], velocity: [1, 0, 0]}\neffects:\n  - gravity\n";

/// The message with which a scene is refused.
inline std::string refusal(const std::string& text, const std::string& folder = testing::TempDir()) {
  const std::string said = refusal<SceneError>([&] { loadSceneText(text, "s.yaml", folder); });
  return said.empty() ? "accepted" : said;
}
/// The classical Runge-Kutta method of order 4 for x' = rate(x).
template <class X, class Rate>
void rungeKutta(X& x, double h, int steps, const Rate& rate) {
  for (int i = 0; i < steps; ++i) {
    const X a = rate(x), b = rate(X(x + h / 2 * a)), c = rate(X(x + h / 2 * b)), d = rate(X(x + h * c));
    x += h / 6 * (a + 2 * b + 2 * c + d);
  }
}

/// A state in the coordinates of the model, q [nq] and v [nv].
struct Moment {
  Vec q, v;
};
template <class Sys>
Moment momentOf(const Sys& system, const scene::State<Sys>& state) {
  const auto [q, v] = system.toModel(state);
  return {q, v};
}
/// v_dot [6] of the model of a lone body.
inline Vec accelerationOf(Body& body, const Vec& q, const Vec& v) {
  const scene::State<Body> state(body, q, v);
  Vector6<double> a;
  body.acceleration(0, state.q, state.v, a);
  return body.here(state, scene::Kinematics::Accelerations, &a).A[1].to_vector();
}
/// The end of a scene that is run as this system. It must reach its end.
template <class Sys>
Moment endOf(const scene::Scene& s) {
  Sys system = scene::makeSystem<Sys>(s);
  scene::State<Sys> state(system, s.q, s.v);
  const auto method = scene::makeMethod<Sys>(s.integrator, s.options);
  const auto outcome =
      scene::simulate(system, *method, state, s.span, [](const auto&, long) { return true; });
  EXPECT_FALSE(outcome.diverged) << s.integrator << ", " << outcome.t << " s: " << outcome.why;
  return momentOf(system, state);
}
template <class Sys>
Moment after(Sys& system, const std::string& method, const Vec& q, const Vec& v, double duration, long steps,
             double tolerance = 1e-9) {
  scene::State<Sys> state(system, q, v);
  const auto m = scene::makeMethod<Sys>(method, {tolerance});
  scene::simulate(system, *m, state, {duration, steps, steps}, [](const auto&, long) { return true; });
  return momentOf(system, state);
}

}  // namespace liecheck::test
