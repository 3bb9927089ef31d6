// Forward dynamics computes M^-1 (tau - h). It is the inverse function of inverse dynamics.

#include <invariants/tree_law.hpp>

namespace liecheck::properties {
namespace {

class ForwardDynamics final : public TreeLaw<ForwardDynamics> {
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
      .outputs = {acceleration, inverse, torque},
      .formed = {{&op::rnea_of_aba, {&op::tree_aba, &op::tree_rnea}}}};

  template <class T, class Case>
  void of(const Operations& subject, const Case& c, Recorder& r) const {
    const std::vector<T> still(c.nv(), T(0));
    const auto standing = c.dynamics(c.exact.v, still);
    const std::vector<T> M = standing.mass();
    const std::vector<double> roots = mass_roots(M, c.nv());
    const oracles::Solver<T> solve(M, c.nv());
    const TreeOperations<double> o = subject.tree(described(c.stored));
    if (!solve)
      of_singular(o, c, r, M, roots);
    else
      of_regular(o, c, r, standing.torque(c.exact.wrench), roots, solve);
  }

 private:
  template <class T, class Case>
  static void of_regular(const TreeOperations<double>& o, const Case& c, Recorder& r, const std::vector<T>& h,
                         const std::vector<double>& roots, const oracles::Solver<T>& solve) {
    const std::vector<T>& tau = c.exact.a;
    const std::vector<double> w = inverses(roots);
    std::vector<T> a = h, inverse_exact(c.nv() * c.nv(), T(0));
    for (std::size_t k = 0; k < a.size(); ++k) a[k] = tau[k] - a[k];
    a = solve(a);
    for (std::size_t k = 0; k < c.nv(); ++k) {
      std::vector<T> e(c.nv(), T(0));
      e[k] = T(1);
      e = oracles::solve(solve.factor(), e);
      std::copy(e.begin(), e.end(), inverse_exact.begin() + static_cast<std::ptrdiff_t>(k * c.nv()));
    }
    const std::vector<double> at_rest(c.nv(), 0);
    const double size = weighted_size(c.sizes(at_rest, at_rest).mass, products(w)),
                 size_inverse = weighted_norm(rough_list(inverse_exact), products(roots));
    const double a_size = approximate(weighted_norm(a, roots));
    const double terms = size * a_size + approximate(weighted_norm(tau, w)) +
                         weighted_size(c.sizes(c.stored.v, rough_list(a), true).tau, w);
    const auto nearly_singular = [&] { return !(64 * size * size_inverse * r.scalar().epsilon < 1); };
    const bool resolved = c.resolved();
    if (o[op::tree_aba])
      solved(r, outputs_of_aba(o), nearly_singular, [&] {
        const VecX<double> computed = o[op::tree_aba](c.q, c.v, c.a, c.F_joint, c.F);
        c.record(r, acceleration, computed, a, roots, size_inverse * terms, resolved);
        if (o[op::tree_rnea])
          c.record(r, torque, o[op::tree_rnea](c.q, c.v, computed, c.F_joint, c.F), tau, w, terms, resolved);
      });
    if (o[op::tree_mass_inverse])
      solved(r, {inverse}, nearly_singular, [&] {
        c.record(r, inverse, flat(o[op::tree_mass_inverse](c.q)), inverse_exact, products(roots),
                 size * size_inverse * size_inverse, resolved);
      });
  }

  static Few<Output, 2> outputs_of_aba(const TreeOperations<double>& o) {
    if (o[op::tree_rnea]) return {acceleration, torque};
    return {acceleration};
  }

  /// M has no inverse, and the equation M a = tau - h may have no solution: every output is ill-posed. But an
  /// acceleration that the subject returns is judged by the residual of the coordinates that have an inertia.
  /// A backward stable solution leaves a few eps of the terms there, as in the regular case.
  template <class T, class Case>
  static void of_singular(const TreeOperations<double>& o, const Case& c, Recorder& r,
                          const std::vector<T>& M, const std::vector<double>& roots) {
    if (o[op::tree_mass_inverse]) r.outcome(inverse, 0, Outcome::ill_posed);
    if (!o[op::tree_aba]) return;
    for (const Output& output : outputs_of_aba(o)) r.outcome(output, 0, Outcome::ill_posed);
    VecX<double> computed;
    try {
      computed = o[op::tree_aba](c.q, c.v, c.a, c.F_joint, c.F);
    } catch (const std::domain_error&) {
      return;
    }
    if (!oracles::all_finite(computed)) return r.outcome(acceleration, 0, Outcome::not_finite);
    if (!c.resolved()) return r.outcome(acceleration, 0, Outcome::unresolved);
    const std::vector<T> a = exact_list<T>(computed);
    const std::vector<double> w = moving_inverses(roots);
    const double terms = approximate(weighted_norm(M, products(w))) * approximate(weighted_norm(a, roots)) +
                         approximate(weighted_norm(c.exact.a, w)) +
                         weighted_size(c.sizes(c.stored.v, rough_list(a), true).tau, w);
    constexpr auto one = [] { return 1.0; };
    std::vector<T> residual = c.dynamics(c.exact.v, a).torque(c.exact.wrench);
    for (std::size_t k = 0; k < residual.size(); ++k) residual[k] -= c.exact.a[k];
    const std::vector<T> nothing(c.nv(), T(0));
    r.record(acceleration, 0, weighted_error(r.scalar(), residual, nothing, w, T(terms)), one);
  }
};

const RegisteredTreeLaw<ForwardDynamics> registered_forward_dynamics;

}  // namespace
}  // namespace liecheck::properties
