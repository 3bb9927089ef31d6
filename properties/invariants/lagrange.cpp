// Inverse dynamics, the mass matrix and the energies agree with Lagrange's equations.

#include <invariants/tree_law.hpp>

namespace liecheck::properties {
namespace {

class Lagrange final : public TreeLaw<Lagrange> {
 public:
  static constexpr Output torque = op::tree_rnea[block::torque],
                          nonlinear = op::tree_nonlinear_effects[block::torque],
                          gravity = op::tree_gravity[block::torque], mass = op::tree_crba[block::matrix],
                          kinetic = op::tree_kinetic_energy[block::energy],
                          potential = op::tree_potential_energy[block::energy];
  static constexpr Statement stated{
      .name = "lagrange",
      .law = "inverse dynamics, the mass matrix and the energies agree with Lagrange's equations",
      .equation =
          "tau_k = sum_i tr(U_ik J_i (X_i'' - g)^T), M_kl = sum_i tr(U_ik J_i U_il^T), U_ik = dX_i/dq_k; "
          "norms of tau_k / sqrt(M_kk) and M_kl / sqrt(M_kk M_ll)",
      .source = "Uicker 1965; Paul 1981, chapter 6",
      .outputs = {torque, nonlinear, gravity, mass, kinetic, potential}};

  template <class T, class Case>
  void of(const Operations& subject, const Case& c, Recorder& r) const {
    const TreeOperations<double> o = subject.tree(described(c.stored));
    const std::vector<T> still(c.nv(), T(0));
    const auto moving = c.dynamics(c.exact.v, c.exact.a);
    const bool resolved = c.resolved();
    const std::vector<T> M = moving.mass();
    const std::vector<double> roots = mass_roots(M, c.nv()), w = inverses(roots);
    const std::vector<double> at_rest(c.nv(), 0);
    const auto torque_of = [&](const Output& output, const VecX<double>& computed,
                               const oracles::TreeDynamics<T>& d, const oracles::TreeSizes<double>& sizes,
                               bool pushed) {
      c.record(r, output, computed, pushed ? d.torque(c.exact.wrench) : d.torque(), w,
               weighted_size(sizes.tau, w), resolved);
    };
    const auto sizes = c.sizes(c.stored.v, c.stored.a, true);
    if (o[op::tree_rnea])
      torque_of(torque, o[op::tree_rnea](c.q, c.v, c.a, c.F_joint, c.F), moving, sizes, true);
    if (o[op::tree_nonlinear_effects])
      torque_of(nonlinear, o[op::tree_nonlinear_effects](c.q, c.v), c.dynamics(c.exact.v, still),
                c.sizes(c.stored.v, at_rest), false);
    if (o[op::tree_gravity])
      torque_of(gravity, o[op::tree_gravity](c.q), c.dynamics(still, still), c.sizes(at_rest, at_rest),
                false);
    if (o[op::tree_crba])
      c.record(r, mass, flat(o[op::tree_crba](c.q)), M, products(w), weighted_size(sizes.mass, products(w)),
               resolved);
    const std::vector<double> one{1};
    if (o[op::tree_kinetic_energy])
      c.record(r, kinetic, VecX<double>::Constant(1, o[op::tree_kinetic_energy](c.q, c.v)),
               {moving.kinetic_energy()}, one, sizes.kinetic, resolved);
    if (o[op::tree_potential_energy])
      c.record(r, potential, VecX<double>::Constant(1, o[op::tree_potential_energy](c.q)),
               {moving.potential_energy()}, one, sizes.potential, resolved);
  }
};

const RegisteredTreeLaw<Lagrange> registered_lagrange;

}  // namespace
}  // namespace liecheck::properties
