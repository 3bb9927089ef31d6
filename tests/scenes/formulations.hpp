#pragma once
// The two formulations of a scene, and how far they are apart.

#include <integrators/make_runner.hpp>
#include <integrators/independent.hpp>
#include <scenes/runner.hpp>

#include "effect_scenes.hpp"

namespace liecheck::test {

/// The largest difference of a number of q or v. Q and -Q are the same.
inline double distance(const Model<double>& robot, const properties::Moment& a, const properties::Moment& b) {
  using oracles::Real;
  Real largest(0);
  const auto take = [&](const Real& x) {
    if (!(abs(x) <= largest)) largest = abs(x);
  };
  for (std::size_t k = 0; k < a.v.size(); ++k) take(a.v[k] - b.v[k]);
  for (std::size_t i = 1; i < robot.joints.size(); ++i) {
    const std::size_t at = std::size_t(robot.idx_qs[i]), n = std::size_t(robot.nqs[i]),
                      unit =
                          std::visit([](const auto&j) { return std::size_t(j.unit_begin); }, robot.joints[i]);
    Real dot(0);
    for (std::size_t k = unit; k < n; ++k) dot += a.q[at + k] * b.q[at + k];
    for (std::size_t k = 0; k < n; ++k)
      take(k < unit || dot > 0 ? a.q[at + k] - b.q[at + k] : a.q[at + k] + b.q[at + k]);
  }
  return static_cast<double>(largest);
}

struct Formulations {
  explicit Formulations(const EffectScene& s) : scene(properties::benchmark_of(scene_of(s))) {
    properties::make_runner(scene, "gauss12", "float128")
        ->run({std::lround(scene.duration / 0.005), 0}, 1,
              [this](double, const properties::Moment& m) { tangents = m; });
    agreement = distance(
        scene.robot, tangents,
        properties::moments_of<properties::float128>(
            properties::independent_tree<properties::float128>(scene), scene, 1, properties::float128(1e-26))
            .back());
  }
  properties::Benchmark scene;
  properties::Moment tangents;  ///< at the end, by increments in the tangent space, in float128
  double agreement = 0;         ///< with maximal coordinates in float128

  /// The distance from maximal coordinates with other laws, in long double.
  double from(oracles::MaximalTree<long double> tree) const {
    return distance(scene.robot, tangents,
                    properties::moments_of<long double>(std::move(tree), scene, 1, 1e-11L).back());
  }
};

}  // namespace liecheck::test
