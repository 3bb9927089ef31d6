#pragma once
// The closed forms as books print them, with one cutoff, 1e-8, for every scalar.

#include <subjects/typed.hpp>

#include <Eigen/Dense>
#include <cmath>
#include <string>

namespace liecheck::properties {

template <class S>
struct Textbook : Types<S> {
  /// Below this angle [rad], the leading term of the series replaces the closed form.
  double cutoff;

  using typename Types<S>::V3, typename Types<S>::V4, typename Types<S>::V6, typename Types<S>::V7,
      typename Types<S>::M3, typename Types<S>::M6;

  static S sin(const S& x) {
    using std::sin;
    return sin(x);
  }
  static S cos(const S& x) {
    using std::cos;
    return cos(x);
  }
  static S acos(const S& x) {
    using std::acos;
    return acos(x);
  }
  static S asin(const S& x) {
    using std::asin;
    return asin(x);
  }
  static S atan2(const S& y, const S& x) {
    using std::atan2;
    return atan2(y, x);
  }
  static S abs(const S& x) {
    using std::abs;
    return abs(x);
  }
  static S sqrt(const S& x) {
    using std::sqrt;
    return sqrt(x);
  }
  bool small(const S& theta) const { return theta < S(cutoff); }

  V4 exp3_quaternion(const V3& phi) const {
    const S theta = phi.norm();
    V4 q;
    if (small(theta)) {
      q << phi / S(2), S(1);
    } else {
      q << sin(theta / S(2)) / theta * phi, cos(theta / S(2));
    }
    return q;
  }
  M3 exp3_matrix(const V3& phi) const {
    const S theta = phi.norm();
    if (small(theta)) return M3::Identity() + hat(phi);
    const M3 P = hat(phi);
    return M3::Identity() + sin(theta) / theta * P + (S(1) - cos(theta)) / (theta * theta) * P * P;
  }
  V3 log3_quaternion(const V4& Q) const {
    const V4 q = Q[3] < S(0) ? V4(-Q) : Q;
    const S theta = S(2) * acos(std::min(S(1), q[3]));
    if (small(theta)) return S(2) * q.template head<3>();
    return theta / sqrt(S(1) - q[3] * q[3]) * q.template head<3>();
  }
  V3 log3_matrix(const M3& R) const {
    const S c = std::max(S(-1), std::min(S(1), S((R.trace() - S(1)) / S(2))));
    const S theta = acos(c);
    const V3 a(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
    if (small(theta)) return a / S(2);
    return theta / (S(2) * sin(theta)) * a;
  }
  M3 left_jacobian3(const V3& phi) const {
    const S theta = phi.norm();
    const M3 P = hat(phi);
    if (small(theta)) return M3::Identity() + P / S(2);
    return M3::Identity() + (S(1) - cos(theta)) / (theta * theta) * P +
           (theta - sin(theta)) / (theta * theta * theta) * P * P;
  }
  M3 left_jacobian3_inverse(const V3& phi) const {
    const S theta = phi.norm();
    const M3 P = hat(phi);
    if (small(theta)) return M3::Identity() - P / S(2);
    const S d = S(1) / (theta * theta) - (S(1) + cos(theta)) / (S(2) * theta * sin(theta));
    return M3::Identity() - P / S(2) + d * P * P;
  }
  M3 right_jacobian3(const V3& phi) const { return left_jacobian3(-phi); }
  M3 right_jacobian3_inverse(const V3& phi) const { return left_jacobian3_inverse(-phi); }

  /// Those on poses with the rotations of a form: its exp, log and Jacobians.
  template <class Form>
  static Pose<S> exp6_with(const Form& f, const V6& xi) {
    const V3 phi = xi.template tail<3>();
    return {f.exp3_matrix(phi), f.left_jacobian3(phi) * xi.template head<3>()};
  }
  template <class Form>
  static V6 log6_with(const Form& f, const Pose<S>& T) {
    const V3 phi = f.log3_matrix(T.R);
    V6 xi;
    xi << f.left_jacobian3_inverse(phi) * T.p, phi;
    return xi;
  }
  template <class Form>
  static V7 integrate_with(const Form& f, const V7& q, const V6& delta) {
    const V3 phi = delta.template tail<3>();
    const V4 Q = q.template tail<4>();
    V7 result;
    result << q.template head<3>() + matrix(Q) * (f.left_jacobian3(phi) * delta.template head<3>()),
        product(Q, f.exp3_quaternion(phi)).normalized();
    return result;
  }
  template <class Form>
  static V6 difference_with(const Form& f, const V7& q0, const V7& q1) {
    V4 inverse = q0.template tail<4>();
    inverse.template head<3>() *= S(-1);
    const V3 phi = f.log3_quaternion(product(inverse, q1.template tail<4>()));
    const V3 p = matrix(inverse) * (q1.template head<3>() - q0.template head<3>());
    V6 delta;
    delta << f.left_jacobian3_inverse(phi) * p, phi;
    return delta;
  }
  Pose<S> exp6(const V6& xi) const { return exp6_with(*this, xi); }
  V6 log6(const Pose<S>& T) const { return log6_with(*this, T); }

  /// Barfoot & Furgale (2014), eq. 102, as printed.
  M3 coupling(const V3& rho, const V3& phi) const {
    const M3 r = hat(rho), p = hat(phi);
    const S t = phi.norm();
    if (small(t)) return r / S(2);
    const S t2 = t * t, t3 = t2 * t, t4 = t2 * t2, t5 = t4 * t;
    const S a = (t - sin(t)) / t3;
    const S b = (S(1) - t2 / S(2) - cos(t)) / t4;
    const S c = b - S(3) * (t - sin(t) - t3 / S(6)) / t5;
    return r / S(2) + a * (p * r + r * p + p * r * p) - b * (p * p * r + r * p * p - S(3) * p * r * p) -
           c / S(2) * (p * r * p * p + p * p * r * p);
  }
  M6 left_jacobian6(const V6& xi) const {
    const V3 rho = xi.template head<3>(), phi = xi.template tail<3>();
    M6 J = M6::Zero();
    J.template topLeftCorner<3, 3>() = J.template bottomRightCorner<3, 3>() = left_jacobian3(phi);
    J.template topRightCorner<3, 3>() = coupling(rho, phi);
    return J;
  }
  M6 left_jacobian6_inverse(const V6& xi) const {
    const V3 rho = xi.template head<3>(), phi = xi.template tail<3>();
    const M3 Ji = left_jacobian3_inverse(phi);
    M6 J = M6::Zero();
    J.template topLeftCorner<3, 3>() = J.template bottomRightCorner<3, 3>() = Ji;
    J.template topRightCorner<3, 3>() = -Ji * coupling(rho, phi) * Ji;
    return J;
  }
  M6 right_jacobian6(const V6& xi) const { return left_jacobian6(-xi); }
  M6 right_jacobian6_inverse(const V6& xi) const { return left_jacobian6_inverse(-xi); }

  static V4 product(const V4& a, const V4& b) {
    const V3 av = a.template head<3>(), bv = b.template head<3>();
    V4 q;
    q << a[3] * bv + b[3] * av + av.cross(bv), a[3] * b[3] - av.dot(bv);
    return q;
  }
  static M3 matrix(const V4& q) { return Eigen::Quaternion<S>(q[3], q[0], q[1], q[2]).toRotationMatrix(); }
  V7 integrate(const V7& q, const V6& delta) const { return integrate_with(*this, q, delta); }
  V6 difference(const V7& q0, const V7& q1) const { return difference_with(*this, q0, q1); }
  M6 d_integrate_arg0(const V7&, const V6& delta) const {
    const Pose<S> T = exp6(-delta);
    M6 X = M6::Zero();
    X.template topLeftCorner<3, 3>() = X.template bottomRightCorner<3, 3>() = T.R;
    X.template topRightCorner<3, 3>() = hat(T.p) * T.R;
    return X;
  }
  M6 d_integrate_arg1(const V7&, const V6& delta) const { return right_jacobian6(delta); }
  M6 d_difference_arg0(const V7& q0, const V7& q1) const {
    return -left_jacobian6_inverse(difference(q0, q1));
  }
  M6 d_difference_arg1(const V7& q0, const V7& q1) const {
    return right_jacobian6_inverse(difference(q0, q1));
  }

  Pose<S> compose(const Pose<S>& X, const Pose<S>& Y) const { return {X.R * Y.R, X.R * Y.p + X.p}; }
  Pose<S> inverse(const Pose<S>& X) const { return {X.R.transpose(), -X.R.transpose() * X.p}; }
  V3 act_point(const Pose<S>& X, const V3& x) const { return X.R * x + X.p; }
  V3 rotate_point(const V4& Q, const V3& x) const { return matrix(Q) * x; }

  S relative_angle(const V4& Q0, const V4& Q1) const {
    return S(2) * acos(std::min(S(1), S(abs(Q0.dot(Q1)))));
  }
  S twist_angle(const V4& Q, const V3& axis) const {
    const V4 q = Q[3] < S(0) ? V4(-Q) : Q;
    return S(2) * atan2(axis.dot(q.template head<3>()), q[3]);
  }
  V4 slerp(const V4& Q0, const V4& Q1, const S& t) const {
    const S cosine = Q0.dot(Q1), half = acos(std::min(S(1), S(abs(cosine))));
    const S to = cosine < S(0) ? S(-1) : S(1);
    if (small(half)) return ((S(1) - t) * Q0 + to * t * Q1).normalized();
    return (sin((S(1) - t) * half) * Q0 + to * sin(t * half) * Q1) / sin(half);
  }
  V4 rotation_between(const V3& a, const V3& b) const {
    V4 q;
    q << a.cross(b), S(1) + a.dot(b);
    return q / q.norm();
  }
  /// Axes i, j, k and whether they rotate with the body.
  struct Axes {
    int i, j, k;
    bool rotating;
    explicit Axes(const S& order) {
      const int n = static_cast<int>(order), sequence = n / 2;
      const int first = sequence % 6 / 2, next = (first + 1) % 3, last = (first + 2) % 3;
      const bool forward = (sequence % 2 == 0) == (first != 1);  // YXZ comes before YZX
      i = first, j = forward ? next : last, k = sequence < 6 ? 3 - i - j : i, rotating = n % 2 == 1;
    }
  };
  static V4 about(int axis, const S& angle) {
    V4 q = V4::Zero();
    q[axis] = sin(angle / S(2)), q[3] = cos(angle / S(2));
    return q;
  }
  V4 euler_to_quaternion(const S& order, const V3& x) const {
    const Axes o(order);
    const V4 a = about(o.i, x[0]), b = about(o.j, x[1]), c = about(o.k, x[2]);
    return o.rotating ? product(product(a, b), c) : product(product(c, b), a);
  }
  M3 euler_to_matrix(const S& order, const V3& x) const { return matrix(euler_to_quaternion(order, x)); }
  /// Diebel (2006), section 8, by entries of the matrix.
  V3 euler_from_matrix(const S& order, const M3& R) const {
    const Axes o(order);
    const M3 M = o.rotating ? R : M3(R.transpose());  // of static axes: R_i(-a) R_j(-b) R_k(-c)
    const int i = o.i, j = o.j, k = 3 - i - j;
    const S sign((j - i + 3) % 3 == 1 ? 1 : -1);
    V3 x;
    if (o.i == o.k)
      x << atan2(M(j, i), -sign * M(k, i)), acos(std::max(S(-1), std::min(S(1), M(i, i)))),
          atan2(M(i, j), sign * M(i, k));
    else
      x << atan2(-sign * M(j, k), M(k, k)), asin(std::max(S(-1), std::min(S(1), sign * M(i, k)))),
          atan2(-sign * M(i, j), M(i, i));
    if (o.rotating) return x;
    // The middle angle of a proper sequence stays positive.
    return o.i == o.k ? V3(atan2(M(j, i), sign * M(k, i)), x[1], atan2(M(i, j), -sign * M(i, k))) : V3(-x);
  }
  V7 velocity_to_rate(const V7& q, const V6& V) const {
    V4 omega;
    omega << V.template tail<3>() / S(2), S(0);
    V7 rate;
    rate << matrix(q.template tail<4>()) * V.template head<3>(), product(q.template tail<4>(), omega);
    return rate;
  }
  V6 rate_to_velocity(const V7& q, const V7& rate) const {
    V4 inverse = q.template tail<4>();
    inverse.template head<3>() *= S(-1);
    V6 V;
    V << matrix(inverse) * rate.template head<3>(),
        S(2) * product(inverse, rate.template tail<4>()).template head<3>();
    return V;
  }
  V4 se2_exp(const V3& delta) const {
    const S t = delta[2], c = cos(t), s = sin(t);
    const bool near = small(abs(t));
    const S a = near ? S(1) : s / t, b = near ? t / S(2) : (S(1) - c) / t;
    return {a * delta[0] - b * delta[1], b * delta[0] + a * delta[1], c, s};
  }
  V3 se2_log(const V4& q) const {
    const S t = atan2(q[3], q[2]);
    const S a = small(abs(t)) ? S(1) : t / S(2) * sin(t) / (S(1) - cos(t)), b = t / S(2);
    return {a * q[0] + b * q[1], a * q[1] - b * q[0], t};
  }
};

}  // namespace liecheck::properties
