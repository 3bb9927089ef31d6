#pragma once
// The textbook's forms of representations, transforms and means, and the subject with every form and one cutoff.

#include <subjects/textbook.hpp>

namespace liecheck::properties {

template <class S>
struct TextbookSubject : Textbook<S> {
  using Base = Textbook<S>;
  using Base::sin, Base::cos, Base::acos, Base::sqrt, Base::small, Base::matrix, Base::product,
      Base::log3_quaternion, Base::integrate, Base::difference;
  using typename Base::V3, typename Base::V4, typename Base::V6, typename Base::V7, typename Base::M3,
      typename Base::M6;

  // Representations, as the articles print them.
  V4 quaternion_from_matrix(const M3& R) const {  // Shepperd 1978
    const S t = R.trace();
    V4 q;
    if (t > S(0)) {
      const S s = sqrt(t + S(1)) * S(2);
      q << (R(2, 1) - R(1, 2)) / s, (R(0, 2) - R(2, 0)) / s, (R(1, 0) - R(0, 1)) / s, s / S(4);
      return q;
    }
    int i = 0;
    R.diagonal().maxCoeff(&i);
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const S s = sqrt(S(1) + R(i, i) - R(j, j) - R(k, k)) * S(2);
    q[i] = s / S(4), q[j] = (R(j, i) + R(i, j)) / s, q[k] = (R(k, i) + R(i, k)) / s;
    q[3] = (R(k, j) - R(j, k)) / s;
    return q;
  }
  M3 matrix_from_quaternion(const V4& Q) const { return matrix(Q); }
  V4 quaternion_product(const V4& Q0, const V4& Q1) const { return product(Q0, Q1); }
  V4 quaternion_inverse(const V4& Q) const { return V4(-Q[0], -Q[1], -Q[2], Q[3]) / Q.squaredNorm(); }
  V4 axis_angle_from_quaternion(const V4& Q) const {
    const V3 phi = log3_quaternion(Q);
    const S angle = phi.norm();
    V4 pair(S(1), S(0), S(0), angle);
    if (angle > S(0)) pair.template head<3>() = phi / angle;
    return pair;
  }
  V4 axis_angle_from_matrix(const M3& R) const {
    return axis_angle_from_quaternion(quaternion_from_matrix(R));
  }
  V4 quaternion_from_axis_angle(const V3& axis, const S& angle) const {
    V4 q;
    q << sin(angle / S(2)) * axis, cos(angle / S(2));
    return q;
  }
  M3 matrix_from_axis_angle(const V3& axis, const S& angle) const {  // Rodrigues' formula
    const M3 N = hat(axis);
    return M3::Identity() + sin(angle) * N + (S(1) - cos(angle)) * N * N;
  }
  V3 gibbs_from_quaternion(const V4& Q) const { return Q.template head<3>() / Q[3]; }
  V4 quaternion_from_gibbs(const V3& g) const {
    return V4(g[0], g[1], g[2], S(1)) / sqrt(S(1) + g.squaredNorm());
  }
  V3 mrp_from_quaternion(const V4& Q) const {
    return Q[3] < S(0) ? V3(Q.template head<3>() / (Q[3] - S(1))) : V3(Q.template head<3>() / (Q[3] + S(1)));
  }
  V4 quaternion_from_mrp(const V3& s) const {
    const S square = s.squaredNorm();
    return V4(S(2) * s[0], S(2) * s[1], S(2) * s[2], S(1) - square) / (S(1) + square);
  }
  M3 gram_schmidt(const M3& A) const {
    M3 R = A;
    R.col(0).normalize();
    R.col(1) = (A.col(1) - R.col(0).dot(A.col(1)) * R.col(0)).normalized();
    R.col(2) =
        (A.col(2) - R.col(0).dot(A.col(2)) * R.col(0) - R.col(1).dot(A.col(2)) * R.col(1)).normalized();
    return R;
  }
  /// [[J, C], [0, J]].
  static M6 blocks(const M3& J, const M3& C) {
    M6 m = M6::Zero();
    m.template topLeftCorner<3, 3>() = m.template bottomRightCorner<3, 3>() = J;
    m.template topRightCorner<3, 3>() = C;
    return m;
  }
  M6 adjoint(const Pose<S>& X) const { return blocks(X.R, hat(X.p) * X.R); }
  M6 coadjoint(const Pose<S>& X) const {
    M6 m = blocks(X.R, M3::Zero());
    m.template bottomLeftCorner<3, 3>() = hat(X.p) * X.R;
    return m;
  }
  M6 small_adjoint(const V6& V) const {
    return blocks(hat(V3(V.template tail<3>())), hat(V3(V.template head<3>())));
  }
  M6 transport_covariance(const Pose<S>& X, const M6& Sigma) const {
    const M6 Ad = adjoint(X);
    return Ad * Sigma * Ad.transpose();
  }
  V7 screw_parameters(const V6& V) const {
    const V3 u = V.template head<3>(), omega = V.template tail<3>();
    V7 screw;
    screw << omega.normalized(), omega.dot(u) / omega.squaredNorm(), omega.cross(u) / omega.squaredNorm();
    return screw;
  }
  V7 interpolate(const V7& q0, const V7& q1, const S& t) const {
    return integrate(q0, t * difference(q0, q1));
  }
  S angle_between(const V3& a, const V3& b) const { return acos(std::max(S(-1), std::min(S(1), a.dot(b)))); }
  V3 slerp_directions(const V3& a, const V3& b, const S& t) const {
    const S theta = angle_between(a, b);
    if (small(theta)) return ((S(1) - t) * a + t * b).normalized();
    return (sin((S(1) - t) * theta) * a + sin(t * theta) * b) / sin(theta);
  }

  static constexpr double power_of_ten(int e) {  // correctly rounded for e >= -22
    double p = 1;
    for (int i = 0; i > e; --i) p *= 10;
    return 1 / p;
  }
  /// At<f, exponent>::call(...) calls the member function f with the cutoff 10^-exponent.
  template <auto f, int exponent, class F = decltype(f)>
  struct At;
  template <auto f, int exponent, class Part, class R, class... A>
  struct At<f, exponent, R (Part::*)(A...) const> {
    static R call(A... a) { return (TextbookSubject{{{}, power_of_ten(-exponent)}}.*f)(a...); }
  };

  template <int exponent, bool is_variant>
  static TypedSubject<S> make() {
    TypedSubject<S> s{is_variant ? "textbook:1e-" + std::to_string(exponent) : "textbook",
                      "cutoff 1e-" + std::to_string(exponent),
                      {}};
    auto& o = s.operations;
    o[op::exp3_quaternion] = At<&TextbookSubject::exp3_quaternion, exponent>::call;
    o[op::exp3_matrix] = At<&TextbookSubject::exp3_matrix, exponent>::call;
    o[op::log3_quaternion] = At<&TextbookSubject::log3_quaternion, exponent>::call;
    o[op::log3_matrix] = At<&TextbookSubject::log3_matrix, exponent>::call;
    o[op::exp6] = At<&TextbookSubject::exp6, exponent>::call;
    o[op::log6] = At<&TextbookSubject::log6, exponent>::call;
    o[op::left_jacobian3] = At<&TextbookSubject::left_jacobian3, exponent>::call;
    o[op::right_jacobian3] = At<&TextbookSubject::right_jacobian3, exponent>::call;
    o[op::left_jacobian3_inverse] = At<&TextbookSubject::left_jacobian3_inverse, exponent>::call;
    o[op::right_jacobian3_inverse] = At<&TextbookSubject::right_jacobian3_inverse, exponent>::call;
    o[op::left_jacobian6] = At<&TextbookSubject::left_jacobian6, exponent>::call;
    o[op::right_jacobian6] = At<&TextbookSubject::right_jacobian6, exponent>::call;
    o[op::left_jacobian6_inverse] = At<&TextbookSubject::left_jacobian6_inverse, exponent>::call;
    o[op::right_jacobian6_inverse] = At<&TextbookSubject::right_jacobian6_inverse, exponent>::call;
    o[op::integrate] = At<&TextbookSubject::integrate, exponent>::call;
    o[op::difference] = At<&TextbookSubject::difference, exponent>::call;
    o[op::d_integrate_arg0] = At<&TextbookSubject::d_integrate_arg0, exponent>::call;
    o[op::d_integrate_arg1] = At<&TextbookSubject::d_integrate_arg1, exponent>::call;
    o[op::d_difference_arg0] = At<&TextbookSubject::d_difference_arg0, exponent>::call;
    o[op::d_difference_arg1] = At<&TextbookSubject::d_difference_arg1, exponent>::call;
    o[op::compose] = At<&TextbookSubject::compose, exponent>::call;
    o[op::inverse] = At<&TextbookSubject::inverse, exponent>::call;
    o[op::act_point] = At<&TextbookSubject::act_point, exponent>::call;
    o[op::rotate_point] = At<&TextbookSubject::rotate_point, exponent>::call;
    o[op::relative_angle] = At<&TextbookSubject::relative_angle, exponent>::call;
    o[op::twist_angle] = At<&TextbookSubject::twist_angle, exponent>::call;
    o[op::slerp] = At<&TextbookSubject::slerp, exponent>::call;
    o[op::rotation_between] = At<&TextbookSubject::rotation_between, exponent>::call;
    o[op::euler_to_quaternion] = At<&TextbookSubject::euler_to_quaternion, exponent>::call;
    o[op::euler_to_matrix] = At<&TextbookSubject::euler_to_matrix, exponent>::call;
    o[op::euler_from_matrix] = At<&TextbookSubject::euler_from_matrix, exponent>::call;
    o[op::velocity_to_rate] = At<&TextbookSubject::velocity_to_rate, exponent>::call;
    o[op::rate_to_velocity] = At<&TextbookSubject::rate_to_velocity, exponent>::call;
    o[op::se2_exp] = At<&TextbookSubject::se2_exp, exponent>::call;
    o[op::se2_log] = At<&TextbookSubject::se2_log, exponent>::call;
    o[op::quaternion_from_matrix] = At<&TextbookSubject::quaternion_from_matrix, exponent>::call;
    o[op::matrix_from_quaternion] = At<&TextbookSubject::matrix_from_quaternion, exponent>::call;
    o[op::quaternion_product] = At<&TextbookSubject::quaternion_product, exponent>::call;
    o[op::quaternion_inverse] = At<&TextbookSubject::quaternion_inverse, exponent>::call;
    o[op::axis_angle_from_quaternion] = At<&TextbookSubject::axis_angle_from_quaternion, exponent>::call;
    o[op::axis_angle_from_matrix] = At<&TextbookSubject::axis_angle_from_matrix, exponent>::call;
    o[op::quaternion_from_axis_angle] = At<&TextbookSubject::quaternion_from_axis_angle, exponent>::call;
    o[op::matrix_from_axis_angle] = At<&TextbookSubject::matrix_from_axis_angle, exponent>::call;
    o[op::gibbs_from_quaternion] = At<&TextbookSubject::gibbs_from_quaternion, exponent>::call;
    o[op::quaternion_from_gibbs] = At<&TextbookSubject::quaternion_from_gibbs, exponent>::call;
    o[op::mrp_from_quaternion] = At<&TextbookSubject::mrp_from_quaternion, exponent>::call;
    o[op::quaternion_from_mrp] = At<&TextbookSubject::quaternion_from_mrp, exponent>::call;
    o[op::gram_schmidt] = At<&TextbookSubject::gram_schmidt, exponent>::call;
    o[op::adjoint] = At<&TextbookSubject::adjoint, exponent>::call;
    o[op::coadjoint] = At<&TextbookSubject::coadjoint, exponent>::call;
    o[op::small_adjoint] = At<&TextbookSubject::small_adjoint, exponent>::call;
    o[op::transport_covariance] = At<&TextbookSubject::transport_covariance, exponent>::call;
    o[op::screw_parameters] = At<&TextbookSubject::screw_parameters, exponent>::call;
    o[op::interpolate] = At<&TextbookSubject::interpolate, exponent>::call;
    o[op::angle_between] = At<&TextbookSubject::angle_between, exponent>::call;
    o[op::slerp_directions] = At<&TextbookSubject::slerp_directions, exponent>::call;
    return s;
  }
};

}  // namespace liecheck::properties
