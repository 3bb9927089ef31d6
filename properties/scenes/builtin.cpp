#include <liecheck/scene/scene.hpp>
#include <scenes/benchmark.hpp>

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

Scene scene_of(const char* name, const char* reason, double duration) {
  Scene s;
  s.name = name, s.reason = reason, s.source = std::string("built-in ") + name;
  s.span.duration = duration;
  s.integrator = "gauss6";
  return s;
}
void add(Scene& s, const Joint<double>& joint, const V3& at, double mass, const V3& centre,
         const V3& moments) {
  const int i = s.model.addJoint(s.model.njoints - 1, joint, SE3<double>(SO3<double>::Identity(), at),
                                 "joint" + std::to_string(s.model.njoints));
  s.model.appendBodyToJoint(i, Inertia<double>(mass, centre, Eigen::Matrix3d(moments.asDiagonal())));
}
Scene started(Scene s, std::initializer_list<double> v) {
  s.q = neutral(s.model);
  s.v = Eigen::Map<const Eigen::VectorXd>(v.begin(), Eigen::Index(v.size()));
  return s;
}
Scene body(const char* name, const char* reason, const V3& centre, const V3& moments,
           std::initializer_list<double> v, double duration = 4) {
  Scene s = scene_of(name, reason, duration);
  add(s, FreeFlyer<double>(), V3::Zero(), 2, centre, moments);
  return started(s, v);
}

}  // namespace

std::vector<Benchmark> builtin_benchmarks() {
  std::vector<Scene> all;
  all.push_back(
      body("triaxial", "a torque-free body that tumbles", V3::Zero(), {1, 2, 3}, {0.5, 0.25, 1, 1, 2, -1}));
  all.push_back(body("axisymmetric", "a torque-free body that precesses", V3::Zero(), {1, 1, 0.3},
                     {0.5, 0.25, 1, 1, 0.5, 3}));
  all.push_back(body("thrown",
                     "a body thrown up whose origin is not its centre of mass: the origin tumbles about it",
                     {0.1, -0.2, 0.3}, {1, 2, 2.5}, {0.5, 0.25, 3, 1, 2, -1}));
  all.back().effects = {gravity()};
  {
    Scene s = scene_of("pendulum", "a swing of almost two radians", 4);
    add(s, Revolute<double>(V3(0, 1, 0)), V3::Zero(), 1, {0, 0, -0.5}, V3::Constant(0.02));
    s = started(s, {0.5});
    s.q[0] = 1.75;
    s.effects = {gravity()};
    all.push_back(s);
  }
  {
    Scene s = scene_of("spring", "a damped spring", 4);
    add(s, Prismatic<double>(V3(0, 0, 1)), V3::Zero(), 2, V3::Zero(), V3::Constant(0.1));
    s = started(s, {1});
    s.q[0] = 0.5;
    s.effects = {gravity(), joint_effect("joint_spring", "stiffness", 50),
                 joint_effect("joint_damping", "coefficient", 1.5)};
    all.push_back(s);
  }
  {
    Scene s = scene_of("top", "a heavy top with nutation", 2);
    add(s, Spherical<double>(), V3::Zero(), 1, {0, 0, 0.25}, {0.05, 0.05, 0.1});
    s = started(s, {0.1, 0, 12});
    s.q << 0.28, 0, 0, 0.96;
    s.effects = {gravity()};
    all.push_back(s);
  }
  {
    Scene s = scene_of("chain", "three links in zero gravity, the first attached to the world", 2);
    for (int i = 0; i < 3; ++i)
      add(s, Revolute<double>(V3(0, 0, 1)), i > 0 ? V3(0.5, 0, 0) : V3(V3::Zero()), 1, {0.25, 0, 0},
          {0.01, 0.02, 0.02});
    s = started(s, {1, -2, 3});
    s.q << 0.125, 1, -0.5;
    all.push_back(s);
  }
  std::vector<Benchmark> benchmarks;
  for (const Scene& s : all) benchmarks.push_back(benchmark_of(s));
  return benchmarks;
}

}  // namespace liecheck::properties
