// Equivalent models of one robot have the same dynamics.

#include <invariants/tree_law.hpp>

namespace liecheck::properties {
namespace {

class TreeInvariance final : public TreeLaw<TreeInvariance> {
 public:
  static constexpr Output world = op::rnea_of_a_moved_world[block::torque],
                          order = op::rnea_of_reordered_joints[block::torque],
                          parts = op::rnea_of_split_bodies[block::torque];
  static constexpr bool rebuilds = true;
  static constexpr Statement stated{
      .name = "tree_invariance",
      .law =
          "joint torques do not depend on the world's frame, on the order of the joints, or on how a rigid "
          "body is split into parts",
      .equation =
          "rnea equals Lagrange's equations of the original tree (1) in a world frame rotated by pi about x "
          "and translated, (2) with the branches in reverse order, (3) with each body as two halves, one in "
          "a frame rotated by 2 pi / 3",
      .source =
          "invariance of Lagrange's equations under a change of description: Goldstein 1980, section 1.4",
      .outputs = {world, order, parts},
      .formed = {{&op::rnea_of_a_moved_world, {&op::tree_rnea}},
                 {&op::rnea_of_reordered_joints, {&op::tree_rnea}},
                 {&op::rnea_of_split_bodies, {&op::tree_rnea}}}};

  template <class T, class Case>
  void of(const Operations& subject, const Case& c, Recorder& r) const {
    const Tree<double> tree = described(c.stored);
    const auto moving = c.dynamics(c.exact.v, c.exact.a);
    const std::vector<double> w = inverses(mass_roots(moving.mass(), c.nv()));
    const std::vector<T> exact = moving.torque(c.exact.wrench);
    const double terms = weighted_size(c.sizes(c.stored.v, c.stored.a, true).tau, w);
    const bool resolved = c.resolved();
    const auto record = [&](const Output& output, const VecX<double>& tau) {
      c.record(r, output, tau, exact, w, terms, resolved);
    };
    const TreeOperations<double> moved = subject.tree(in_a_moved_world(tree));
    if (!moved[op::tree_rnea]) return;
    record(world, moved[op::tree_rnea](c.q, c.v, c.a, c.F_joint, c.F));
    record(parts, subject.tree(in_parts(tree))[op::tree_rnea](c.q, c.v, c.a, c.F_joint, c.F));
    if (has_mimic(tree)) return r.outcome(order, 0, Outcome::ill_posed);
    const std::vector<int> from = reordered(tree);
    Tree<double> other = tree;
    std::vector<int> place(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) place[at(from[i])] = static_cast<int>(i);
    for (std::size_t i = 0; i < from.size(); ++i) {
      other.joints[i] = tree.joints[at(from[i])];
      if (int& p = other.joints[i].parent; p >= 0) p = place[at(p)];
    }
    other.index(), other.frame_joint = 0;
    const auto shuffled = [&](const VecX<double>& x, bool q, bool back) {
      VecX<double> y(x.size());
      for (std::size_t i = 0; i < from.size(); ++i) {
        const auto& j = other.joints[i];
        const int n = q ? configuration_size(j.kind) : velocity_size(j.kind);
        const int here = q ? other.idx_q[i] : other.idx_v[i];
        const int there = q ? tree.idx_q[at(from[i])] : tree.idx_v[at(from[i])];
        y.segment(back ? there : here, n) = x.segment(back ? here : there, n);
      }
      return y;
    };
    record(order, shuffled(subject.tree(other)[op::tree_rnea](
                               shuffled(c.q, true, false), shuffled(c.v, false, false),
                               shuffled(c.a, false, false), c.F_joint < 0 ? -1 : place[at(c.F_joint)], c.F),
                           false, true));
  }

 private:
  /// The branches of a tree with a mimic joint cannot be reordered: a mimic must follow its primary joint.
  static bool has_mimic(const oracles::TreeOf<double>& tree) {
    return std::any_of(tree.joints.begin(), tree.joints.end(), [](const auto& j) { return j.primary >= 0; });
  }
  bool exists(const Output& output) const override {
    const auto robot = this->users_tree();
    return TreeLaw::exists(output) && (!robot || output.record != order.record || !has_mimic(robot->tree));
  }
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  /// Rotates the world frame by pi about x and moves it by 100 m along x. This rounds only the positions of
  /// joints on the world, on which no torque depends.
  static Tree<double> in_a_moved_world(Tree<double> t) {
    for (auto& j : t.joints) {
      if (j.parent >= 0) continue;
      const auto Q = j.Q;
      j.Q = {{Q[3], -Q[2], Q[1], -Q[0]}};
      j.p = {{j.p[0] + 100, -j.p[1], -j.p[2]}};
    }
    t.gravity = {{t.gravity[0], -t.gravity[1], -t.gravity[2]}};
    return t;
  }
  /// Splits each body into two equal halves. The frame of the second half is at 2 c, rotated by 2 pi / 3
  /// about (1, 1, 1), so that R e_x = e_y. Its centre of mass in that frame is -R^T c. All numbers are exact.
  static Tree<double> in_parts(Tree<double> t) {
    const double half = 0.5;
    for (std::size_t i = 0; i < t.joints.size(); ++i) {
      auto& body = t.joints[i].body;
      body.mass *= half;
      for (double& x : body.I_C.x) x *= half;
      oracles::BodyOf<double> other = body;
      for (int k = 0; k < 3; ++k) {
        other.c[k] = -body.c[(k + 1) % 3];
        for (int l = 0; l < 3; ++l) other.I_C(k, l) = body.I_C((k + 1) % 3, (l + 1) % 3);
      }
      t.fixed.push_back({static_cast<int>(i),
                         other,
                         {{half, half, half, half}},
                         {{2 * body.c[0], 2 * body.c[1], 2 * body.c[2]}}});
    }
    return t;
  }
  /// The order of the joints in a depth-first traversal from the last branch to the first.
  static std::vector<int> reordered(const Tree<double>& t) {
    std::vector<int> order;
    const auto visit = [&](auto& self, int parent) -> void {
      for (int i = static_cast<int>(t.joints.size()); i-- > 0;)
        if (t.joints[at(i)].parent == parent) {
          order.push_back(i);
          self(self, i);
        }
    };
    visit(visit, -1);
    return order;
  }
};

const RegisteredTreeLaw<TreeInvariance> registered_tree_invariance;

}  // namespace
}  // namespace liecheck::properties
