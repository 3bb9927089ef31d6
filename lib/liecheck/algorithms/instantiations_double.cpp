// Explicit instantiations for double, declared extern in the headers.

#include <liecheck/algorithms/centroidal.hpp>
#include <liecheck/algorithms/derivatives.hpp>
#include <liecheck/algorithms/energy.hpp>
#include <liecheck/algorithms/jacobians.hpp>

namespace liecheck {
template void forwardKinematics(const Model<double>&, Data<double>&, In<double>);
template void forwardKinematics(const Model<double>&, Data<double>&, In<double>, In<double>);
template void forwardKinematics(const Model<double>&, Data<double>&, In<double>, In<double>, In<double>);
template decltype(rnea<double>) rnea<double>;
template decltype(nonLinearEffects<double>) nonLinearEffects<double>;
template decltype(computeJointJacobians<double>) computeJointJacobians<double>;
template decltype(computeJointJacobiansTimeVariation<double>) computeJointJacobiansTimeVariation<double>;
template decltype(crba<double>) crba<double>;
template decltype(computeMinverse<double>) computeMinverse<double>;
template decltype(aba<double>) aba<double>;
template decltype(algorithms_detail::bodiesInWorldAxes<double>) algorithms_detail::bodiesInWorldAxes<double>;
template decltype(algorithms_detail::articulatedBodies<double>) algorithms_detail::articulatedBodies<double>;
template decltype(computeCentroidalMap<double>) computeCentroidalMap<double>;
template decltype(computeCentroidalMomentum<double>) computeCentroidalMomentum<double>;
template decltype(computeRNEADerivatives<double>) computeRNEADerivatives<double>;
template decltype(computeABADerivatives<double>) computeABADerivatives<double>;

}  // namespace liecheck
