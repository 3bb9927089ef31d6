// float and double, compiled once; declared extern in the headers.

#include <liecheck/algorithms/centroidal.hpp>
#include <liecheck/algorithms/derivatives.hpp>
#include <liecheck/algorithms/energy.hpp>
#include <liecheck/algorithms/jacobians.hpp>

namespace liecheck {
template void forwardKinematics<float>(const Model<float>&, Data<float>&, In<float>);
template void forwardKinematics<float>(const Model<float>&, Data<float>&, In<float>, In<float>);
template void forwardKinematics<float>(const Model<float>&, Data<float>&, In<float>, In<float>, In<float>);
template void forwardKinematics<double>(const Model<double>&, Data<double>&, In<double>);
template void forwardKinematics<double>(const Model<double>&, Data<double>&, In<double>, In<double>);
template void forwardKinematics<double>(const Model<double>&, Data<double>&, In<double>, In<double>,
                                        In<double>);
template void updateFramePlacements<float>(const Model<float>&, Data<float>&);
template void updateFramePlacements<double>(const Model<double>&, Data<double>&);
template const VectorX<float>& rnea<float>(const Model<float>&, Data<float>&, In<float>, In<float>, In<float>,
                                           External<float>);
template const VectorX<float>& nonLinearEffects<float>(const Model<float>&, Data<float>&, In<float>,
                                                       In<float>);
template const VectorX<float>& computeStaticTorque<float>(const Model<float>&, Data<float>&, In<float>,
                                                          External<float>);
template const VectorX<float>& computeGeneralizedGravity<float>(const Model<float>&, Data<float>&, In<float>);
template const VectorX<double>& rnea<double>(const Model<double>&, Data<double>&, In<double>, In<double>,
                                             In<double>, External<double>);
template const VectorX<double>& nonLinearEffects<double>(const Model<double>&, Data<double>&, In<double>,
                                                         In<double>);
template const VectorX<double>& computeStaticTorque<double>(const Model<double>&, Data<double>&, In<double>,
                                                            External<double>);
template const VectorX<double>& computeGeneralizedGravity<double>(const Model<double>&, Data<double>&,
                                                                  In<double>);
template const Matrix6X<float>& computeJointJacobians<float>(const Model<float>&, Data<float>&, In<float>);
template const Matrix6X<float>& computeJointJacobiansTimeVariation<float>(const Model<float>&, Data<float>&,
                                                                          In<float>, In<float>);
template const Matrix6X<double>& computeJointJacobians<double>(const Model<double>&, Data<double>&,
                                                               In<double>);
template const Matrix6X<double>& computeJointJacobiansTimeVariation<double>(const Model<double>&,
                                                                            Data<double>&, In<double>,
                                                                            In<double>);
template const MatrixX<float>& crba<float>(const Model<float>&, Data<float>&, In<float>);
template const MatrixX<float>& computeMinverse<float>(const Model<float>&, Data<float>&, In<float>);
template const MatrixX<double>& crba<double>(const Model<double>&, Data<double>&, In<double>);
template const MatrixX<double>& computeMinverse<double>(const Model<double>&, Data<double>&, In<double>);
template const VectorX<float>& aba<float>(const Model<float>&, Data<float>&, In<float>, In<float>, In<float>,
                                          External<float>);
template const VectorX<double>& aba<double>(const Model<double>&, Data<double>&, In<double>, In<double>,
                                            In<double>, External<double>);
template const float& computeKineticEnergy<float>(const Model<float>&, Data<float>&, In<float>, In<float>);
template const float& computePotentialEnergy<float>(const Model<float>&, Data<float>&, In<float>);
template const double& computeKineticEnergy<double>(const Model<double>&, Data<double>&, In<double>,
                                                    In<double>);
template const double& computePotentialEnergy<double>(const Model<double>&, Data<double>&, In<double>);
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
template const Vector3<double>& centerOfMass<double>(const Model<double>&, Data<double>&, In<double>);
template const Vector3<double>& centerOfMass<double>(const Model<double>&, Data<double>&, In<double>,
                                                     In<double>);
template const Vector3<double>& centerOfMass<double>(const Model<double>&, Data<double>&, In<double>,
                                                     In<double>, In<double>);
template const Matrix6X<double>& computeCentroidalMap<double>(const Model<double>&, Data<double>&,
                                                              In<double>);
template const Matrix3X<double>& jacobianCenterOfMass<double>(const Model<double>&, Data<double>&,
                                                              In<double>);
template const Force<double>& computeCentroidalMomentum<double>(const Model<double>&, Data<double>&,
                                                                In<double>, In<double>);
template const Force<double>& computeCentroidalMomentumTimeVariation<double>(const Model<double>&,
                                                                             Data<double>&, In<double>,
                                                                             In<double>, In<double>);
template void computeRNEADerivatives<float>(const Model<float>&, Data<float>&, In<float>, In<float>,
                                            In<float>, External<float>);
template void computeABADerivatives<float>(const Model<float>&, Data<float>&, In<float>, In<float>, In<float>,
                                           External<float>);
template void computeRNEADerivatives<double>(const Model<double>&, Data<double>&, In<double>, In<double>,
                                             In<double>, External<double>);
template void computeABADerivatives<double>(const Model<double>&, Data<double>&, In<double>, In<double>,
                                            In<double>, External<double>);

}  // namespace liecheck
