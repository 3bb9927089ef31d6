#pragma once
// Runners that simulate with liecheck in double or float128.

#include <fmt/format.h>
#include <integrators/float128_algorithms.hpp>
#include <liecheck/scene/integrators/registry.hpp>
#include <liecheck/scene/lone_body.hpp>
#include <liecheck/scene/simulate.hpp>
#include <liecheck/scene/tree.hpp>
#include <oracles/number.hpp>
#include <scenes/runner.hpp>

namespace liecheck::scene {

extern template LoneBody<float128>::LoneBody(const Model<float128>&, Effects<float128>);
extern template struct CollocationPoints<float128>;

}  // namespace liecheck::scene

namespace liecheck::properties {

/// Returns a method of order 4 or more in float128. The others are not needed there, and each is slow to
/// compile. Throws std::invalid_argument for any other name.
template <class Sys>
std::unique_ptr<scene::Method<Sys>> make_float128_method(const std::string& name,
                                                         const scene::MethodOptions& options = {}) {
  if (name == "quaternion_rk4") return std::make_unique<scene::QuaternionRk4<Sys>>();
  if (name == "rkmk4") return std::make_unique<scene::Rkmk4<Sys>>();
  if (name == "cf4") return std::make_unique<scene::CommutatorFree4<Sys>>();
  if (name == "dopri5") return std::make_unique<scene::Dopri5<Sys>>(options);
  if (name == "radau5") return std::make_unique<scene::Radau5<Sys>>(options);
  if (name == "rkmk6") return std::make_unique<scene::Rkmk6<Sys>>();
  if (name == "gauss6") return std::make_unique<scene::Gauss6<Sys>>();
  if (name == "gauss12") return std::make_unique<scene::Gauss12<Sys>>();
  scene::methodInfo(name);  // throws if there is none
  throw std::invalid_argument("float128 runs integrators of order 4 and above, not '" + name + "'");
}

using Float128LoneBody = scene::LoneBody<float128>;
using Float128Tree = scene::Tree<float128>;
// float128_lone_body.cpp and float128_tree_methods.cpp compile them.
extern template std::unique_ptr<scene::Method<Float128LoneBody>> make_float128_method(
    const std::string&, const scene::MethodOptions&);
extern template std::unique_ptr<scene::Method<Float128Tree>> make_float128_method(
    const std::string&, const scene::MethodOptions&);

template <class Sys>
std::unique_ptr<scene::Method<Sys>> make_method(const std::string& name,
                                                const scene::MethodOptions& options = {}) {
  if constexpr (std::is_same_v<typename Sys::Scalar, float128>)
    return make_float128_method<Sys>(name, options);
  else
    return scene::makeMethod<Sys>(name, options);
}

template <class Sys>
class LiecheckRunner final : public Runner {
 public:
  using S = typename Sys::Scalar;
  LiecheckRunner(const Benchmark& scene, const std::string& method, const scene::Effects<S>& effects)
      : system_(robot_of(scene), effects),
        start_(system_, scene.q0.cast<S>(), scene.v0.cast<S>()),
        state_(start_),
        duration_(scene.duration),
        name_(method) {
    make_method<Sys>(name_);
    start_.compensate(scene::compensates(scene::methodInfo(name_)));
    if constexpr (std::is_same_v<S, float128>) system_.normalize(start_.q);
    state_ = start_;
  }

  long run(const Effort& effort, long samples,
           const std::function<void(double, const Moment&)>& watch) override {
    Moment m;
    long made = 0;
    simulate(
        effort, effort.steps / samples,
        [&](const scene::State<Sys>& state) {
          m.q.clear(), m.v.clear();
          const auto [q, v] = system_.toModel(state);
          for (int i = 0; i < q.size(); ++i) m.q.push_back(oracles::exact<oracles::Real>(S(q[i])));
          for (int i = 0; i < v.size(); ++i) m.v.push_back(oracles::exact<oracles::Real>(S(v[i])));
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
  static Model<S> robot_of(const Benchmark& scene) {
    if constexpr (std::is_same_v<S, float128>)
      return sharpened(scene.robot);
    else
      return scene.robot;
  }
  template <class Watch>
  void simulate(const Effort& effort, long every, const Watch& watch, long* made) {
    if (!method_ || effort.tolerance != tolerance_) {
      tolerance_ = effort.tolerance;
      method_ =
          make_method<Sys>(name_, {tolerance_ > 0 ? tolerance_ : std::numeric_limits<double>::infinity(),
                                   [this] { return this->stopped(); }});
    }
    const long before = method_->counts().steps;
    state_ = start_;
    // A step in float128 may take a tenth of a second.
    if (every != every_) every_ = every, polled_ = std::is_same_v<S, double> ? largest_divisor(every) : 1;
    const scene::Outcome o = scene::simulate(system_, *method_, state_, {duration_, effort.steps, polled_},
                                             [&](const auto& state, long n) {
                                               if (n % every == 0 || n == effort.steps) watch(state);
                                               return !this->stopped();
                                             });
    if (this->stopped()) throw Stopped();
    if (o.diverged) throw Diverged(fmt::format("at {:.6g} s, after {} steps: {}", o.t, o.steps, o.why));
    if (made) *made = method_->what().adaptive ? method_->counts().steps - before : o.steps;
  }

  /// The largest divisor of n up to 256.
  static long largest_divisor(long n) {
    long d = std::min(n, 256L);
    while (n % d != 0) --d;
    return d;
  }

  Sys system_;
  scene::State<Sys> start_, state_;
  double duration_, tolerance_ = -1;
  long every_ = 0, polled_ = 0;  ///< steps between two samples, and between two looks at `stop`
  std::string name_;
  std::unique_ptr<scene::Method<Sys>> method_;
};

template <class Sys>
std::unique_ptr<Runner> liecheck_runner(const Benchmark& scene, const std::string& method,
                                        const scene::Effects<typename Sys::Scalar>& effects) {
  return std::make_unique<LiecheckRunner<Sys>>(scene, method, effects);
}
/// Its type.
template <class Sys>
using MakeRunner = decltype(liecheck_runner<Sys>);

}  // namespace liecheck::properties
