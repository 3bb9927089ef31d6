// The pose of a frame, and its velocity and accelerations as derivatives of the pose.

#include <invariants/tree_frames.hpp>

namespace liecheck::properties {
namespace {

class FrameMotionLaw final : public TreeLaw<FrameMotionLaw> {
 public:
  static constexpr Statement stated{
      .name = "frame_motion",
      .law =
          "velocity, spatial and classical acceleration of a frame are the derivatives of its pose along "
          "integrate, in WORLD, LOCAL and LOCAL_WORLD_ALIGNED",
      .equation =
          "R' = [w]R, R'' = ([w'] + [w]^2)R along q exp(t v + t^2 a / 2); aligned: (p', w), (p'' - w x p', "
          "w'), (p'', w'); local: R^T times these; world: at the world's origin",
      .source = "Featherstone 2008, sections 2.2, 2.10",
      .outputs = {op::frame_pose[block::rotation], op::frame_pose[block::translation],
                  op::frame_velocity[block::linear], op::frame_velocity[block::angular],
                  op::frame_acceleration[block::linear], op::frame_acceleration[block::angular],
                  op::frame_classical_acceleration[block::linear],
                  op::frame_classical_acceleration[block::angular]}};

  template <class T, class Case>
  void of(const Operations& subject, const Case& c, Recorder& r) const {
    const TreeOperations<double> o = subject.tree(described(c.stored));
    const ExactFrame<T> frame(c, r.ordinary(op::frame_velocity[block::linear]));
    const auto& f = frame.motion;
    const bool resolved = frame.resolved;
    const FrameSizes& sizes = frame.sizes;
    const std::vector<double> three(3, 1);
    if (o[op::frame_pose]) {
      const Pose<double> X = o[op::frame_pose](c.q);
      c.record(r, op::frame_pose[block::rotation], flat(X.R), to_list(f.R), std::vector<double>(9, 1),
               std::sqrt(3.0) * oracles::mimic_factor(c.stored.tree, c.stored.q), resolved);
      c.record(r, op::frame_pose[block::translation], VecX<double>(X.p), to_list(f.p), three, sizes.position,
               resolved);
    }
    for_each_view([&](Seen view) {
      const FrameViews<T> exact = seen_from(view, f);
      const auto both = [&](const TwoOutputs& blocks, const Vec<double, 6>& computed,
                            const oracles::Vec6<T>& value, double size_linear, double size_angular) {
        c.record(r, blocks[0], VecX<double>(computed.head<3>()), to_list(head3(value)), three, size_linear,
                 resolved);
        c.record(r, blocks[1], VecX<double>(computed.tail<3>()), to_list(tail3(value)), three, size_angular,
                 resolved);
      };
      if (o[op::frame_velocity])
        both(linear_angular(op::frame_velocity), o[op::frame_velocity](c.q, c.v, view), exact.velocity,
             sizes.velocity(view), sizes.w);
      if (o[op::frame_acceleration])
        both(linear_angular(op::frame_acceleration), o[op::frame_acceleration](c.q, c.v, c.a, view),
             exact.acceleration, sizes.acceleration(view), sizes.al);
      if (o[op::frame_classical_acceleration])
        both(linear_angular(op::frame_classical_acceleration),
             o[op::frame_classical_acceleration](c.q, c.v, c.a, view), exact.classical,
             sizes.acceleration(view), sizes.al);
    });
  }
};

const RegisteredTreeLaw<FrameMotionLaw> registered_frame_motion;

}  // namespace
}  // namespace liecheck::properties
