#include <correct/correct_lagrange.hpp>
#include <correct/correct_trees.hpp>

namespace liecheck::properties::correct {

// correct_lagrange_rates_double.cpp compiles them.
extern template auto DenseTree<double>::coriolis(const X&, const X&) const -> M;
extern template auto DenseTree<double>::momentum_derivatives(const X&, const X&, const X&, bool) const
    -> std::pair<M, M>;
extern template auto DenseTree<double>::frame_derivatives(const X&, const X&, const X&, Seen, bool) const
    -> std::pair<M, M>;

namespace {

const RegisteredTree<DenseTree, double> in_double;

}  // namespace
}  // namespace liecheck::properties::correct
