#pragma once
// The oracles in ball arithmetic: closed_forms.hpp is used for the functions of exp.hpp, log.hpp,
// integrate.hpp, jacobians.hpp, kinematics.hpp and spatial.hpp. The radius of a result is a proved bound of
// its error, so that every result is resolved. If a comparison cannot be decided, Undecided is thrown. The
// functions are overloads of the oracles at 100 digits, so that a law is written once. A campaign uses these
// fast oracles first.

#include <oracles/exp.hpp>
#include <oracles/integrate.hpp>
#include <oracles/jacobians.hpp>
#include <oracles/kinematics.hpp>
#include <oracles/spatial.hpp>

namespace liecheck::oracles {

template <BallNumber T>
ExpValue<T> exp_se3(const Vec6<T>& xi);
template <BallNumber T>
ExpValue<T> exp_so3(const Vec3<T>& phi) {
  return exp_se3(stack(zero_vector<3, T>(), phi));
}
template <BallNumber T>
LogValue<T> log_se3(const Quaternion<T>& Q, const Vec3<T>& p);
template <BallNumber T>
LogValue<T> log_so3(const Quaternion<T>& Q) {
  return log_se3(Q, zero_vector<3, T>());
}
/// Throws Undecided unless ||R^T R - I|| < 1/100.
template <BallNumber T>
LogValue<T> log_se3_matrix(const Mat3<T>& R, const Vec3<T>& p);

template <BallNumber T>
IntegrateValue<T> integrate(const Vec7<T>& q0, const Vec6<T>& delta);
template <BallNumber T>
DifferenceValue<T> difference(const Vec7<T>& q0, const Vec7<T>& q1);

template <BallNumber T>
Jacobian6Value<T> left_jacobian_se3(const Vec6<T>& xi);
template <BallNumber T>
Jacobian6Value<T> left_jacobian_se3_inverse(const Vec6<T>& xi);

/// J_r(xi) = J_l(-xi) has the transposed blocks of J_l(xi): [phi] and [rho] change sign, but their symmetric
/// products do not.
template <BallNumber T>
Jacobian6Value<T> transposed(const Jacobian6Value<T>& left) {
  return {transpose(left.J), transpose(left.C), left.resolved};
}
template <BallNumber T>
Jacobian6Value<T> right_jacobian_se3(const Vec6<T>& xi) {
  return transposed(left_jacobian_se3(xi));
}
template <BallNumber T>
Jacobian6Value<T> right_jacobian_se3_inverse(const Vec6<T>& xi) {
  return transposed(left_jacobian_se3_inverse(xi));
}
template <BallNumber T>
Jacobian3Value<T> left_jacobian_so3(const Vec3<T>& phi) {
  return {left_jacobian_se3(stack(zero_vector<3, T>(), phi)).J, true};
}
template <BallNumber T>
Jacobian3Value<T> left_jacobian_so3_inverse(const Vec3<T>& phi) {
  return {left_jacobian_se3_inverse(stack(zero_vector<3, T>(), phi)).J, true};
}

/// d_integrate_arg0 is Ad(exp(-delta)) = [[R^T, -R^T [p]], [0, R^T]]; d_integrate_arg1 is J_r(delta).
template <BallNumber T>
Jacobian6Value<T> d_integrate_arg0(const Vec7<T>& q, const Vec6<T>& delta);
template <BallNumber T>
Jacobian6Value<T> d_integrate_arg1(const Vec7<T>&, const Vec6<T>& delta) {
  return right_jacobian_se3(delta);
}
/// The four 6x6 Jacobians of one twist. In ball arithmetic the right ones are transposes of the left ones.
template <class T>
struct Jacobians {
  Jacobian6Value<T> left, right, left_inverse, right_inverse;
  explicit Jacobians(const Vec6<T>& xi)
      : left(left_jacobian_se3(xi)), left_inverse(left_jacobian_se3_inverse(xi)) {
    if constexpr (BallNumber<T>) {
      right = transposed(left), right_inverse = transposed(left_inverse);
    } else {
      right = right_jacobian_se3(xi), right_inverse = right_jacobian_se3_inverse(xi);
    }
  }
};

/// d_difference_arg0 is -J_l^-1 of difference(q0, q1); d_difference_arg1 is J_r^-1 of it.
template <BallNumber T>
Jacobian6Value<T> d_difference_arg0(const Vec7<T>& q0, const Vec7<T>& q1);
template <BallNumber T>
Jacobian6Value<T> d_difference_arg1(const Vec7<T>& q0, const Vec7<T>& q1);

template <BallNumber T>
RateValue<T> configuration_rate(const Vec7<T>& q, const Vec6<T>& v);
template <BallNumber T>
CoefficientJacobianValue<T> integrate_coefficient_jacobian(const Vec7<T>& q);

template <BallNumber T>
Resolved<Vec3<T>> rotate_point(const Quaternion<T>& Q, const Vec3<T>& x) {
  return {rotate(Q, x), true};
}
template <BallNumber T>
Resolved<Vec3<T>> act_point(const PoseOf<T>& X, const Vec3<T>& x) {
  return {X.R * x + X.p, true};
}
template <BallNumber T>
Resolved<Vec3<T>> act_inverse_point(const PoseOf<T>& X, const Vec3<T>& x) {
  return {transpose(X.R) * (x - X.p), true};
}
template <BallNumber T>
Resolved<Vec6<T>> act_motion(const PoseOf<T>& X, const Vec6<T>& V) {
  return {formulas::act_motion(X, V), true};
}
template <BallNumber T>
Resolved<Vec6<T>> act_inverse_motion(const PoseOf<T>& X, const Vec6<T>& V) {
  return {formulas::act_inverse_motion(X, V), true};
}
template <BallNumber T>
Resolved<Vec6<T>> act_force(const PoseOf<T>& X, const Vec6<T>& F) {
  return {formulas::act_force(X, F), true};
}
template <BallNumber T>
Resolved<Vec6<T>> act_inverse_force(const PoseOf<T>& X, const Vec6<T>& F) {
  return {formulas::act_inverse_force(X, F), true};
}
template <BallNumber T>
Resolved<Vec6<T>> cross_motion(const Vec6<T>& V, const Vec6<T>& W) {
  return {formulas::cross_motion(V, W), true};
}
template <BallNumber T>
Resolved<Vec6<T>> cross_force(const Vec6<T>& V, const Vec6<T>& F) {
  return {formulas::cross_force(V, F), true};
}
template <BallNumber T>
Resolved<BodyOf<T>> act_inertia(const PoseOf<T>& X, const BodyOf<T>& I) {
  return {formulas::act_inertia(X, I), true};
}
template <BallNumber T>
Resolved<BodyOf<T>> act_inverse_inertia(const PoseOf<T>& X, const BodyOf<T>& I) {
  return {formulas::act_inverse_inertia(X, I), true};
}
template <BallNumber T>
Resolved<Mat6<T>> inertia_matrix(const BodyOf<T>& I) {
  return {formulas::inertia_matrix(I), true};
}
template <BallNumber T>
Resolved<Vec6<T>> momentum(const BodyOf<T>& I, const Vec6<T>& V) {
  return {formulas::momentum(I, V), true};
}
template <BallNumber T>
Resolved<T> kinetic_energy(const BodyOf<T>& I, const Vec6<T>& V) {
  return {formulas::kinetic_energy(I, V), true};
}
template <BallNumber T>
Resolved<T> power(const Vec6<T>& F, const Vec6<T>& V) {
  return {formulas::power(F, V), true};
}

/// The quaternion of R's polar factor, with a positive largest component. Throws Undecided unless
/// ||R^T R - I|| < 1/100.
template <BallNumber T>
Quaternion<T> nearest_quaternion(const Mat3<T>& R);

}  // namespace liecheck::oracles
