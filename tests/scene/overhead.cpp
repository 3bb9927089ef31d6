// overhead hand|scene|tree|estimated|counted NAME STEPS URDF FOOT,... runs a scene, or a loop written by hand for it
// (minimal.hpp), and prints the last state in hexadecimal; overhead.sh counts the instructions. The arm is the robot of
// the URDF with a fixed root, under PD control, damping and gravity; standing is the robot on the feet that are named.
// `tree` runs the equations of articulated bodies, also for a lone body. `estimated` adds the estimate of the error.
// `counted` prints the instructions of a step that `liecheck scene explain` counts, also for scenes without a loop.

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <liecheck/scene/run.hpp>
#include <liecheck/scene/setup.hpp>
#include <liecheck/scene_file/scene_file.hpp>
#include <liecheck/urdf/urdf.hpp>

#include "minimal.hpp"

namespace {

using namespace liecheck;

void show(const VectorX<double>& q, const VectorX<double>& v) {
  for (const auto* x : {&q, &v})
    for (int i = 0; i < x->size(); ++i) std::printf("%a ", (*x)[i]);
  std::printf("\n");
}

struct Case {
  const char *name, *text;
};
constexpr Case cases[] = {
    {"free",
     "robot: {body: body, mass: 2, moments: [0.5, 0.75, 1]}\n"
     "initial: {velocity: [-0.5, -0.25, 0], angular_velocity: [0.25, 0.5, -0.5]}\n"},
    {"dragged",
     "robot: {body: body, mass: 2, moments: [0.5, 0.75, 1]}\n"
     "initial: {velocity: [-0.5, -0.25, 0], angular_velocity: [0.25, 0.5, -0.5]}\n"
     "effects: [gravity, {drag: {frame: body, linear: 0.1, quadratic: 0.2}}]\n"},
    {"floating",
     "robot: {urdf: URDF, root: free_flyer}\ninitial: {velocity: [1, 2, 3], angular_velocity: [3, 1, 2]}\n"},
    {"arm",
     "robot: {urdf: URDF, root: fixed}\n"
     "effects: [gravity, {joint_damping: {coefficient: 0.05}}]\n"
     "actuation: [{pd: {stiffness: 8, damping: 0.3, target: [0.3]}}]\n"},  // so slow that no first step is shortened
    {"standing",
     "robot: {urdf: URDF, root: free_flyer}\nground: {height: 0}\ninitial: {position: [0, 0, HEIGHT]}\n"
     "effects:\n  - gravity\n  - joint_damping: {coefficient: 0.01}\n"
     "  - contact: {frames: [FEET], stiffness: 5e3, dissipation: 0.5, friction: 0.8, slip: 0.1}\n"
     "actuation: [{pd: {stiffness: 80, damping: 3, target: [0]}}]\n"},
    {"pushed",
     "robot: {body: box, mass: 2, size: [1, 2, 3]}\ninitial: {angular_velocity: [1, 0.1, 0]}\n"
     "effects: [gravity, {thruster: {frame: body, thrust: 3}}]\n"},
    {"offset",
     "robot: {body: box, mass: 2, size: [1, 2, 3], centre: [0.1, 0, 0]}\n"
     "initial: {angular_velocity: [1, 0.1, 0]}\neffects: [gravity, {drag: {frame: body, linear: 0.3}}]\n"},
    {"bouncing",
     "robot: {body: ball, radius: 0.1}\nground: {height: 0}\ninitial: {position: [0, 0, 1]}\n"
     "effects: [gravity, {contact: {frames: [body], radius: 0.1, stiffness: 1e4}}]\n"},
    {"pendulum",
     "robot: {body: needle, length: 1, radius: 0.01, centre: [0, 0, -0.5], root: revolute, axis: [0, 1, 0]}\n"
     "initial: {joints: {root_joint: 1}}\neffects: [gravity, {joint_damping: {coefficient: 0.1}}]\n"},
    {"spring",
     "robot: {body: ball, radius: 0.1, root: prismatic}\ninitial: {joints: {root_joint: 1}}\n"
     "effects: [{joint_spring: {stiffness: 30}}, {joint_damping: {coefficient: 0.1}}]\n"},
    {"top",
     "robot: {body: top, transverse: 0.1, axial: 0.02, centre: [0, 0, 0.3], root: spherical}\n"
     "initial: {start: sleeping_top, rate: 50, tilt: 0.1}\neffects: [gravity]\n"}};

void replace(std::string& text, const std::string& name, const std::string& by) {
  for (std::size_t at; (at = text.find(name)) != std::string::npos;) text.replace(at, name.size(), by);
}

/// The height of the root above the lowest foot, less 1 mm.
std::string heightOf(const char* urdf, const std::string& feet) {
  const Model<double> model = buildModelFromUrdf(urdf, RootJoint::FreeFlyer);
  Data<double> data(model);
  forwardKinematics(model, data, neutral(model));
  double lowest = 0;
  for (std::size_t at = 0, end; at < feet.size(); at = end + 1) {
    end = std::min(feet.find(',', at), feet.size());
    const auto& frame = model.frames[std::size_t(model.requireFrameId(feet.substr(at, end - at)))];
    lowest =
        std::min(lowest, (data.oMi()[std::size_t(frame.parentJoint)] * frame.placement).translation()[2]);
  }
  return std::to_string(-lowest - 1e-3);
}

template <class Robot>
void loop(Robot& robot, long steps, double h) {
  for (long n = 0; n < steps; ++n) robot.step(h);
}
void byHand(const scene::Scene& s, const std::string& name, long steps, double h) {
  if (name == "free" || name == "dragged") {
    const Vector3<double> v0 = s.v.head<3>(), w0 = s.v.tail<3>();
    const test::Double3 I{0.5, 0.75, 1}, u{v0[0], v0[1], v0[2]}, w{w0[0], w0[1], w0[2]};
    const auto print = [](const test::Double3& c, const auto& Q, const test::Double3& omega) {
      VectorX<double> q(7), v(3);
      q << c[0], c[1], c[2], Q[0], Q[1], Q[2], Q[3];
      v << omega[0], omega[1], omega[2];
      show(q, v);
    };
    if (name == "free") {
      test::FreeBodyByHand body(I);
      body.omega = w;
      loop(body, steps, h);
      const double t = h * double(steps);
      print({t * u[0], t * u[1], t * u[2]}, body.Q, body.omega);
    } else {
      test::DraggedBodyByHand body(I, 2, 0.1, 0.2, {0, 0, -9.81});
      body.omega = w, body.u = u;
      loop(body, steps, h);
      print(body.c, body.Q, body.omega);
    }
    return;
  }
  test::TreeByHand::Contact contact;
  if (name == "standing") {
    contact = {{}, 5e3, 0.5, 0.8, 0.1 * 0.1};
    for (const scene::Request& r : s.effects)
      if (r.name == "contact")
        for (const std::string& foot : r.parameters.names("frames")) {
          const auto& frame = s.model.frames[std::size_t(s.model.requireFrameId(foot))];
          contact.feet.emplace_back(std::size_t(frame.parentJoint), frame.placement.translation());
        }
  }
  Model<double> model = s.model;
  model.gravity = Vector3<double>(0, 0, -9.81), model.armature.setZero();
  if (name == "floating") model.gravity.setZero();
  const bool stands = name == "standing";
  test::TreeByHand robot(model, VectorX<double>::Constant(model.nv, stands ? 0 : 0.3),
                         name == "floating" ? 0 : stands ? 80 : 8, stands ? 3 : 0.3, stands ? 0.01 : 0.05, contact);
  robot.q = s.q, robot.v = s.v;
  loop(robot, steps, h);
  show(robot.q, robot.v);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) return 2;
  const std::string way = argv[1], name = argv[2];
  const long steps = std::atol(argv[3]);
  const double h = 0x1p-10;
  std::string text;
  for (const Case& c : cases)
    if (name == c.name) text = c.text;
  replace(text, "URDF", argv[4]), replace(text, "FEET", argv[5]);
  if (name == "standing") replace(text, "HEIGHT", heightOf(argv[4], argv[5]));
  scene::Scene s = loadSceneText(text + "integrator: {name: rkmk4, step: 1 s}\nduration: 1 s\n", argv[2], ".",
                                 nullptr, {"/"});
  s.span = {h * double(steps), steps, steps};
  if (way == "counted") {
    for (const scene::Stage& stage : scene::plan(s, scene::Measuring{.every = true, .seconds = 1e9}).stages)
      if (stage.when == "step") std::printf("%ld\n", stage.instructions.value_or(0));
    return 0;
  }
  if (way == "hand") return byHand(s, name, steps, h), 0;
  if (way == "tree") {
    auto system = scene::makeSystem<scene::Tree<double>>(s);
    auto state = scene::startOf(s, system);
    const auto method = scene::makeMethod<scene::Tree<double>>(s.integrator);
    scene::simulate(system, *method, state, s.span, [](const auto&, long) { return true; });
    return show(state.q, state.v), 0;
  }
  const scene::Run run = scene::run(s, {}, way == "estimated");
  const bool lone = name == "free" || name == "dragged";
  show(run.q, lone ? VectorX<double>(run.v.tail<3>()) : run.v);
}
