#include <integrators/show.hpp>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <liecheck/scene/run.hpp>
#include <liecheck/scene_file/scene_file.hpp>
#include <liecheck/urdf/urdf.hpp>
#include <support/embedded.hpp>

namespace liecheck::properties {
namespace {

constexpr const char* flyer_text = R"(
scene: a body with every effect that bodies have
robot: {body: box, mass: 2 kg, size: [0.1 m, 0.2 m, 0.4 m]}
ground: {height: 0 m}
initial: {position: [0, 0, 0.19 m], velocity: [0.5, 0, -0.2], angular_velocity: [1, 2, 0.5]}
frames:
  - {name: corner, on: body, position: [0.05, 0.1, -0.2]}
effects:
  - gravity
  - wrench: {frame: body, force: [0.1, 0, 0], axes: world}
  - drag: {frame: body, linear: 0.1, quadratic: 0.05, angular_linear: 0.01}
  - buoyancy: {frame: body, volume: 0.001, density: 1.2}
  - thruster: {frame: corner, thrust: 0.5 N, moment_ratio: 1 cm}
  - contact: {frames: [corner], stiffness: 1 kN/m, dissipation: 0.5, friction: 0.5}
integrator: {name: rkmk4, step: 1 ms}
duration: 1 s
)";
constexpr const char* hinge_text = R"(
scene: a hinge with every effect that joints have
robot: {body: box, mass: 2 kg, size: [0.1 m, 0.2 m, 0.4 m], centre: [0, 0, -0.2], root: revolute, axis: [0, 1, 0]}
initial: {joints: {root_joint: 0.5}, joint_velocities: {root_joint: 1}}
effects:
  - gravity
  - joint_damping: {coefficient: 0.1}
  - joint_friction: {force: 0.05}
  - joint_spring: {stiffness: 2}
  - joint_limits: {stiffness: 100}
  - armature: {inertia: 0.01}
actuation:
  - constant: {force: 0.1}
  - pd: {stiffness: 5, damping: 0.5}
  - table: {times: [0, 1], forces: [0, 0.1]}
integrator: {name: rkmk4, step: 1 ms}
duration: 1 s
)";
constexpr const char* dzhanibekov_text = R"(
scene: Dzhanibekov's body
reason: it spins about the axis of its middle moment, perturbed by 1e-3, and flips every few seconds
robot: {body: box, mass: 2 kg, size: [0.1 m, 0.2 m, 0.4 m]}
initial: {start: dzhanibekov, rate: 5 rad/s, perturbation: 1e-3}
integrator: {name: gauss6, step: 20 ms}
duration: 12 s
output: {every: 40 ms}
)";
constexpr const char* top_text = R"(
scene: a heavy top
reason: it nutates while it precesses
robot: {body: top, mass: 1 kg, transverse: 0.005, axial: 0.008, centre: [0, 0, 0.15], root: spherical}
initial: {attitude: [0.5, 0, 0], angular_velocity: [0, 0, 40]}
effects: [gravity]
integrator: {name: gauss6, step: 2 ms}
duration: 6 s
output: {every: 20 ms}
)";

/// The quadruped of fixtures/robots, dropped onto compliant ground with its base at 0.45 m.
scene::Scene quadruped() {
  scene::Scene s;
  s.name = "a quadruped dropped on compliant ground";
  s.reason = "stiff contacts that open and close, and legs held by a PD controller";
  s.source = "built-in quadruped";
  s.model = buildModelFromUrdfText(quadruped_urdf, RootJoint::FreeFlyer);
  s.q = neutral(s.model), s.v = VectorX<double>::Zero(s.model.nv);
  s.q[2] = 0.45;
  std::vector<std::string> feet, driven;
  std::vector<double> target;
  for (std::size_t i = 2; i < s.model.names.size(); ++i) {
    const std::string& name = s.model.names[i];
    const double angle = name.ends_with("thigh") ? 0.6 : name.ends_with("knee") ? -1.2 : 0;
    s.q[s.model.idx_qs[i]] = angle;
    driven.push_back(name), target.push_back(angle);
  }
  for (const Frame<double>& f : s.model.frames)
    if (f.type == FrameType::BODY && f.name.ends_with("foot")) feet.push_back(f.name);
  const auto number = [](double x) { return scene::Value{{x}, {}}; };
  s.around.ground = true;
  s.effects = {{"gravity", {{{"acceleration", {{0, 0, -9.81}, {}}}}}},
               {"contact",
                {{{"frames", {{}, feet}},
                  {"stiffness", number(20e3)},
                  {"dissipation", number(0.5)},
                  {"friction", number(0.8)},
                  {"slip", number(0.01)},
                  {"radius", number(0)},
                  {"rolling", number(0)},
                  {"torsion", number(0)},
                  {"angular_slip", number(0.01)}}}},
               {"armature", {{{"joints", {{}, driven}}, {"inertia", number(0.005)}}}},
               {"pd",
                {{{"joints", {{}, driven}},
                  {"stiffness", number(80)},
                  {"damping", number(3)},
                  {"target", {target, {}}}}}}};
  s.integrator = "semi_implicit_euler";
  s.span = {2, 10000, 100};
  return s;
}

Film::Link link_of(const Model<double>& model, std::size_t i) {
  const Inertia<double>& I = model.inertias[i];
  const Eigen::SelfAdjointEigenSolver<Matrix3<double>> solver(I.inertia());
  Matrix3<double> axes = solver.eigenvectors();
  Vector3<double> moments = solver.eigenvalues();
  if (I.inertia().isDiagonal(0)) axes.setIdentity(), moments = I.inertia().diagonal();
  Film::Link link{model.names[i], {}, {}, {}, {}};
  for (int a = 0; a < 3; ++a) {
    // A homogeneous box with edges s has I_b + I_c - I_a = m s_a^2 / 6.
    const double rest = moments.sum() - 2 * moments[a];
    link.half[std::size_t(a)] = I.mass() > 0 ? std::sqrt(std::max(0.0, 1.5 * rest / I.mass())) : 0;
    link.centre[std::size_t(a)] = I.lever()[a];
    for (int b = 0; b < 3; ++b) link.axes[std::size_t(3 * b + a)] = axes(b, a);
  }
  const auto add_joint = [&](const Vector3<double>& p) { link.joints.push_back({p[0], p[1], p[2]}); };
  for (std::size_t child = i + 1; child < model.parents.size(); ++child)
    if (model.parents[child] == int(i)) add_joint(model.jointPlacements[child].translation());
  for (const Frame<double>& f : model.frames)  // feet, which carry no joint
    if (f.type == FrameType::BODY && std::size_t(f.parentJoint) == i && f.name.ends_with("foot"))
      add_joint(f.placement.translation());
  return link;
}

template <class Sys>
Film film_of(const scene::Scene& s) {
  Film film{s.name, s.reason, s.integrator, s.span.duration * double(s.span.every) / double(s.span.steps), {},
            {},     {}};
  if (s.around.ground && s.around.normal[2] == 1 && !s.around.mesh)
    film.ground = s.around.height;  // no slope
  for (std::size_t i = 1; i < s.model.names.size(); ++i) film.links.push_back(link_of(s.model, i));
  Sys system = scene::makeSystem<Sys>(s);
  auto state = scene::startOf<Sys>(s, system);
  const auto method = scene::makeMethod<Sys>(s.integrator, s.options);
  scene::simulate(system, *method, state, s.span, [&](const auto& now, long) {
    const auto seen = system.here(now, scene::Kinematics::Poses);
    std::vector<std::array<double, 7>> poses;
    for (std::size_t i = 1; i < s.model.names.size(); ++i) {
      const Vector3<double> p = seen.X_WJ[i].translation();
      const Eigen::Quaterniond Q(seen.X_WJ[i].rotation());
      poses.push_back({p[0], p[1], p[2], Q.x(), Q.y(), Q.z(), Q.w()});
    }
    film.frames.push_back(std::move(poses));
    return true;
  });
  return film;
}

}  // namespace

std::vector<StageCost> stage_costs() {
  std::vector<StageCost> all;
  for (const scene::Scene& s : {loadSceneText(flyer_text), loadSceneText(hinge_text), quadruped()})
    for (const scene::Stage& stage : scene::plan(s, scene::Measuring()).stages) {
      StageCost c{s.name,     stage.name, stage.equation,    "",
                  stage.when, stage.why,  stage.nanoseconds, stage.instructions};
      for (const auto& e : scene::effectEntries<double>())
        if (stage.name == e.info->name) c.energy = e.info->energy;
      for (const auto& e : scene::actuationEntries<double>())
        if (stage.name == e.info->name) c.energy = e.info->energy;
      all.push_back(c);
    }
  return all;
}

std::vector<Film> films() {
  return {film_of<scene::LoneBody<double>>(loadSceneText(dzhanibekov_text)),
          film_of<scene::Tree<double>>(quadruped()), film_of<scene::Tree<double>>(loadSceneText(top_text))};
}

}  // namespace liecheck::properties
