#include <integrators/builtin.hpp>
#include <liecheck/scene/scene.hpp>

namespace liecheck::properties {
namespace {

using scene::Request;
using scene::Scene;
using V3 = Eigen::Vector3d;

Request gravity() {
  return {"gravity", {{{"acceleration", {{0, 0, -9.81}, {}}}}}};
}
Request joint_effect(const char* name, const char* key, double value) {
  scene::Parameters p{{{"joints", {{}, {"all"}}}, {key, {{value}, {}}}}};
  if (std::string(name) == "joint_spring") p.values["rest"] = {{0.0}, {}};
  return {name, p};
}

using Numbers = std::initializer_list<double>;

/// Adds a body after the last one, with its joint at `at` in the frame of that one.
void add(Scene& s, const Joint<double>& joint, const V3& at, double mass, const V3& centre,
         const V3& moments) {
  const int i = s.model.addJoint(s.model.njoints - 1, joint, SE3<double>(SO3<double>::Identity(), at),
                                 "joint" + std::to_string(s.model.njoints));
  s.model.appendBodyToJoint(i, Inertia<double>(mass, centre, Eigen::Matrix3d(moments.asDiagonal())));
}
Scene scene_of(const char* name, const char* reason, double duration, Numbers q, Numbers v,
               std::vector<Request> effects = {}) {
  Scene s;
  s.name = name, s.reason = reason, s.source = std::string("built-in ") + name;
  s.q = Eigen::Map<const Eigen::VectorXd>(q.begin(), Eigen::Index(q.size()));
  s.v = Eigen::Map<const Eigen::VectorXd>(v.begin(), Eigen::Index(v.size()));
  s.effects = std::move(effects);
  s.span.duration = duration;
  s.integrator = "gauss6";
  return s;
}
Scene with_body(Scene s, const Joint<double>& joint, double mass, const V3& centre, const V3& moments) {
  add(s, joint, V3::Zero(), mass, centre, moments);
  return s;
}
Scene free_body(const char* name, const char* reason, Numbers v, const V3& centre, const V3& moments,
                std::vector<Request> effects = {}) {
  return with_body(scene_of(name, reason, 4, {0, 0, 0, 0, 0, 0, 1}, v, std::move(effects)),
                   FreeFlyer<double>(), 2, centre, moments);
}

}  // namespace

std::vector<Benchmark> builtin_benchmarks() {
  Scene chain = scene_of("chain", "three links in zero gravity, the first attached to the world", 2,
                         {0.125, 1, -0.5}, {1, -2, 3});
  for (int i = 0; i < 3; ++i)
    add(chain, Revolute<double>(V3(0, 0, 1)), V3(i > 0 ? 0.5 : 0, 0, 0), 1, {0.25, 0, 0}, {0.01, 0.02, 0.02});
  const std::vector<Scene> all = {
      free_body("triaxial", "a torque-free body that tumbles", {0.5, 0.25, 1, 1, 2, -1}, V3::Zero(),
                {1, 2, 3}),
      free_body("axisymmetric", "a torque-free body that precesses", {0.5, 0.25, 1, 1, 0.5, 3}, V3::Zero(),
                {1, 1, 0.3}),
      free_body("thrown",
                "a body thrown up whose origin is not its centre of mass: the origin tumbles about it",
                {0.5, 0.25, 3, 1, 2, -1}, {0.1, -0.2, 0.3}, {1, 2, 2.5}, {gravity()}),
      with_body(scene_of("pendulum", "a swing of almost two radians", 4, {1.75}, {0.5}, {gravity()}),
                Revolute<double>(V3(0, 1, 0)), 1, {0, 0, -0.5}, V3::Constant(0.02)),
      with_body(scene_of("spring", "a damped spring", 4, {0.5}, {1},
                         {gravity(), joint_effect("joint_spring", "stiffness", 50),
                          joint_effect("joint_damping", "coefficient", 1.5)}),
                Prismatic<double>(V3(0, 0, 1)), 2, V3::Zero(), V3::Constant(0.1)),
      with_body(
          scene_of("top", "a heavy top with nutation", 2, {0.28, 0, 0, 0.96}, {0.1, 0, 12}, {gravity()}),
          Spherical<double>(), 1, {0, 0, 0.25}, {0.05, 0.05, 0.1}),
      chain};
  std::vector<Benchmark> benchmarks;
  for (const Scene& s : all) benchmarks.push_back(benchmark_of(s));
  return benchmarks;
}

}  // namespace liecheck::properties
