#include <oracles/ball_oracles.hpp>

#include <oracles/closed_forms.hpp>

namespace liecheck::oracles {
namespace {

template <class T>
LogValue<T> log_value(const Quaternion<T>& Q, const Vec3<T>& p) {
  const T w = Q[3];
  LogValue<T> r;
  r.at_pi = w.exactly_zero();  // otherwise |w| exceeds its radius, or closed_log throws Undecided
  const Vec6<T> value = closed_log(Q, p);
  r.rho = head3(value), r.phi = tail3(value);
  const T s = norm(head3(Q));
  if (!r.at_pi && w.size() < 1e-50 * s.head()) throw Undecided();
  r.theta = norm(r.phi);
  r.pi_minus_theta = T(2) * atan2(abs(w), s);
  r.other = r.at_pi ? closed_log(-Q, p, true) : value;
  r.resolved = true;
  return r;
}

}  // namespace

template <BallNumber T>
ExpValue<T> exp_se3(const Vec6<T>& xi) {
  const T theta = norm(tail3(xi));
  const UnitPose<T> pose = closed_exp(xi, theta);
  return {pose.Q, pose.p, theta, true};
}

template <BallNumber T>
LogValue<T> log_se3(const Quaternion<T>& Q, const Vec3<T>& p) {
  return log_value(Q, p);
}

// The polar factor U = R (I + D)^(-1/2), D = R^T R - I, is approximated by X = R (I - D/2). Then U = X + R G
// with a symmetric G and ||G|| <= sum_{k>=2} binom(2k, k) 4^-k d^k < 0.4 d^2 for d = ||D|| < 1/100. Since G
// is symmetric, the antisymmetric part of R G is that of (R - I) G.
template <BallNumber T>
Quaternion<T> nearest_quaternion(const Mat3<T>& R) {
  Mat3<T> D = transpose(R) * R;
  for (int i = 0; i < 3; ++i) D(i, i) -= T(1);
  double square = 0, distance = 0;
  for (const T& x : D.x) square += (x.size() + x.r) * (x.size() + x.r);
  if (!(square < 1e-4)) throw Undecided();
  const double g = 0.45 * square;
  const Mat3<T> X = R - T(0.5) * (R * D);
  for (int i = 0; i < 9; ++i) {
    const double d = std::fabs(R.x[static_cast<std::size_t>(i)].head() - (i % 4 == 0 ? 1 : 0));
    distance += d * d;
  }
  const double skew = g * std::sqrt(distance) * (1 + 0x1p-40);
  const double diagonal[3] = {X(0, 0).head(), X(1, 1).head(), X(2, 2).head()};
  const double trace = diagonal[0] + diagonal[1] + diagonal[2];
  int pivot = 3;
  double largest = trace;
  for (int i = 0; i < 3; ++i)
    if (diagonal[i] > largest) largest = diagonal[i], pivot = i;
  const double bound = 1.1 * g;  // ||R|| < 1.1
  Quaternion<T> q;
  if (pivot == 3) {
    q[3] = sqrt(widened(T(1) + X(0, 0) + X(1, 1) + X(2, 2), 3 * bound)) / T(2);
    const Vec3<T> k = vee(X);
    for (int i = 0; i < 3; ++i) q[i] = widened(k[i], skew) / (T(2) * q[3]);
  } else {
    const int i = pivot, j = (i + 1) % 3, k = (i + 2) % 3;
    q[i] = sqrt(widened(T(1) + X(i, i) - X(j, j) - X(k, k), 3 * bound)) / T(2);
    const T by = T(4) * q[i];
    q[j] = widened(X(i, j) + X(j, i), 2 * bound) / by;
    q[k] = widened(X(i, k) + X(k, i), 2 * bound) / by;
    const bool symmetric =
        R(0, 1) == R(1, 0) && R(0, 2) == R(2, 0) && R(1, 2) == R(2, 1);  // theta is exactly pi
    q[3] = symmetric ? T(0) : widened(X(k, j) - X(j, k), 2 * skew) / by;
  }
  return q;
}

template <BallNumber T>
LogValue<T> log_se3_matrix(const Mat3<T>& R, const Vec3<T>& p) {
  return log_value(nearest_quaternion(R), p);
}

template <BallNumber T>
IntegrateValue<T> integrate(const Vec7<T>& q0, const Vec6<T>& delta) {
  const UnitPose<T> step = closed_exp(delta);
  const Quaternion<T> Q0 = quaternion_of(q0);
  return {quaternion_product(normalized(Q0), step.Q), head3(q0) + rotate(Q0, step.p), norm(tail3(delta)),
          norm(step.p), true};
}

template <BallNumber T>
DifferenceValue<T> difference(const Vec7<T>& q0, const Vec7<T>& q1) {
  const RelativePose<T> relative = relative_pose(q0, q1);
  return {log_value(relative.Q, relative.p), norm(relative.p1_minus_p0)};
}

template <BallNumber T>
Jacobian6Value<T> left_jacobian_se3(const Vec6<T>& xi) {
  const JacobianBlocks<T> b = closed_left_jacobian(xi);
  return {b.J, b.C, true};
}
template <BallNumber T>
Jacobian6Value<T> left_jacobian_se3_inverse(const Vec6<T>& xi) {
  const JacobianBlocks<T> b = closed_left_jacobian_inverse(xi);
  return {b.J, b.C, true};
}

template <BallNumber T>
Jacobian6Value<T> d_integrate_arg0(const Vec7<T>&, const Vec6<T>& delta) {
  const UnitPose<T> step = closed_exp(delta);
  const Mat3<T> Rt = transpose(rotation_matrix(step.Q));
  return {Rt, T(-1) * times_hat(Rt, step.p), true};
}
template <BallNumber T>
Jacobian6Value<T> d_difference_arg0(const Vec7<T>& q0, const Vec7<T>& q1) {
  const Jacobian6Value<T> J = left_jacobian_se3_inverse(closed_difference(q0, q1));
  return {T(-1) * J.J, T(-1) * J.C, true};
}
template <BallNumber T>
Jacobian6Value<T> d_difference_arg1(const Vec7<T>& q0, const Vec7<T>& q1) {
  return right_jacobian_se3_inverse(closed_difference(q0, q1));
}

template <BallNumber T>
RateValue<T> configuration_rate(const Vec7<T>& q, const Vec6<T>& v) {
  const Quaternion<T> Q = normalized(quaternion_of(q));
  const Mat3<T> R = rotation_matrix(Q);
  const Vec3<T> w = tail3(v);
  const Quaternion<T> omega{{w[0], w[1], w[2], T(0)}};
  return {R * head3(v), T(0.5) * quaternion_product(Q, omega), times_hat(R, w), true};
}

template <BallNumber T>
CoefficientJacobianValue<T> integrate_coefficient_jacobian(const Vec7<T>& q) {
  const Quaternion<T> Q = normalized(quaternion_of(q));
  const Mat3<T> R = rotation_matrix(Q), V = hat(head3(Q));
  Mat<7, 6, T> J = zeros<7, 6, T>();
  const T half(0.5);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      J(i, j) = R(i, j);
      J(3 + i, 3 + j) = half * (i == j ? Q[3] : V(i, j));
      J(6, 3 + j) = -(half * Q[j]);
    }
  return {J, true};
}

#define LIECHECK_BALL_ORACLES(T)                                                       \
  template ExpValue<T> exp_se3(const Vec6<T>&);                                        \
  template LogValue<T> log_se3(const Quaternion<T>&, const Vec3<T>&);                  \
  template LogValue<T> log_se3_matrix(const Mat3<T>&, const Vec3<T>&);                 \
  template IntegrateValue<T> integrate(const Vec7<T>&, const Vec6<T>&);                \
  template DifferenceValue<T> difference(const Vec7<T>&, const Vec7<T>&);              \
  template Jacobian6Value<T> left_jacobian_se3(const Vec6<T>&);                        \
  template Jacobian6Value<T> left_jacobian_se3_inverse(const Vec6<T>&);                \
  template Jacobian6Value<T> d_integrate_arg0(const Vec7<T>&, const Vec6<T>&);         \
  template Jacobian6Value<T> d_difference_arg0(const Vec7<T>&, const Vec7<T>&);        \
  template Jacobian6Value<T> d_difference_arg1(const Vec7<T>&, const Vec7<T>&);        \
  template RateValue<T> configuration_rate(const Vec7<T>&, const Vec6<T>&);            \
  template CoefficientJacobianValue<T> integrate_coefficient_jacobian(const Vec7<T>&); \
  template Quaternion<T> nearest_quaternion(const Mat3<T>&);
LIECHECK_BALL_ORACLES(DoubleBall)
LIECHECK_BALL_ORACLES(DoubleDoubleBall)

}  // namespace liecheck::oracles
