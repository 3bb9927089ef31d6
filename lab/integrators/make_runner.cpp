#include <integrators/liecheck_runner.hpp>
#include <integrators/make_runner.hpp>
#include <liecheck/scene/scene.hpp>

namespace liecheck::properties {

// float128_*.cpp and double_runners.cpp compile them.
extern template MakeRunner<Float128LoneBody> liecheck_runner<Float128LoneBody>;
extern template MakeRunner<Float128Tree> liecheck_runner<Float128Tree>;
extern template MakeRunner<scene::ThrownBody<double>> liecheck_runner<scene::ThrownBody<double>>;
extern template MakeRunner<scene::LoneBody<double>> liecheck_runner<scene::LoneBody<double>>;
extern template MakeRunner<scene::LoneJoint<double>> liecheck_runner<scene::LoneJoint<double>>;
extern template MakeRunner<scene::Tree<double>> liecheck_runner<scene::Tree<double>>;

namespace {

scene::Effects<float128> effects_in_float128(const Benchmark& b) {
  if (!b.source) return {};
  return scene::makeEffects<float128>(*b.source, sharpened(b.source->model));
}

}  // namespace

std::unique_ptr<Runner> make_runner(const Benchmark& scene, const std::string& method,
                                    const std::string& scalar) {
  using scene::SystemKind;
  const SystemKind kind = scene::kindOf(scene.robot, scene.effects(), method);
  if (scalar == "float128") {
    const auto make =
        kind >= SystemKind::LoneBody ? liecheck_runner<Float128LoneBody> : liecheck_runner<Float128Tree>;
    return make(scene, method, effects_in_float128(scene));
  }
  if (scalar != "double") throw std::invalid_argument("a scene runs in double or float128, not in " + scalar);
  const auto make = kind == SystemKind::ThrownBody  ? liecheck_runner<scene::ThrownBody<double>>
                    : kind == SystemKind::LoneBody  ? liecheck_runner<scene::LoneBody<double>>
                    : kind == SystemKind::LoneJoint ? liecheck_runner<scene::LoneJoint<double>>
                                                    : liecheck_runner<scene::Tree<double>>;
  return make(scene, method, scene.effects());
}

}  // namespace liecheck::properties
