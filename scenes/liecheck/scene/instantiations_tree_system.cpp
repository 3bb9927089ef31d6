#include <liecheck/scene/tree.hpp>

namespace liecheck::scene {
template Tree<double>::Tree(const Model<double>&, Effects<double>);
template void Tree<double>::load(const double&, const VectorX<double>&, const VectorX<double>&);
template void Tree<double>::equations(const VectorX<double>&, const VectorX<double>&, VectorX<double>&);
template void Tree<double>::accumulate(VectorX<double>&, VectorX<double>&, const VectorX<double>&) const;
template void Tree<double>::tangentRate(const VectorX<double>&, const VectorX<double>&,
                                        VectorX<double>&) const;
}  // namespace liecheck::scene
