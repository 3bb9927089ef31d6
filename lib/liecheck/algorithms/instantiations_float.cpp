// Explicit instantiations for float, declared extern in the headers. The derivatives are in a separate file,
// instantiations_derivatives.cpp, so that no file needs more than 1.2 GB to compile.

#include <liecheck/algorithms/aba.hpp>
#include <liecheck/algorithms/centroidal.hpp>
#include <liecheck/algorithms/energy.hpp>
#include <liecheck/algorithms/jacobians.hpp>

namespace liecheck {
template void forwardKinematics(const Model<float>&, Data<float>&, In<float>);
template void forwardKinematics(const Model<float>&, Data<float>&, In<float>, In<float>);
template void forwardKinematics(const Model<float>&, Data<float>&, In<float>, In<float>, In<float>);
template decltype(rnea<float>) rnea<float>;
template decltype(nonLinearEffects<float>) nonLinearEffects<float>;
template decltype(computeJointJacobians<float>) computeJointJacobians<float>;
template decltype(computeJointJacobiansTimeVariation<float>) computeJointJacobiansTimeVariation<float>;
template decltype(crba<float>) crba<float>;
template decltype(computeMinverse<float>) computeMinverse<float>;
template decltype(aba<float>) aba<float>;
template decltype(computeCentroidalMap<float>) computeCentroidalMap<float>;
template decltype(computeCentroidalMomentum<float>) computeCentroidalMomentum<float>;

}  // namespace liecheck
