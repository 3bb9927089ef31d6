// Subject "textbook:half_angles" in float and double: the textbook's formulas in half angles h = theta/2, without a series
// and without a cutoff. `cost` compares a library with it: it shows what this repair alone would win. It runs only if it is
// named.
//
//     sin(theta)/theta = sin(h) cos(h)/h,  (1 - cos(theta))/theta^2 = (sin(h)/h)^2/2,
//     1/theta^2 - (1 + cos(theta))/(2 theta sin(theta)) = (1 - h cos(h)/sin(h))/theta^2,
//     log(v, w) = 2 atan2(|v|, w)/|v| v
//
// Source: Sola, Deray and Atchuthan 2018 (arXiv 1812.01537), eq. 105, 145 and 146, with 1 - cos(theta) = 2 sin(h)^2.

#include <subjects/textbook_subject.hpp>

namespace liecheck::properties {
namespace {

template <class S>
struct HalfAngles : TextbookSubject<S> {
  using Base = TextbookSubject<S>;
  using Base::sin, Base::cos, Base::atan2;
  using typename Base::V3, typename Base::V4, typename Base::V6, typename Base::V7, typename Base::M3;

  struct Half {
    S theta, h, s, c;  ///< theta, theta/2 and its sine and cosine
    explicit Half(const V3& phi) : theta(phi.norm()), h(theta / S(2)), s(sin(h)), c(cos(h)) {}
    bool zero() const { return !(h * h > S(0)); }
    S sine_over_h() const { return zero() ? S(1) : s / h; }
  };

  static V4 exp3_quaternion(const V3& phi) {
    const Half a(phi);
    V4 q;
    q << a.sine_over_h() / S(2) * phi, a.c;
    return q;
  }
  static M3 exp3_matrix(const V3& phi) {
    const Half a(phi);
    const M3 P = hat(phi);
    const S k = a.sine_over_h();
    return M3::Identity() + k * a.c * P + k * k / S(2) * P * P;
  }
  static V3 log3_quaternion(const V4& Q) {
    const V4 q = Q[3] < S(0) ? V4(-Q) : Q;
    const S n = q.template head<3>().norm();
    const S factor = n > S(0) ? S(2) * atan2(n, q[3]) / n : S(2);
    return factor * q.template head<3>();
  }
  static V3 log3_matrix(const M3& R) { return log3_quaternion(Base{}.quaternion_from_matrix(R)); }
  static M3 left_jacobian3(const V3& phi) {
    const Half a(phi);
    const M3 P = hat(phi);
    if (a.zero()) return M3::Identity() + P / S(2);
    const S k = a.sine_over_h();
    return M3::Identity() + k * k / S(2) * P + (S(1) - k * a.c) / (a.theta * a.theta) * P * P;
  }
  static M3 left_jacobian3_inverse(const V3& phi) {
    const Half a(phi);
    const M3 P = hat(phi);
    if (a.zero()) return M3::Identity() - P / S(2);
    return M3::Identity() - P / S(2) + (S(1) - a.h * a.c / a.s) / (a.theta * a.theta) * P * P;
  }
  static M3 right_jacobian3(const V3& phi) { return left_jacobian3(-phi); }
  static M3 right_jacobian3_inverse(const V3& phi) { return left_jacobian3_inverse(-phi); }
  static Pose<S> exp6(const V6& xi) { return Base::exp6_with(HalfAngles(), xi); }
  static V6 log6(const Pose<S>& T) { return Base::log6_with(HalfAngles(), T); }
  static V7 integrate(const V7& q, const V6& delta) { return Base::integrate_with(HalfAngles(), q, delta); }
  static V6 difference(const V7& q0, const V7& q1) { return Base::difference_with(HalfAngles(), q0, q1); }

  static TypedSubject<S> subject() {
    TypedSubject<S> s{"textbook:half_angles", "half angles", {}};
    auto& o = s.operations;
    o[op::exp3_quaternion] = exp3_quaternion;
    o[op::exp3_matrix] = exp3_matrix;
    o[op::log3_quaternion] = log3_quaternion;
    o[op::log3_matrix] = log3_matrix;
    o[op::left_jacobian3] = left_jacobian3;
    o[op::right_jacobian3] = right_jacobian3;
    o[op::left_jacobian3_inverse] = left_jacobian3_inverse;
    o[op::right_jacobian3_inverse] = right_jacobian3_inverse;
    o[op::exp6] = exp6;
    o[op::log6] = log6;
    o[op::integrate] = integrate;
    o[op::difference] = difference;
    return s;
  }
};

const Registered<float> in_float(HalfAngles<float>::subject());
const Registered<double> in_double(HalfAngles<double>::subject());

}  // namespace
}  // namespace liecheck::properties
