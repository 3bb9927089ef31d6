#pragma once
// The algorithms in long double, in which several tests differentiate: compiled once, in long_double*.cpp.

#include <liecheck/algorithms/aba.hpp>
#include <liecheck/algorithms/centroidal.hpp>
#include <liecheck/algorithms/energy.hpp>
#include <liecheck/algorithms/jacobians.hpp>
#include <liecheck/multibody/configuration.hpp>

namespace liecheck {

using Real = long double;
using VecL = VectorX<Real>;

extern template class Model<Real>;
extern template class Data<Real>;
extern template Model<Real> Model<double>::cast<Real>() const;
extern template VectorX<Real> integrate<Real>(const Model<Real>&, const VectorX<Real>&, const VectorX<Real>&);
extern template VectorX<Real> difference<Real>(const Model<Real>&, const VectorX<Real>&,
                                               const VectorX<Real>&);
extern template void forwardKinematics<Real>(const Model<Real>&, Data<Real>&, In<Real>);
extern template void forwardKinematics<Real>(const Model<Real>&, Data<Real>&, In<Real>, In<Real>);
extern template const Matrix6X<Real>& computeJointJacobians<Real>(const Model<Real>&, Data<Real>&, In<Real>);
extern template const VectorX<Real>& rnea<Real>(const Model<Real>&, Data<Real>&, In<Real>, In<Real>, In<Real>,
                                                External<Real>);
extern template const VectorX<Real>& aba<Real>(const Model<Real>&, Data<Real>&, In<Real>, In<Real>, In<Real>,
                                               External<Real>);
extern template const Real& computeKineticEnergy<Real>(const Model<Real>&, Data<Real>&, In<Real>, In<Real>);
extern template const Real& computePotentialEnergy<Real>(const Model<Real>&, Data<Real>&, In<Real>);
extern template const Vector3<Real>& centerOfMass<Real>(const Model<Real>&, Data<Real>&, In<Real>);
extern template const Force<Real>& computeCentroidalMomentum<Real>(const Model<Real>&, Data<Real>&, In<Real>,
                                                                   In<Real>);

}  // namespace liecheck
