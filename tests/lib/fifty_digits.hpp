#pragma once
// Functions at 50 digits, which are expensive to compile.

#include <boost/multiprecision/eigen.hpp>
#include <boost/multiprecision/mpfr.hpp>
#include <liecheck/multibody/se3_configuration.hpp>

namespace liecheck::test {

using Digits50 = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<50, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;

SE3<Digits50> exact_exp6(const Vector6<Digits50>& xi);
Vector6<Digits50> exact_log6(const SE3<Digits50>& T);
Vector7<Digits50> exact_integrate(const Vector7<Digits50>& q, const Vector6<Digits50>& xi);
Vector6<Digits50> exact_difference(const Vector7<Digits50>& q0, const Vector7<Digits50>& q1);
Matrix6<Digits50> exact_left_jacobian(const Vector6<Digits50>& xi);
Matrix6<Digits50> exact_Jlog6(const SE3<Digits50>& T);
Matrix6<Digits50> exact_left_jacobian_inverse(const Vector6<Digits50>& xi);

}  // namespace liecheck::test
