// The Coriolis matrix and the derivatives of momenta and of frames are compiled here, because correct_lagrange_*.cpp would need more than 1 GB.

#include <correct/correct_lagrange.hpp>

namespace liecheck::properties::correct {

template auto DenseTree<float>::coriolis(const X&, const X&) const -> M;
template auto DenseTree<float>::momentum_derivatives(const X&, const X&, const X&, bool) const
    -> std::pair<M, M>;
template auto DenseTree<float>::frame_derivatives(const X&, const X&, const X&, Seen, bool) const
    -> std::pair<M, M>;

}  // namespace liecheck::properties::correct
