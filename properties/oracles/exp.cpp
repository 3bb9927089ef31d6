#include <oracles/exp.hpp>

#include <oracles/closed_forms.hpp>
#include <oracles/matrix_exponential.hpp>

namespace liecheck::oracles {
namespace {

/// The affine exponential of any xi. If squaring would lose more than 80 bits, theta is first reduced modulo
/// 2 pi: exp(xi) = exp((1-s) xi) exp(s xi) with s theta = 2 pi k and exp(s xi) = (I, s n (n.rho)).
template <class T>
AffineExponential<T> any_affine_exponential(const Vec6<T>& xi) {
  const HalfAngle<T> h = half_angle(tail3(xi));
  if (!h.large || exponent_of(h.theta) <= 80) return affine_exponential(xi);
  const T one_minus_s = h.reduced / h.theta;
  AffineExponential<T> r = affine_exponential(T(one_minus_s) * xi);
  const T advance = (1 - one_minus_s) * dot(tail3(xi), head3(xi)) / h.theta;
  r.p = r.p + advance * h.n;
  return r;
}

bool confirm(const Vec6<Real>& xi, const UnitPose<Real100>& pose, const Mat3<Real100>& E, const Real& theta) {
  const bool moderate = exponent_of(theta) <= 20;
  return confirmed(moderate, [&]<class T>(T) {
    const auto a = any_affine_exponential(cast<T>(xi));
    const T scale = theta < 1 ? T(theta) : T(1);  // near 2 pi k, R - I is compared absolutely
    return norm(a.E - cast<T>(E)) <= T(agreement) * scale && agree(a.p, cast<T>(pose.p));
  });
}

}  // namespace

ExpResult exp_se3(const Vec6<Real>& xi) {
  const Vec6<Real100> exact_xi = cast<Real100>(xi);
  const UnitPose<Real100> pose = closed_exp(exact_xi);
  const Mat3<Real100> E = rotation_minus_identity(pose.Q);
  ExpResult r{{cast<Real>(pose.Q), cast<Real>(pose.p), Real(norm(tail3(exact_xi)))},
              cast<Real>(identity<3, Real100>() + E)};
  r.resolved = confirm(xi, pose, E, r.theta);
  return r;
}

ExpResult exp_so3(const Vec3<Real>& phi) {
  return exp_se3(stack(zero_vector<3, Real>(), phi));
}

}  // namespace liecheck::oracles
