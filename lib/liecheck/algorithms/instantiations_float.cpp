// Explicit instantiations for float, declared extern in the headers.

#include <liecheck/algorithms/centroidal.hpp>
#include <liecheck/algorithms/derivatives.hpp>
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
template decltype(computeRNEADerivatives<float>) computeRNEADerivatives<float>;
template decltype(computeABADerivatives<float>) computeABADerivatives<float>;

}  // namespace liecheck
