// The mass matrix is symmetric and positive definite. Its columns are the torques of unit accelerations.

#include <invariants/tree_law.hpp>

namespace liecheck::properties {
namespace {

class MassMatrix final : public TreeLaw<MassMatrix> {
 public:
  static constexpr Output symmetric = op::crba_symmetric[block::matrix],
                          definite = op::crba_positive[block::matrix],
                          columns = op::crba_columns[block::matrix];
  static constexpr Statement stated{
      .name = "mass_matrix",
      .law =
          "the mass matrix is symmetric and positive definite, and its columns are the torques of unit "
          "accelerations",
      .equation =
          "M = M^T, x^T M x > 0, M e_k = rnea(q, 0, e_k) without gravity; norms of M_kl / sqrt(M_kk M_ll)",
      .source = "Featherstone 2008, chapter 6",
      .outputs = {symmetric, definite, columns},
      .formed = {{&op::crba_symmetric, {&op::tree_crba}},
                 {&op::crba_positive, {&op::tree_crba}},
                 {&op::crba_columns, {&op::tree_crba, &op::tree_rnea}}}};

  template <class T, class Case>
  void of(const Operations& subject, const Case& c, Recorder& r) const {
    Tree<double> weightless = described(c.stored);
    weightless.gravity = {{0, 0, 0}};
    const TreeOperations<double> o = subject.tree(weightless);
    if (!o[op::tree_crba]) return;
    const MatX<double> M = o[op::tree_crba](c.q);
    if (!oracles::all_finite(M)) {
      for (const Output& output : {symmetric, definite, columns}) r.outcome(output, 0, Outcome::not_finite);
      return;
    }
    const std::vector<T> still(c.nv(), T(0));
    const std::vector<T> exact = c.dynamics(still, still).mass();
    const std::vector<double> roots = mass_roots(exact, c.nv()), w = inverses(roots);
    const std::vector<double> at_rest(c.nv(), 0);
    const double terms = weighted_size(c.sizes(at_rest, at_rest).mass, products(w));
    const T size = weighted_norm(exact, products(w));
    const std::vector<T> stored = exact_list<T>(flat(M)),
                         transposed = exact_list<T>(flat(MatX<double>(M.transpose()))),
                         factor = oracles::positive_factor(exact, c.nv());
    // Ordinary code may compute M by columns, whose errors are those of their terms.
    c.note(symmetric, stored, transposed), c.note(definite, stored, exact);
    const T against = r.ordinary(symmetric) ? oracles::larger(size, T(terms)) : size;
    r.record(symmetric, 0, weighted_error(r.scalar(), transposed, stored, products(w), against));
    if (factor.empty()) {  // a massless body: M is only positive semidefinite
      r.outcome(definite, 0, Outcome::ill_posed);
    } else {
      const double inverse = inverse_size(factor, roots);
      const bool positive = !oracles::positive_factor(stored, c.nv()).empty();
      // The error of crba may be 16 eps times its terms. So a nearly singular matrix may become indefinite.
      r.record(definite, 0, positive ? 0 : std::numeric_limits<double>::infinity(),
               [&] { return 16 * inverse * terms; });
    }
    if (!o[op::tree_rnea]) return;
    const VecX<double> none = VecX<double>::Zero(c.q.size() ? static_cast<int>(c.nv()) : 0);
    MatX<double> by_columns(none.size(), none.size());
    for (int k = 0; k < none.size(); ++k)
      by_columns.col(k) =
          o[op::tree_rnea](c.q, none, VecX<double>::Unit(none.size(), k), -1, Vec<double, 6>::Zero());
    if (!oracles::all_finite(by_columns)) return r.outcome(columns, 0, Outcome::not_finite);
    const std::vector<T> torques = exact_list<T>(flat(by_columns));
    c.note(columns, stored, torques);
    r.record(columns, 0, weighted_error(r.scalar(), torques, stored, products(w), size),
             [&] { return terms / approximate(size); });
  }
};

const RegisteredTreeLaw<MassMatrix> registered_mass_matrix;

}  // namespace
}  // namespace liecheck::properties
