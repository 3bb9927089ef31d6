// The operational-space inertia of a frame: the inverse of J M^-1 J^T.

#include <invariants/tree_frames.hpp>

namespace liecheck::properties {
namespace {

class OperationalSpace final : public TreeLaw<OperationalSpace> {
 public:
  static constexpr bool floating = true;  // otherwise few trees have a Jacobian of rank 6
  static constexpr Output matrix = op::operational_inertia[block::matrix];
  static constexpr Statement stated{
      .name = "operational_space",
      .law = "the operational-space inertia of a frame inverts J M^-1 J^T",
      .equation = "Lambda = (J M^-1 J^T)^-1 in each reference, where J has rank 6",
      .source = "Khatib 1987, eq. 37",
      .outputs = {matrix}};

  template <class T, class Case>
  void of(const Operations& subject, const Case& c, Recorder& r) const {
    const TreeOperations<double> o = subject.tree(described(c.stored));
    if (!o[op::operational_inertia]) return;
    const std::vector<T> still(c.nv(), T(0));
    const std::vector<double> at_rest(c.nv(), 0);
    const std::vector<T> M = c.dynamics(still, still).mass();
    const std::vector<double> roots = mass_roots(M, c.nv()), w = inverses(roots);
    const oracles::Solver<T> solve(M, c.nv());
    const bool resolved = c.resolved();
    const double inverse = solve ? inverse_size(solve.factor(), roots) : 0,
                 mass_terms = inverse * weighted_size(c.sizes(at_rest, at_rest).mass, products(w));
    for_each_view([&](Seen view) {
      std::vector<std::vector<T>> rows(6, std::vector<T>(c.nv(), T(0)));
      std::array<double, 6> terms{};
      for (std::size_t k = 0; k < c.nv() && solve; ++k) {
        std::vector<T> e = still;
        std::vector<double> rough = at_rest;
        e[k] = T(1), rough[k] = 1;
        const oracles::FrameMotion<T> f(c.dynamics(e, still).motion(),
                                        static_cast<std::size_t>(c.exact.frame_joint), c.exact.frame_Q,
                                        c.exact.frame_p);
        const oracles::Vec6<T> V = seen_from(view, f).velocity;
        for (int i = 0; i < 6; ++i) rows[static_cast<std::size_t>(i)][k] = V[i];
        const auto sizes = oracles::TreeSizes<double>(c.stored.tree, c.stored.q, rough, at_rest)
                               .joints[static_cast<std::size_t>(c.stored.frame_joint)];
        const double lever = sizes.position + approximate(norm(c.exact.frame_p)),
                     linear = (sizes.u + sizes.w * lever) * w[k], angular = sizes.w * w[k];
        for (std::size_t i = 0; i < 6; ++i) terms[i] += i < 3 ? linear * linear : angular * angular;
      }
      std::vector<T> K(36, T(0));
      std::vector<double> scale(6, 0), inverses_of(6, 0);
      for (std::size_t j = 0; j < 6 && solve; ++j) {
        const std::vector<T> x = solve(rows[j]);
        for (std::size_t i = 0; i < 6; ++i)
          for (std::size_t k = 0; k < c.nv(); ++k) K[6 * i + j] += rows[i][k] * x[k];
      }
      for (std::size_t i = 0; i < 6; ++i) {
        const double d = approximate(K[7 * i]);
        scale[i] = d > 0 ? std::sqrt(d) : 0, inverses_of[i] = d > 0 ? 1 / scale[i] : 0;
      }
      const bool whole = std::ranges::all_of(scale, [](double d) { return d > 0; });
      const std::vector<T> factor = whole ? oracles::positive_factor(K, 6) : std::vector<T>();
      // The errors of J and M, relative to K with a unit diagonal.
      double J_terms = 1;
      for (std::size_t i = 0; i < 6 && whole; ++i)
        J_terms += std::sqrt(terms[i]) * inverses_of[i] * std::sqrt(inverse);
      const double growth = factor.empty() ? 0 : inverse_size(factor, scale),
                   kappa = growth * (J_terms + mass_terms);
      const auto singular = [&] { return factor.empty() || !(64 * kappa * r.scalar().epsilon < 1); };
      solved(r, {matrix}, singular, [&] {
        const Mat<double, 6> computed = o[op::operational_inertia](c.q, view);
        if (factor.empty()) return r.outcome(matrix, 0, Outcome::ill_posed);
        std::vector<T> exact(36);
        for (std::size_t j = 0; j < 6; ++j) {
          std::vector<T> e(6, T(0));
          e[j] = T(1);
          const std::vector<T> column = oracles::solve(factor, e);
          for (std::size_t i = 0; i < 6; ++i) exact[6 * i + j] = column[i];
        }
        const double size = approximate(weighted_norm(exact, products(scale)));
        c.record(r, matrix, flat(computed), exact, products(scale), kappa * size, resolved);
      });
    });
  }
};

const RegisteredTreeLaw<OperationalSpace> registered_operational_space;

}  // namespace
}  // namespace liecheck::properties
