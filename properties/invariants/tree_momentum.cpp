// The momentum of a floating robot, the matrix A_g with h = A_g v, and the conservation of momentum.

#include <algorithm>
#include <invariants/tree_law.hpp>

namespace liecheck::properties {
namespace {

class TreeMomentum final : public TreeLaw<TreeMomentum> {
 public:
  static constexpr bool floating = true;
  static constexpr Output linear = op::tree_momentum[block::linear],
                          angular = op::tree_momentum[block::angular],
                          map_linear = op::tree_momentum_map[block::linear],
                          map_angular = op::tree_momentum_map[block::angular],
                          conserved = op::momentum_conserved[block::torque];
  static constexpr Statement stated{
      .name = "tree_momentum",
      .law =
          "the momentum at the centre of mass is A_g v; without gravity and base forces, joint torques do "
          "not change it",
      .equation =
          "h = sum m (x'; (x - c) x x') = A_g v; tau_base(q, v, aba(q, v, (0, tau))) = 0 for g = 0, "
          "relative to the terms of forward_dynamics",
      .source = "Orin & Goswami 2008; Noether 1918",
      .outputs = {linear, angular, map_linear, map_angular, conserved},
      .formed = {{&op::momentum_conserved, {&op::tree_aba}}}};

  template <class T, class Case>
  void of(const Operations& subject, const Case& c, Recorder& r) const {
    Tree<double> weightless = described(c.stored);
    weightless.gravity = {{0, 0, 0}};
    const TreeOperations<double> o = subject.tree(weightless);
    const std::vector<T> still(c.nv(), T(0));
    const auto moving = c.dynamics(c.exact.v, still);
    const bool resolved = c.resolved();
    const auto half = [](const oracles::Vec6<T>& h, int part) {
      return std::vector<T>{h[3 * part], h[3 * part + 1], h[3 * part + 2]};
    };
    const oracles::Vec6<T> h = moving.momentum();
    const auto sizes = c.sizes(c.stored.v, c.stored.v);
    const auto record = [&](const Output& output, int part, const auto& computed) {
      c.record(r, output, computed, half(h, part), {1, 1, 1}, part == 0 ? sizes.linear : sizes.angular,
               resolved);
    };
    // Each operation is called once: a second call would hide that the first one returned an earlier result.
    if (o[op::tree_momentum]) {
      const VecX<double> computed = o[op::tree_momentum](c.q, c.v);
      for (int part = 0; part < 2; ++part)
        record(part == 0 ? linear : angular, part, VecX<double>(computed.segment<3>(3 * part)));
    }
    if (o[op::tree_momentum_map]) {
      const MatX<double> A = o[op::tree_momentum_map](c.q);
      for (int part = 0; part < 2; ++part) {
        const Output& output = part == 0 ? map_linear : map_angular;
        const MatX<double> rows = A.middleRows(3 * part, 3);
        if (oracles::all_finite(rows))
          record(output, part, exact_product(rows, c.exact.v));
        else
          r.outcome(output, 0, Outcome::not_finite);
      }
    }
    if (o[op::tree_aba] && floats(c.exact.tree)) conservation<T>(o, c, r, moving.mass());
  }

 private:
  /// Whether the first joint is a free-flyer.
  template <class T>
  static bool floats(const oracles::TreeOf<T>& tree) {
    return tree.joints[0].kind == oracles::JointKind::free_flyer;
  }
  /// An armature of the base connects it to the world: then its momentum is not conserved.
  template <class T>
  static bool is_held(const oracles::TreeOf<T>& tree) {
    return tree.joints[0].armature > T(0);
  }
  bool exists(const Output& output) const override {
    if (!TreeLaw::exists(output)) return false;
    const auto robot = this->users_tree();
    // Without any mass there is no centre of mass.
    if (robot && std::ranges::all_of(robot->tree.joints, [](const auto& j) { return j.body.mass == 0; }))
      return false;
    return !robot || output.record != conserved.record || (floats(robot->tree) && !is_held(robot->tree));
  }

  template <class T, class Case>
  static void conservation(const TreeOperations<double>& o, const Case& c, Recorder& r,
                           const std::vector<T>& M) {
    if (is_held(c.exact.tree)) return r.outcome(conserved, 0, Outcome::ill_posed);
    VecX<double> tau = c.a;
    tau.head<6>().setZero();
    const std::vector<double> roots = mass_roots(M, c.nv()), w = moving_inverses(roots);
    const auto singular = [&] {
      const std::vector<double> at_rest(c.nv(), 0);
      return nearly_singular(r.scalar(), oracles::positive_factor(M, c.nv()), roots,
                             weighted_size(c.sizes(at_rest, at_rest).mass, products(w)));
    };
    solved(r, {conserved}, singular, [&] {
      const VecX<double> computed = o[op::tree_aba](c.q, c.v, tau, -1, Vec<double, 6>::Zero());
      if (!oracles::all_finite(computed)) return r.outcome(conserved, 0, Outcome::not_finite);
      record_base_force<T>(c, r, tau, exact_list<T>(computed), M, roots);
    });
  }

  /// The exact force on the base at the acceleration a, which determines it even if M is singular.
  template <class T, class Case>
  static void record_base_force(const Case& c, Recorder& r, const VecX<double>& tau, const std::vector<T>& a,
                                const std::vector<T>& M, const std::vector<double>& roots) {
    const std::vector<double> w = moving_inverses(roots);
    oracles::TreeOf<T> weightless = c.exact.tree;
    oracles::TreeOf<double> rough = c.stored.tree;
    weightless.gravity = oracles::zero_vector<3, T>(), rough.gravity = {{0, 0, 0}};
    const oracles::TreeDynamics<T> there(weightless, c.poses(), c.exact.v, a);
    std::vector<T> base = there.torque();
    base.resize(6);
    const double terms =
        approximate(weighted_norm(M, products(w))) * approximate(weighted_norm(a, roots)) +
        weighted_size(oracles::TreeSizes<double>(rough, c.stored.q, c.stored.v, rough_list(a)).tau, w) +
        approximate(weighted_norm(exact_list<T>(tau), w));
    const std::vector<T> nothing(6, T(0));
    c.note(conserved, base, nothing);
    r.record(conserved, 0, weighted_error(r.scalar(), base, nothing, w, T(terms)));
  }
};

const RegisteredTreeLaw<TreeMomentum> registered_tree_momentum;

}  // namespace
}  // namespace liecheck::properties
