#include <liecheck/scene/scene.hpp>
#include <scenes/benchmark.hpp>
#include <scenes/float128_algorithms.hpp>

namespace liecheck::properties {

Benchmark benchmark_of(const scene::Scene& scene) {
  Benchmark b;
  b.name = scene.name, b.what = scene.reason;
  b.robot = scene.model;
  b.q0 = scene.q, b.v0 = scene.v;
  b.duration = scene.span.duration;
  b.requests = scene.effects, b.around = scene.around;
  const auto shared = std::make_shared<scene::Scene>(scene);
  b.effects = [shared] { return scene::makeEffects<double>(*shared, shared->model); };
  b.effects_float128 = [shared] {
    return scene::makeEffects<float128>(*shared, sharpened(shared->model));
  };
  const auto set = [&](Eigen::VectorXd& of, const scene::Request& r, const char* key) {
    if (of.size() == 0) of = Eigen::VectorXd::Zero(b.robot.nv);
    for (const scene::Coordinate& c : scene::coordinates(scene.model, r.parameters.names("joints")))
      of[c.v] += r.parameters.number(key);
  };
  for (const scene::Request& r : scene.effects) {
    if (r.name == "gravity") {
      b.gravity += scene::vectorOf<double>(r.parameters.numbers("acceleration"));
    } else if (r.name == "joint_spring" && b.stiffness.size() == 0) {
      set(b.stiffness, r, "stiffness"), set(b.rest, r, "rest");
    } else if (r.name == "joint_damping" && b.damping.size() == 0 && r.parameters.has("coefficient")) {
      set(b.damping, r, "coefficient");
    } else {
      b.others = true;
    }
  }
  return b;
}

}  // namespace liecheck::properties
