#pragma once
// attitude_error: the angle between a run and a reference motion by gauss12 in `refinement` times the steps.

#include <liecheck/scene/observers/registry.hpp>
#include <liecheck/scene/scene.hpp>

namespace liecheck::scene {

template <class Sys>
class AttitudeError {
 public:
  AttitudeError(const Scene& scene, const Sys& system, const Parameters& p)
      : scene_(scene), refinement_(long(p.number("refinement"))), reference_(startOf(scene, system)) {}

  /// The largest angle [rad] between the quaternions of a joint in `state`, which is that after step n, and in the
  /// reference motion. go_on is asked during the integration; false throws Interrupted.
  double sample(Sys& system, const State<Sys>& state, long n, const std::function<bool()>& go_on);
  double largest() const { return largest_; }

 private:
  const Scene& scene_;
  long refinement_, steps_ = 0;
  State<Sys> reference_;
  std::unique_ptr<Method<Sys>> method_;
  double largest_ = 0;
};

}  // namespace liecheck::scene
