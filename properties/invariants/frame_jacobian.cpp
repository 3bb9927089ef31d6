// The Jacobian J of a frame gives its velocity J v and, with J' = dJ/dt, its acceleration J a + J' v.

#include <invariants/tree_frames.hpp>

namespace liecheck::properties {
namespace {

class FrameJacobian final : public TreeLaw<FrameJacobian> {
 public:
  static constexpr Statement stated{
      .name = "frame_jacobian",
      .law =
          "a frame's Jacobian times v is its velocity, J a + dJ v is its spatial acceleration "
          "(classical in LOCAL_WORLD_ALIGNED)",
      .equation =
          "J v = V, J a + J' v = V' in each reference frame, for the exact v and a and, if J is wrong, J",
      .source = "Featherstone 2008, sections 2.2, 2.10; Pinocchio 3.8, frames",
      .outputs = {op::frame_jacobian[block::linear], op::frame_jacobian[block::angular],
                  op::frame_jacobian_rate[block::linear], op::frame_jacobian_rate[block::angular]}};

  template <class T, class Case>
  void of(const Operations& subject, const Case& c, Recorder& r) const {
    const TreeOperations<double> o = subject.tree(described(c.stored));
    const ExactFrame<T> frame(c, r.ordinary(op::frame_jacobian[block::linear]));
    const FrameSizes& sizes = frame.sizes;
    // The exact J a is the velocity at v = a. It stands for that of a J which is wrong, or absent.
    std::optional<oracles::FrameMotion<T>> at_a;
    const auto J_a = [&](Seen view) {
      if (!at_a)
        at_a.emplace(c.dynamics(c.exact.a, std::vector<T>(c.nv(), T(0))).motion(),
                     static_cast<std::size_t>(c.exact.frame_joint), c.exact.frame_Q, c.exact.frame_p);
      return seen_from(view, *at_a).velocity;
    };
    for_each_view([&](Seen view) {
      const FrameViews<T> exact = seen_from(view, frame.motion);
      const MatX<double> J = o[op::frame_jacobian] ? o[op::frame_jacobian](c.q, view) : MatX<double>();
      const MatX<double> dJ =
          o[op::frame_jacobian_rate] ? o[op::frame_jacobian_rate](c.q, c.v, view) : MatX<double>();
      if (J.size())
        both(c, r, linear_angular(op::frame_jacobian), J, c.exact.v, exact.velocity,
             {sizes.velocity(view), sizes.w}, frame.resolved);
      if (dJ.size()) {
        const oracles::Vec6<T> A = view == Seen::aligned ? exact.classical : exact.acceleration;
        const std::array<double, 2> terms{sizes.acceleration(view), sizes.al};
        const bool finite = oracles::all_finite(dJ) && J.size() && oracles::all_finite(J);
        oracles::Vec6<T> own = oracles::zero_vector<6, T>();
        if (finite) own = from_list<6>(exact_product(J, c.exact.a));
        const bool right = finite && is_near(r, own + from_list<6>(exact_product(dJ, c.exact.v)), A, terms);
        both(c, r, linear_angular(op::frame_jacobian_rate), dJ, c.exact.v, A, terms, frame.resolved,
             right ? own : J_a(view));
      }
    });
  }

 private:
  /// Whether both parts of a vector err by no more than 64 eps of their terms; a correct J and J' err by less.
  template <class T>
  static bool is_near(const Recorder& r, const oracles::Vec6<T>& y, const oracles::Vec6<T>& exact,
                      const std::array<double, 2>& terms) {
    const oracles::Vec6<T> apart = y - exact;
    const double most = 64 * r.scalar().epsilon;
    return approximate(norm(head3(apart))) <= most * terms[0] &&
           approximate(norm(tail3(apart))) <= most * terms[1];
  }
  /// Records the linear and the angular part of J x, with the exact numbers of J, plus an exact `rest`.
  template <class T, class Case>
  static void both(const Case& c, Recorder& r, const TwoOutputs& outputs, const MatX<double>& J,
                   const std::vector<T>& x, const oracles::Vec6<T>& exact, const std::array<double, 2>& sizes,
                   bool resolved, const oracles::Vec6<T>& rest = oracles::zero_vector<6, T>()) {
    if (!oracles::all_finite(J)) return judged_value(r, {outputs[0], outputs[1]}, 0, J, true, [] {});
    const oracles::Vec6<T> y = from_list<6>(exact_product(J, x)) + rest;
    c.record(r, outputs[0], to_list(head3(y)), to_list(head3(exact)), {1, 1, 1}, sizes[0], resolved);
    c.record(r, outputs[1], to_list(tail3(y)), to_list(tail3(exact)), {1, 1, 1}, sizes[1], resolved);
  }
};

const RegisteredTreeLaw<FrameJacobian> registered_frame_jacobian;

}  // namespace
}  // namespace liecheck::properties
