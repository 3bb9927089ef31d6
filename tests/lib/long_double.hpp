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

#define LIECHECK_LONG_DOUBLE_MODELS(EXTERN)                                           \
  EXTERN template class Model<Real>;                                                  \
  EXTERN template class Data<Real>;                                                   \
  EXTERN template Model<Real> Model<double>::cast<Real>() const;                      \
  EXTERN template VecL integrate<Real>(const Model<Real>&, const VecL&, const VecL&); \
  EXTERN template VecL difference<Real>(const Model<Real>&, const VecL&, const VecL&);
#define LIECHECK_LONG_DOUBLE_ALGORITHMS(EXTERN)                                                          \
  EXTERN template void forwardKinematics<Real>(const Model<Real>&, Data<Real>&, In<Real>);               \
  EXTERN template void forwardKinematics<Real>(const Model<Real>&, Data<Real>&, In<Real>, In<Real>);     \
  EXTERN template const Matrix6X<Real>& computeJointJacobians<Real>(const Model<Real>&, Data<Real>&,     \
                                                                    In<Real>);                           \
  EXTERN template const VecL& rnea<Real>(const Model<Real>&, Data<Real>&, In<Real>, In<Real>, In<Real>,  \
                                         External<Real>);                                                \
  EXTERN template const VecL& aba<Real>(const Model<Real>&, Data<Real>&, In<Real>, In<Real>, In<Real>,   \
                                        External<Real>);                                                 \
  EXTERN template Real computeKineticEnergy<Real>(const Model<Real>&, Data<Real>&, In<Real>, In<Real>);  \
  EXTERN template Real computePotentialEnergy<Real>(const Model<Real>&, Data<Real>&, In<Real>);          \
  EXTERN template Vector3<Real> centerOfMass<Real>(const Model<Real>&, Data<Real>&, In<Real>);           \
  EXTERN template Force<Real> computeCentroidalMomentum<Real>(const Model<Real>&, Data<Real>&, In<Real>, \
                                                              In<Real>);
LIECHECK_LONG_DOUBLE_MODELS(extern)
LIECHECK_LONG_DOUBLE_ALGORITHMS(extern)

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
