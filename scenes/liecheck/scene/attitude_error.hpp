#pragma once
// attitude_error: the angle to a reference motion that gauss12 computes in `refinement` times as many steps.

#include <liecheck/scene/observers/registry.hpp>
#include <liecheck/scene/scene.hpp>

namespace liecheck::scene {

template <class Sys>
class AttitudeError {
 public:
  AttitudeError(const Scene& scene, const Sys& system, const Parameters& p)
      : scene_(scene), refinement_(long(p.number("refinement"))), reference_(startOf(scene, system)) {}

  /// The largest angle [rad], over all joints with a quaternion, between `state` after step n and the
  /// reference motion. go_on is called during the integration; if it returns false, Interrupted is thrown.
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
