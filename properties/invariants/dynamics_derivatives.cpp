// The derivatives of inverse and forward dynamics, times a direction d.

#include <invariants/tree_law.hpp>

namespace liecheck::properties {
namespace {

class DynamicsDerivatives final : public TreeLaw<DynamicsDerivatives> {
 public:
  static constexpr Output torque_q = op::rnea_derivatives[block::by_q],
                          torque_v = op::rnea_derivatives[block::by_v],
                          acceleration_q = op::aba_derivatives[block::by_q],
                          acceleration_v = op::aba_derivatives[block::by_v];
  static constexpr Statement stated{
      .name = "dynamics_derivatives",
      .law =
          "the derivatives of inverse and forward dynamics by q (along integrate) and by v, times a "
          "direction d",
      .equation =
          "(dtau/dq) d = d/dt rnea(q exp(t d), v, a), (dtau/dv) d = d/dt rnea(q, v + t d, a); dqdd/dq = "
          "-M^-1 dtau/dq at qdd, likewise by v; norms as in forward_dynamics",
      .source = "Carpentier & Mansard 2018",
      .outputs = {torque_q, torque_v, acceleration_q, acceleration_v}};

  template <class T, class Case>
  void of(const Operations& subject, const Case& c, Recorder& r) const {
    const std::vector<T> still(c.nv(), T(0));
    const std::vector<T>& d = c.exact.d;
    const TreeOperations<double> o = subject.tree(described(c.stored));
    const auto standing = c.dynamics(c.exact.v, still);
    const std::vector<T> M = standing.mass();
    const std::vector<double> roots = mass_roots(M, c.nv()), w = inverses(roots);
    const bool resolved = c.resolved(true);
    const auto by_q = [&](const std::vector<T>& a) {
      return c.dynamics(c.exact.v, a, d, still, still).torque_derivative(c.exact.wrench);
    };
    const std::vector<T> by_v =
        c.dynamics(c.exact.v, still, still, d, still).torque_derivative();  // for any a
    const auto sizes = [&](const std::vector<double>& a, bool q) {
      const std::vector<double> none(c.nv(), 0);
      return oracles::TreeSizes<oracles::Tangent>(c.stored.tree, c.stored.q, c.stored.v, a, c.stored.wrench,
                                                  q ? c.stored.d : none, q ? none : c.stored.d, true);
    };
    // If a derivative is zero, the oracle returns about 1e-30 times the function instead. Then the term with
    // 1e-12 makes kappa so large that the case is ill-posed.
    const double reach = weighted_size(c.stored.d, std::vector<double>(c.nv(), 1));
    const auto terms_of = [&](const oracles::TreeSizes<oracles::Tangent>& t) {
      std::vector<double> values;
      for (const oracles::Tangent& x : t.tau) values.push_back(x.x);
      return weighted_size(t.tau, w) + 1e-12 * reach * weighted_size(values, w);
    };
    if (o[op::rnea_derivatives]) {
      const auto [dq, dv] = o[op::rnea_derivatives](c.q, c.v, c.a, c.F_joint, c.F);
      const auto record = [&](const Output& output, const MatX<double>& J, const std::vector<T>& exact,
                              bool q) {
        if (!oracles::all_finite(J)) return r.outcome(output, 0, Outcome::not_finite);
        c.record(r, output, exact_product(J, d), exact, w, terms_of(sizes(c.stored.a, q)), resolved);
      };
      record(torque_q, dq, by_q(c.exact.a), true);
      record(torque_v, dv, by_v, false);
    }
    if (!o[op::aba_derivatives]) return;
    const oracles::Solver<T> solve(M, c.nv());
    if (!solve) {  // there is no acceleration to differentiate
      for (const Output& output : {acceleration_q, acceleration_v}) r.outcome(output, 0, Outcome::ill_posed);
      return;
    }
    std::vector<T> a = standing.torque(c.exact.wrench);
    for (std::size_t k = 0; k < a.size(); ++k) a[k] = c.exact.a[k] - a[k];
    a = solve(a);
    const double inverse = inverse_size(solve.factor(), roots);
    const std::vector<double> at_rest(c.nv(), 0);
    const double size = weighted_size(c.sizes(at_rest, at_rest).mass, products(w));
    const auto singular = [&] { return nearly_singular(r.scalar(), solve.factor(), roots, size); };
    solved(r, {acceleration_q, acceleration_v}, singular, [&] {
      const auto [dq, dv] = o[op::aba_derivatives](c.q, c.v, c.a, c.F_joint, c.F);
      // The error of the subject's own qdd enters the result through the derivative of M(q) qdd.
      const double a_error = inverse * weighted_size(c.sizes(c.stored.v, rough_list(a), true).tau, w);
      std::vector<double> a_moved(c.nv());
      for (std::size_t k = 0; k < a_moved.size(); ++k) a_moved[k] = a_error * w[k];
      const auto record = [&](const Output& output, const MatX<double>& J, std::vector<T> exact, bool q) {
        if (!oracles::all_finite(J)) return r.outcome(output, 0, Outcome::not_finite);
        for (T& x : exact) x = -x;
        exact = solve(exact);
        const double terms = size * approximate(weighted_norm(exact, roots)) +
                             terms_of(sizes(rough_list(a), q)) +
                             (q ? weighted_size(sizes(a_moved, q).tau, w) : 0);
        c.record(r, output, exact_product(J, d), exact, roots, inverse * terms, resolved);
      };
      record(acceleration_q, dq, by_q(a), true);
      record(acceleration_v, dv, by_v, false);
    });
  }
};

const RegisteredTreeLaw<DynamicsDerivatives> registered_dynamics_derivatives;

}  // namespace
}  // namespace liecheck::properties
