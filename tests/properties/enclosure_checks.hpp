#pragma once
// Compares two results of each operation of the oracles with an interval that contains the exact result: the
// value stored with 50 digits, and the closed form evaluated at 100 digits.

#include <oracles/closed_forms.hpp>
#include <oracles/exp.hpp>
#include <oracles/integrate.hpp>
#include <oracles/jacobians.hpp>
#include <string>

#include "difference_jacobian.hpp"
#include "enclosure_ledger.hpp"
#include "enclosure_se3.hpp"

namespace liecheck::enclosures {

using namespace oracles;

/// The allowed error of each block, relative to max(||exact||, scale) with the scale passed to near(). The
/// oracles promise 1e-41 (agreement.hpp), but 100 correct digits rounded to 168 bits err by 2^-168 = 2.7e-51.
inline constexpr double claim = 1e-50;
/// Negative control: Ledger::check adds an error of this many times the allowed one to each value. The
/// comparison must then fail. For `claim` this error is in the 49th digit.
inline constexpr double wrong = 10;

/// The allowed error of the closed forms at 100 digits (334 bits): 1e-98 (theta / d)^2 for an angle theta at
/// the distance d from 2 pi k (closed_forms.hpp).
inline double claim_at_100_digits(const Real& theta) {
  if (theta < 1) return 1e-98;
  if (theta > 1e25) return 1e-90;  // there closed_forms.hpp reduces theta with more than 334 bits
  const Real period = 2 * boost::math::constants::pi<Real>(), periods = round(Real(theta / period));
  const Real d = periods == 0 ? theta : abs(Real(theta - periods * period)),
             loss = d < 1 ? Real(theta / d) : theta;
  return 1e-98 * static_cast<double>(Real(loss * loss));
}

template <class T>
class Checks {
 public:
  explicit Checks(Ledger& ledger) : ledger_(ledger) {}

  void exp(const Vec6<>& xi) {
    const ExpResult r = exp_se3(xi);
    if (!r.resolved) ledger_.unresolved("exp");
    const Exp<T> e = enclosures::exp<T>(point<T>(xi));
    near("exp Q", e.Q, r.Q, T(1));
    if (r.theta <= Real(3.14159)) near("exp vector of Q", V3<T>(e.Q.template head<3>()), head3(r.Q));
    near("exp R", e.R, r.R, T(1));
    near("exp p", e.p, r.p);
    const UnitPose<Real100> closed = closed_exp(cast<Real100>(xi));
    const double digits = claim_at_100_digits(r.theta);
    near("exp Q at 100 digits", e.Q, closed.Q, T(1), digits);
    near("exp p at 100 digits", e.p, closed.p, T(0), digits);
  }

  void jacobians(const Vec6<>& xi) {
    const V6<T> x = point<T>(xi);
    const Blocks<T> left = left_jacobian<T>(x), right = left_jacobian<T>(-x);
    blocks("left_jacobian", left, left_jacobian_se3(xi));
    blocks("right_jacobian", right, right_jacobian_se3(xi));
    if (norm(tail3(xi)) <= 1e9) blocks("right_jacobian_fd", right, right_jacobian_fd(xi));
    rotations("left_jacobian_so3", left, left_jacobian_so3(tail3(xi)));
    rotations("right_jacobian_so3", right, left_jacobian_so3(-tail3(xi)));
    const JacobianBlocks<Real100> J = closed_left_jacobian(cast<Real100>(xi)),
                                  K = closed_left_jacobian_inverse(cast<Real100>(xi));
    const M3<T> approximate = point<T>(K.J);
    const Blocks<T> left_inverse = inverse<T>(left, approximate),
                    right_inverse = inverse<T>(right, approximate.transpose());
    blocks("left_jacobian_inverse", left_inverse, left_jacobian_se3_inverse(xi));
    blocks("right_jacobian_inverse", right_inverse, right_jacobian_se3_inverse(xi));
    rotations("left_jacobian_so3_inverse", left_inverse, left_jacobian_so3_inverse(tail3(xi)));
    rotations("right_jacobian_so3_inverse", right_inverse, left_jacobian_so3_inverse(-tail3(xi)));
    const double digits = claim_at_100_digits(norm(tail3(xi)));
    near("left_jacobian J at 100 digits", left.J, J.J, T(0), digits);
    near("left_jacobian C at 100 digits", left.C, J.C, T(0), digits);
    near("left_jacobian_inverse J at 100 digits", left_inverse.J, K.J, T(0), digits);
    near("left_jacobian_inverse C at 100 digits", left_inverse.C, K.C, T(0), digits);
  }

  void log(const Quaternion<>& Q, const Vec3<>& p) {
    const Q4<T> q = point<T>(Q);
    const V3<T> t = point<T>(p);
    logs("log", log_se3(Q, p), enclosures::log<T>(q, t), enclosures::log<T>(q, t, true));
  }

  void log(const Mat3<>& R, const Vec3<>& p) {
    const NearestQuaternion r = nearest_quaternion(cast<Real100>(R));
    if (!r.resolved) ledger_.unresolved("nearest_rotation");
    const Q4<T> q = nearest<T>(point<T>(R), point<T>(cast<Real>(r.Q)));
    near("nearest_rotation R", M3<T>(rotation<T>(q)), cast<Real>(rotation_matrix(r.Q)), T(1));
    const V3<T> t = point<T>(p);
    logs("log of a matrix", log_se3_matrix(R, p), enclosures::log<T>(q, t), enclosures::log<T>(q, t, true));
  }

  void integrate(const Vec7<>& q, const Vec6<>& delta) {
    const IntegrateResult r = oracles::integrate(q, delta);
    if (!r.resolved) ledger_.unresolved("integrate");
    const Exp<T> e = enclosures::integrate<T>(point<T>(q), point<T>(delta));
    near("integrate Q", e.Q, r.Q, T(1));
    const Real from = norm(head3(q));
    near("integrate p", e.p, r.p, point<T>(from > r.increment_norm ? from : r.increment_norm));
    blocks("d_integrate ARG0", adjoint_of_inverse<T>(point<T>(delta)), d_integrate_arg0(q, delta));
    blocks("d_integrate ARG1", left_jacobian<T>(-point<T>(delta)), d_integrate_arg1(q, delta));
  }

  void difference(const Vec7<>& q0, const Vec7<>& q1) {
    const DifferenceResult r = oracles::difference(q0, q1);
    const V7<T> a = point<T>(q0), b = point<T>(q1);
    const Log<T> l = enclosures::difference<T>(a, b);
    logs("difference", r, l, enclosures::difference<T>(a, b, true));
    V6<T> delta;
    delta << l.rho, l.phi;
    const Blocks<T> J = left_jacobian<T>(delta);
    const M3<T> K = point<T>(closed_left_jacobian_inverse(cast<Real100>(r.value())).J);
    const Blocks<T> left = inverse<T>(J, K);
    blocks("d_difference ARG0", {-left.J, -left.C}, d_difference_arg0(q0, q1));
    blocks("d_difference ARG1", inverse<T>(left_jacobian<T>(-delta), K.transpose()),
           d_difference_arg1(q0, q1));
  }

 private:
  template <int R, int C, class V>
  void near(const std::string& what, const Eigen::Matrix<T, R, C>& exact, const V& value,
            const T& scale = T(0), double claimed = claim) {
    ledger_.check<T, R, C>(what, exact, point<T>(value), claimed, wrong * claimed, scale);
  }
  void blocks(const std::string& what, const Blocks<T>& exact, const Jacobian6Result& r) {
    if (!r.resolved) ledger_.unresolved(what);
    near(what + " J", exact.J, r.J);
    near(what + " C", exact.C, r.C);
  }
  void rotations(const std::string& what, const Blocks<T>& exact, const Jacobian3Result& r) {
    if (!r.resolved) ledger_.unresolved(what);
    near(what, exact.J, r.J);
  }
  void logs(const std::string& what, const LogResult& r, const Log<T>& exact, const Log<T>& other) {
    if (!r.resolved) ledger_.unresolved(what);
    // At theta = pi both axes are right, and which of them is `other` depends on the rounding of w.
    const V3<T> phi = point<T>(r.phi);
    const bool swapped = r.at_pi && upper(T(phi.dot(exact.phi))) < 0;
    const Log<T>&first = swapped ? other : exact, &second = swapped ? exact : other;
    near(what + " phi", first.phi, r.phi);
    near(what + " rho", first.rho, r.rho);
    near(what + " theta", scalar(first.theta), Vec<1>{{r.theta}});
    const auto left = scalar(first.pi_minus_theta);
    if (!r.at_pi) return near(what + " pi - theta", left, Vec<1>{{r.pi_minus_theta}});
    near(what + " pi - theta at pi", left, Vec<1>{{r.pi_minus_theta}}, T(1), 2e-60);
    near(what + " other phi", second.phi, tail3(r.other));
    near(what + " other rho", second.rho, head3(r.other));
  }
  static Eigen::Matrix<T, 1, 1> scalar(const T& x) { return Eigen::Matrix<T, 1, 1>::Constant(x); }

  Ledger& ledger_;
};

}  // namespace liecheck::enclosures
