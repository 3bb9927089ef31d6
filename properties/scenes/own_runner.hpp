#pragma once
// Our library as a Runner, in any scalar.

#include <fmt/format.h>
#include <liecheck/scene/integrators/registry.hpp>
#include <liecheck/scene/lone_body.hpp>
#include <liecheck/scene/simulate.hpp>
#include <liecheck/scene/tree.hpp>
#include <oracles/number.hpp>
#include <scenes/runner.hpp>

namespace liecheck::properties {

template <class Sys>
class OwnRunner final : public Runner {
 public:
  using S = typename Sys::Scalar;
  OwnRunner(const Benchmark& scene, const std::string& method, const scene::Effects<S>& effects)
      : system_(scene.robot.cast<S>(), effects),
        start_(system_, typename Sys::Configuration(scene.q0.cast<S>()),
               typename Sys::Tangent(scene.v0.cast<S>())),
        state_(start_),
        duration_(scene.duration),
        name_(method) {
    scene::makeMethod<Sys>(name_);
  }

  long run(const Effort& effort, long samples,
           const std::function<void(double, const Moment&)>& watch) override {
    Moment m;
    long made = 0;
    simulate(
        effort, effort.steps / samples,
        [&](const scene::State<Sys>& state) {
          m.q.clear(), m.v.clear();
          for (int i = 0; i < state.q.size(); ++i)
            m.q.push_back(oracles::exact<oracles::Real>(S(state.q[i])));
          for (int i = 0; i < state.v.size(); ++i)
            m.v.push_back(oracles::exact<oracles::Real>(S(state.v[i])));
          watch(static_cast<double>(state.t), m);
        },
        &made);
    return made;
  }
  void pass(const Effort& effort) override {
    simulate(
        effort, effort.steps, [](const scene::State<Sys>&) {}, nullptr);
  }

 private:
  template <class Watch>
  void simulate(const Effort& effort, long every, const Watch& watch, long* made) {
    if (!method_ || effort.tolerance != tolerance_) {
      tolerance_ = effort.tolerance;
      method_ = scene::makeMethod<Sys>(
          name_, {tolerance_ > 0 ? tolerance_ : std::numeric_limits<double>::infinity()});
    }
    const long before = method_->counts().steps;
    state_ = start_;
    const scene::Outcome o = scene::simulate(system_, *method_, state_, {duration_, effort.steps, every},
                                             [&](const auto& state, long) {
                                               watch(state);
                                               return true;
                                             });
    if (o.diverged) throw Diverged(fmt::format("at {:.6g} s, after {} steps: {}", o.t, o.steps, o.why));
    if (made) *made = method_->what().adaptive ? method_->counts().steps - before : o.steps;
  }

  Sys system_;
  scene::State<Sys> start_, state_;
  double duration_, tolerance_ = -1;
  std::string name_;
  std::unique_ptr<scene::Method<Sys>> method_;
};

template <class S>
std::unique_ptr<Runner> own_runner(const Benchmark& scene, const std::string& method,
                                   const scene::Effects<S>& effects) {
  if (scene::LoneBody<double>::fits(scene.robot))
    return std::make_unique<OwnRunner<scene::LoneBody<S>>>(scene, method, effects);
  return std::make_unique<OwnRunner<scene::Tree<S>>>(scene, method, effects);
}

std::unique_ptr<Runner> own_runner_quad(const Benchmark& scene, const std::string& method);

}  // namespace liecheck::properties
