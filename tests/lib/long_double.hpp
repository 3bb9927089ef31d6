#pragma once
// The algorithms in long double, in which several tests differentiate: compiled once, in long_double.cpp and
// random_tree.cpp.

#include <functional>
#include <liecheck/algorithms/aba.hpp>
#include <liecheck/algorithms/centroidal.hpp>
#include <liecheck/algorithms/energy.hpp>
#include <liecheck/algorithms/jacobians.hpp>
#include <liecheck/multibody/configuration.hpp>

#include "random_tree.hpp"

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
extern template Real computeKineticEnergy<Real>(const Model<Real>&, Data<Real>&, In<Real>, In<Real>);
extern template Real computePotentialEnergy<Real>(const Model<Real>&, Data<Real>&, In<Real>);
extern template Vector3<Real> centerOfMass<Real>(const Model<Real>&, Data<Real>&, In<Real>);
extern template Force<Real> computeCentroidalMomentum<Real>(const Model<Real>&, Data<Real>&, In<Real>,
                                                            In<Real>);

namespace test {

/// q(t) with q' = v, v' = a at t = 0, in long double.
VecL along(const Model<Real>& m, const State& s, Real t);
/// The derivative of f at 0 by central differences of order 8 with step 1/1024. For a function that rotates
/// at w rad/s the relative truncation error is (w/1024)^8/630: 9e-16 for w = 30 (chains in which every joint
/// rotates). The rounding error is 1024 eps of f, 1e-16 in long double.
MatrixX<Real> derivative(const std::function<MatrixX<Real>(Real)>& f);
/// The second derivative of f at 0 by such differences. The rounding error is 2^20 eps, 1e-13 in long double.
MatrixX<Real> secondDerivative(const std::function<MatrixX<Real>(Real)>& f);

}  // namespace test
}  // namespace liecheck
