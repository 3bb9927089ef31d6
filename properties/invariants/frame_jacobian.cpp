// The Jacobian J of a frame gives its velocity J v and, with J' = dJ/dt, its acceleration J a + J' v.

#include <invariants/tree_frames.hpp>

namespace liecheck::properties {
namespace {

template <class S>
class FrameJacobian final : public TreeLaw<FrameJacobian, S> {
 public:
  static constexpr Statement stated{
      .name = "frame_jacobian",
      .law =
          "a frame's Jacobian times v is its velocity, J a + dJ v is its spatial acceleration "
          "(classical in LOCAL_WORLD_ALIGNED)",
      .equation = "J v = V, J a + J' v = V' in each reference frame, for the exact v and a",
      .source = "Featherstone 2008, sections 2.2, 2.10; Pinocchio 3.8, frames",
      .outputs = {op::frame_jacobian[block::linear], op::frame_jacobian[block::angular],
                  op::frame_jacobian_rate[block::linear], op::frame_jacobian_rate[block::angular]}};

  template <class T, class Case>
  void of(const Operations<S>& subject, const Case& c, Recorder& r) const {
    const TreeOperations<S> o = subject.tree(described(c.stored));
    const ExactFrame<T> frame(c);
    const FrameSizes& sizes = frame.sizes;
    for (const Seen view : every_view) {
      const FrameViews<T> exact = seen_from(view, frame.motion);
      const MatX<S> J = o[op::frame_jacobian] ? o[op::frame_jacobian](c.q, view) : MatX<S>();
      const MatX<S> dJ = o[op::frame_jacobian_rate] ? o[op::frame_jacobian_rate](c.q, c.v, view) : MatX<S>();
      if (J.size())
        both<op::frame_jacobian, T>(c, r, {{&J, &c.exact.v}}, exact.velocity, {sizes.velocity(view), sizes.w},
                                    frame.resolved);
      if (J.size() && dJ.size())
        both<op::frame_jacobian_rate, T>(c, r, {{&J, &c.exact.a}, {&dJ, &c.exact.v}},
                                         view == Seen::aligned ? exact.classical : exact.acceleration,
                                         {sizes.acceleration(view), sizes.al}, frame.resolved);
    }
  }

 private:
  /// Records the linear and the angular part of a sum of matrices times exact vectors.
  template <const auto& operation, class T, class Case>
  static void both(const Case& c, Recorder& r,
                   const std::vector<std::pair<const MatX<S>*, const std::vector<T>*>>& sums,
                   const oracles::Vec6<T>& exact, const std::array<double, 2>& sizes, bool resolved) {
    constexpr Output outputs[] = {operation[block::linear], operation[block::angular]};
    for (const auto& [J, x] : sums)
      if (!oracles::all_finite(*J)) {
        for (const Output& output : outputs) r.outcome(output, 0, Outcome::not_finite);
        return;
      }
    for (int part = 0; part < 2; ++part) {
      std::vector<T> computed(3, T(0)), value;
      for (int i = 0; i < 3; ++i) {
        for (const auto& [J, x] : sums)
          for (int k = 0; k < J->cols(); ++k)
            computed[static_cast<std::size_t>(i)] +=
                oracles::exact<T>((*J)(3 * part + i, k)) * (*x)[static_cast<std::size_t>(k)];
        value.push_back(exact[3 * part + i]);
      }
      c.record(r, outputs[part], computed, value, {1, 1, 1}, sizes[static_cast<std::size_t>(part)], resolved);
    }
  }
};

const RegisteredTreeLaw<FrameJacobian> registered;

}  // namespace
}  // namespace liecheck::properties
