// Explicit instantiations for float, declared extern in the headers. The derivatives are in a separate file,
// instantiations_derivatives.cpp, so that no file needs more than 1.2 GB to compile.

#include <liecheck/algorithms/aba.hpp>
#include <liecheck/algorithms/centroidal.hpp>
#include <liecheck/algorithms/energy.hpp>
#include <liecheck/algorithms/jacobians.hpp>

namespace liecheck {
template void forwardKinematics<float>(const Model<float>&, Data<float>&, In<float>);
template void forwardKinematics<float>(const Model<float>&, Data<float>&, In<float>, In<float>);
template void forwardKinematics<float>(const Model<float>&, Data<float>&, In<float>, In<float>, In<float>);
template void updateFramePlacements<float>(const Model<float>&, Data<float>&);
template const VectorX<float>& rnea<float>(const Model<float>&, Data<float>&, In<float>, In<float>, In<float>,
                                           External<float>);
template const VectorX<float>& nonLinearEffects<float>(const Model<float>&, Data<float>&, In<float>,
                                                       In<float>);
template const VectorX<float>& computeStaticTorque<float>(const Model<float>&, Data<float>&, In<float>,
                                                          External<float>);
template const VectorX<float>& computeGeneralizedGravity<float>(const Model<float>&, Data<float>&, In<float>);
template const Matrix6X<float>& computeJointJacobians<float>(const Model<float>&, Data<float>&, In<float>);
template const Matrix6X<float>& computeJointJacobiansTimeVariation<float>(const Model<float>&, Data<float>&,
                                                                          In<float>, In<float>);
template const MatrixX<float>& crba<float>(const Model<float>&, Data<float>&, In<float>);
template const MatrixX<float>& computeMinverse<float>(const Model<float>&, Data<float>&, In<float>);
template const VectorX<float>& aba<float>(const Model<float>&, Data<float>&, In<float>, In<float>, In<float>,
                                          External<float>);
template const float& computeKineticEnergy<float>(const Model<float>&, Data<float>&, In<float>, In<float>);
template const float& computePotentialEnergy<float>(const Model<float>&, Data<float>&, In<float>);
template const Vector3<float>& centerOfMass<float>(const Model<float>&, Data<float>&, In<float>);
template const Vector3<float>& centerOfMass<float>(const Model<float>&, Data<float>&, In<float>, In<float>);
template const Vector3<float>& centerOfMass<float>(const Model<float>&, Data<float>&, In<float>, In<float>,
                                                   In<float>);
template const Matrix6X<float>& computeCentroidalMap<float>(const Model<float>&, Data<float>&, In<float>);
template const Matrix3X<float>& jacobianCenterOfMass<float>(const Model<float>&, Data<float>&, In<float>);
template const Force<float>& computeCentroidalMomentum<float>(const Model<float>&, Data<float>&, In<float>,
                                                              In<float>);
template const Force<float>& computeCentroidalMomentumTimeVariation<float>(const Model<float>&, Data<float>&,
                                                                           In<float>, In<float>, In<float>);

}  // namespace liecheck
