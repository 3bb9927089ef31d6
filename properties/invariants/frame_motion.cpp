// Pose, velocity and acceleration of a frame are the motion of its pose.

#include <invariants/tree_frames.hpp>

namespace liecheck::properties {
namespace {

template <class S>
class FrameMotionLaw final : public TreeLaw<FrameMotionLaw, S> {
 public:
  static constexpr bool floating = false;
  std::string name() const override { return "frame_motion"; }
  std::string law() const override {
    return "velocity, spatial and classical acceleration of a frame are the derivatives of its pose along "
           "integrate, in WORLD, LOCAL and LOCAL_WORLD_ALIGNED";
  }
  std::string equation() const override {
    return "R' = [w]R, R'' = ([w'] + [w]^2)R along q exp(t v + t^2 a / 2); aligned (p', w), (p'' - w x p', "
           "w'), "
           "(p'', w'); local R^T of them; world at the world's origin";
  }
  std::string source() const override {
    return "Featherstone 2008, sections 2.2, 2.10; Pinocchio 3.8, reference frames";
  }
  enum { rotation, position, linear, angular };  // of velocity; then of both accelerations
  std::vector<Output> outputs() const override {
    return {{"frame_pose", "rotation"},
            {"frame_pose", "translation"},
            {"frame_velocity", "linear"},
            {"frame_velocity", "angular"},
            {"frame_acceleration", "linear"},
            {"frame_acceleration", "angular"},
            {"frame_classical_acceleration", "linear"},
            {"frame_classical_acceleration", "angular"}};
  }

  template <class T, class Case>
  void of(const Operations<S>& subject, const Case& c, Recorder& r) const {
    const TreeOperations<S> o = subject.tree(described(c.stored));
    const ExactFrame<T> frame(c);
    const auto& f = frame.motion;
    const bool resolved = frame.resolved;
    const FrameSizes& sizes = frame.sizes;
    const auto list = [](const auto& v) { return std::vector<T>(v.x.begin(), v.x.end()); };
    const std::vector<double> three(3, 1);
    if (o.frame) {
      const Pose<S> X = o.frame(c.q);
      c.record(r, rotation, this->flat(X.R), list(f.R), std::vector<double>(9, 1),
               std::sqrt(3.0) * oracles::mimic_factor(c.rough.tree, c.rough.q), resolved);
      c.record(r, position, VecX<S>(X.p), list(f.p), three, sizes.position, resolved);
    }
    for (const Seen view : every_view) {
      const FrameViews<T> exact = seen_from(view, f);
      const auto both = [&](int output, const Vec<S, 6>& computed, const oracles::Vec6<T>& value,
                            double size_linear, double size_angular) {
        c.record(r, output, VecX<S>(computed.template head<3>()), list(head3(value)), three, size_linear,
                 resolved);
        c.record(r, output + 1, VecX<S>(computed.template tail<3>()), list(tail3(value)), three, size_angular,
                 resolved);
      };
      if (o.frame_velocity)
        both(linear, o.frame_velocity(c.q, c.v, view), exact.velocity, sizes.velocity(view), sizes.w);
      if (o.frame_acceleration)
        both(linear + 2, o.frame_acceleration(c.q, c.v, c.a, view), exact.acceleration,
             sizes.acceleration(view), sizes.al);
      if (o.frame_classical_acceleration)
        both(linear + 4, o.frame_classical_acceleration(c.q, c.v, c.a, view), exact.classical,
             sizes.acceleration(view), sizes.al);
    }
  }
};

const RegisteredTreeLaw<FrameMotionLaw> registered;

}  // namespace
}  // namespace liecheck::properties
