#include "fifty_digits.hpp"

namespace liecheck::test {

SE3<Digits50> exact_exp6(const Vector6<Digits50>& xi) {
  return exp6<Digits50>(Motion<Digits50>(xi));
}
Vector6<Digits50> exact_log6(const SE3<Digits50>& T) {
  return log6<Digits50>(T).to_vector();
}
Vector7<Digits50> exact_integrate(const Vector7<Digits50>& q, const Vector6<Digits50>& xi) {
  return integrateSE3<Digits50>(q, xi);
}
Vector6<Digits50> exact_difference(const Vector7<Digits50>& q0, const Vector7<Digits50>& q1) {
  return differenceSE3<Digits50>(q0, q1);
}
Matrix6<Digits50> exact_left_jacobian(const Vector6<Digits50>& xi) {
  return leftJacobian<Digits50>(Motion<Digits50>(xi));
}
Matrix6<Digits50> exact_Jlog6(const SE3<Digits50>& T) {
  return Jlog6<Digits50>(T);
}
Matrix6<Digits50> exact_left_jacobian_inverse(const Vector6<Digits50>& xi) {
  return leftJacobianInverse<Digits50>(Motion<Digits50>(xi));
}

}  // namespace liecheck::test
