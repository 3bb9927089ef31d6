#include <liecheck/scene/scene.hpp>
#include <scenes/benchmark.hpp>

namespace liecheck::properties {

namespace {

/// The vector of numbers for all coordinates, of zeros at first.
Eigen::VectorXd& sized(Eigen::VectorXd& of, const Benchmark& b) {
  if (of.size() == 0) of = Eigen::VectorXd::Zero(b.robot.nv);
  return of;
}

/// Two springs of one coordinate are one spring, whose stiffness is the sum.
void add_spring(Benchmark& b, int at, double stiffness, double rest) {
  double &k = sized(b.stiffness, b)[at], &r = sized(b.rest, b)[at];
  if (k > 0) b.others = true;  // the rest of both is rounded
  r = k > 0 ? (k * r + stiffness * rest) / (k + stiffness) : rest;
  k += stiffness;
}

void add_servos(Benchmark& b, const scene::Scene& s, const scene::Parameters& p) {
  const std::vector<double> target = p.has("target") ? p.numbers("target") : std::vector<double>{0};
  std::size_t k = 0;
  for (const scene::Coordinate& c : scene::positions(s.model, p.names("joints"))) {
    const double to = target.size() == 1 ? target[0] : target.at(k++);
    b.servos.push_back({c.v, p.number("stiffness"), p.number("damping"), to, s.model.effortLimit[c.v]});
  }
}

/// Adds an effect to the fields of a benchmark.
void repeat(Benchmark& b, const scene::Scene& s, const scene::Request& r) {
  const scene::Parameters& p = r.parameters;
  const auto number = [&](const char* key) { return p.number(key); };
  if (r.name == "gravity") {
    b.gravity += scene::vectorOf<double>(p.numbers("acceleration"));
  } else if (r.name == "joint_spring") {
    for (const scene::Coordinate& c : scene::positions(s.model, p.names("joints")))
      add_spring(b, c.v, number("stiffness"), number("rest"));
  } else if (r.name == "joint_damping") {
    for (const scene::Coordinate& c : scene::coordinates(s.model, p.names("joints")))
      sized(b.damping, b)[c.v] += p.has("coefficient") ? number("coefficient") : s.model.damping[c.v];
  } else if (r.name == "armature") {
    for (const scene::Coordinate& c : scene::coordinates(s.model, p.names("joints")))
      sized(b.armature, b)[c.v] += number("inertia");
    b.others = true;
  } else {
    if (r.name == "pd" && !p.has("rows")) add_servos(b, s, p);
    b.others = true;
  }
}

}  // namespace

Benchmark benchmark_of(const scene::Scene& scene) {
  Benchmark b;
  b.name = scene.name, b.what = scene.reason;
  b.robot = scene.model;
  b.q0 = scene.q, b.v0 = scene.v;
  b.duration = scene.span.duration;
  b.requests = scene.effects, b.around = scene.around;
  const auto shared = std::make_shared<scene::Scene>(scene);
  b.effects = [shared] { return scene::makeEffects<double>(*shared, shared->model); };
  b.source = shared;
  for (const scene::Request& r : scene.effects) {
    b.effect_names.push_back(r.name + (r.name == "pd" && r.parameters.has("rows") ? " along rows" : ""));
    repeat(b, scene, r);
  }
  return b;
}

}  // namespace liecheck::properties
