// Explicit instantiations for double, declared extern in the headers. The derivatives are in a separate file,
// instantiations_derivatives.cpp, so that no file needs more than 1.2 GB to compile.

#include <liecheck/algorithms/aba.hpp>
#include <liecheck/algorithms/centroidal.hpp>
#include <liecheck/algorithms/energy.hpp>
#include <liecheck/algorithms/jacobians.hpp>

namespace liecheck {
template void forwardKinematics<double>(const Model<double>&, Data<double>&, In<double>);
template void forwardKinematics<double>(const Model<double>&, Data<double>&, In<double>, In<double>);
template void forwardKinematics<double>(const Model<double>&, Data<double>&, In<double>, In<double>,
                                        In<double>);
template void updateFramePlacements<double>(const Model<double>&, Data<double>&);
template const VectorX<double>& rnea<double>(const Model<double>&, Data<double>&, In<double>, In<double>,
                                             In<double>, External<double>);
template const VectorX<double>& nonLinearEffects<double>(const Model<double>&, Data<double>&, In<double>,
                                                         In<double>);
template const VectorX<double>& computeStaticTorque<double>(const Model<double>&, Data<double>&, In<double>,
                                                            External<double>);
template const VectorX<double>& computeGeneralizedGravity<double>(const Model<double>&, Data<double>&,
                                                                  In<double>);
template const Matrix6X<double>& computeJointJacobians<double>(const Model<double>&, Data<double>&,
                                                               In<double>);
template const Matrix6X<double>& computeJointJacobiansTimeVariation<double>(const Model<double>&,
                                                                            Data<double>&, In<double>,
                                                                            In<double>);
template const MatrixX<double>& crba<double>(const Model<double>&, Data<double>&, In<double>);
template const MatrixX<double>& computeMinverse<double>(const Model<double>&, Data<double>&, In<double>);
template const VectorX<double>& aba<double>(const Model<double>&, Data<double>&, In<double>, In<double>,
                                            In<double>, External<double>);
template const double& computeKineticEnergy<double>(const Model<double>&, Data<double>&, In<double>,
                                                    In<double>);
template const double& computePotentialEnergy<double>(const Model<double>&, Data<double>&, In<double>);
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

}  // namespace liecheck
