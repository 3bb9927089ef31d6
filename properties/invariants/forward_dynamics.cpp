// Forward dynamics computes M^-1 (tau - h). It is the inverse function of inverse dynamics.

#include <invariants/tree_law.hpp>

namespace liecheck::properties {
namespace {

template <class S>
class ForwardDynamics final : public TreeLaw<ForwardDynamics, S> {
 public:
  static constexpr Output acceleration = op::tree_aba[block::acceleration],
                          inverse = op::tree_mass_inverse[block::matrix],
                          torque = op::rnea_of_aba[block::torque];
  static constexpr Statement stated{
      .name = "forward_dynamics",
      .law = "forward dynamics is M^-1 (tau - h), and inverse dynamics is its inverse",
      .equation =
          "aba(tau) = M^-1 (tau - h), rnea(aba(tau)) = tau; with A = M_kl / sqrt(M_kk M_ll), norms of "
          "sqrt(M_kk) a_k and tau_k / sqrt(M_kk), terms = ||A|| ||a|| + ||tau|| + the terms of rnea: "
          "kappa = ||A^-1|| terms / ||a||, terms / ||tau||, ||A|| ||A^-1||",
      .source = "Featherstone 2008, chapters 6, 7; Demmel 1989 for the scaling",
      .outputs = {acceleration, inverse, torque}};

  template <class T, class Case>
  void of(const Operations<S>& subject, const Case& c, Recorder& r) const {
    const std::vector<T> still(c.nv(), T(0));
    const std::vector<T>& tau = c.exact.a;
    const auto standing = c.dynamics(c.exact.v, still);
    const std::vector<T> M = standing.mass();
    const std::vector<double> roots = mass_roots(M, c.nv()), w = inverses(roots);
    if (std::count(roots.begin(), roots.end(), 0.0) > 0) return;  // a massless link makes M singular
    const std::vector<T> factor = oracles::positive_factor(M, c.nv());
    if (factor.empty()) return;
    std::vector<T> a = standing.torque(c.exact.wrench), inverse_exact(M.size(), T(0));
    for (std::size_t k = 0; k < a.size(); ++k) a[k] = tau[k] - a[k];
    a = oracles::solve(factor, a);
    for (std::size_t k = 0; k < c.nv(); ++k) {
      std::vector<T> e = still;
      e[k] = T(1);
      e = oracles::solve(factor, e);
      std::copy(e.begin(), e.end(), inverse_exact.begin() + static_cast<std::ptrdiff_t>(k * c.nv()));
    }
    const std::vector<double> at_rest(c.nv(), 0);
    const double size = weighted_size(c.sizes(at_rest, at_rest).mass, products(w)),
                 size_inverse = approximate(weighted_norm(inverse_exact, products(roots)));
    const double a_size = approximate(weighted_norm(a, roots));
    const double terms = size * a_size + approximate(weighted_norm(tau, w)) +
                         weighted_size(c.sizes(c.rough.v, rough_list(a), true).tau, w);
    const bool singular = !(64 * size * size_inverse * std::numeric_limits<S>::epsilon() < 1);
    const bool resolved = c.resolved();
    try {
      const TreeOperations<S> o = subject.tree(described(c.stored));
      if (o[op::tree_aba]) {
        const VecX<S> computed = o[op::tree_aba](c.q, c.v, c.a, c.F_joint, c.F);
        c.record(r, acceleration, computed, a, roots, size_inverse * terms, resolved);
        if (o[op::tree_rnea])
          c.record(r, torque, o[op::tree_rnea](c.q, c.v, computed, c.F_joint, c.F), tau, w, terms, resolved);
      }
      if (o[op::tree_mass_inverse])
        c.record(r, inverse, flat(o[op::tree_mass_inverse](c.q)), inverse_exact, products(roots),
                 size * size_inverse * size_inverse, resolved);
    } catch (const std::domain_error&) {  // allowed if rounding may make M singular
      if (!singular) throw;
    }
  }
};

const RegisteredTreeLaw<ForwardDynamics> registered;

}  // namespace
}  // namespace liecheck::properties
