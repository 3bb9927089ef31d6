#include <correct/correct_lagrange.hpp>
#include <correct/correct_trees.hpp>

namespace liecheck::properties::correct {

// correct_lagrange_rates_float.cpp compiles them.
extern template auto DenseTree<float>::coriolis(const X&, const X&) const -> M;
extern template auto DenseTree<float>::momentum_derivatives(const X&, const X&, const X&, bool) const
    -> std::pair<M, M>;
extern template auto DenseTree<float>::frame_derivatives(const X&, const X&, const X&, Seen, bool) const
    -> std::pair<M, M>;

namespace {

const RegisteredTree<DenseTree, float> in_float;

}  // namespace
}  // namespace liecheck::properties::correct
