#include "long_double.hpp"

namespace liecheck {

template void forwardKinematics<Real>(const Model<Real>&, Data<Real>&, In<Real>);
template void forwardKinematics<Real>(const Model<Real>&, Data<Real>&, In<Real>, In<Real>);
template const Matrix6X<Real>& computeJointJacobians<Real>(const Model<Real>&, Data<Real>&, In<Real>);
template const VectorX<Real>& rnea<Real>(const Model<Real>&, Data<Real>&, In<Real>, In<Real>, In<Real>,
                                         External<Real>);
template const VectorX<Real>& aba<Real>(const Model<Real>&, Data<Real>&, In<Real>, In<Real>, In<Real>,
                                        External<Real>);
template Real computeKineticEnergy<Real>(const Model<Real>&, Data<Real>&, In<Real>, In<Real>);
template Real computePotentialEnergy<Real>(const Model<Real>&, Data<Real>&, In<Real>);
template Vector3<Real> centerOfMass<Real>(const Model<Real>&, Data<Real>&, In<Real>);
template Force<Real> computeCentroidalMomentum<Real>(const Model<Real>&, Data<Real>&, In<Real>, In<Real>);

}  // namespace liecheck
