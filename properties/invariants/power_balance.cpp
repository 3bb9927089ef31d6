// The power of the joint forces is the rate of change of the total energy.

#include <invariants/tree_law.hpp>

namespace liecheck::properties {
namespace {

class PowerBalance final : public TreeLaw<PowerBalance> {
 public:
  static constexpr Statement stated{
      .name = "power_balance",
      .law = "the power of joint forces is the energy's rate of change",
      .equation =
          "rnea(q, v, a)^T v = d/dt (T + V) = sum_i tr(X_i' J_i (X_i'' - g)^T) + sum_k armature_k v_k a_k",
      .source = "Goldstein 1980, section 2.6",
      .outputs = {op::tree_power[block::power]},
      .formed = {{&op::tree_power, {&op::tree_rnea}}}};

  template <class T, class Case>
  void of(const Operations& subject, const Case& c, Recorder& r) const {
    const TreeOperations<double> o = subject.tree(described(c.stored));
    if (!o[op::tree_rnea]) return;
    const VecX<double> tau = o[op::tree_rnea](c.q, c.v, c.a, -1, Vec<double, 6>::Zero());
    if (!oracles::all_finite(tau)) return r.outcome(op::tree_power[block::power], 0, Outcome::not_finite);
    T power(0);
    double terms = 0;
    const auto sizes = c.sizes(c.stored.v, c.stored.a);
    for (std::size_t k = 0; k < c.nv(); ++k) {
      power += oracles::exact<T>(tau[static_cast<int>(k)]) * c.exact.v[k];
      terms += sizes.tau[k] * std::fabs(c.stored.v[k]);
    }
    c.record(r, op::tree_power[block::power], std::vector<T>{power},
             {c.dynamics(c.exact.v, c.exact.a).energy_rate()}, {1}, terms, c.resolved());
  }
};

const RegisteredTreeLaw<PowerBalance> registered_power_balance;

}  // namespace
}  // namespace liecheck::properties
