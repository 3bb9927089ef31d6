#pragma once
// Rate of the increment delta of a moving configuration: q(t) = integrate(q0, delta(t)) has the velocity v if
//
//   delta_dot = J_r^-1(delta) v          (dexp^-1 of Munthe-Kaas 1999, right-trivialised)
//
// J_r^-1(xi) w is computed without forming the matrix. For xi = (rho, phi) and w = (u, omega) it is
//
//   omega + 1/2 phi x omega + d phi x (phi x omega)
//   u + 1/2 (phi x u + rho x omega) + d (phi x (phi x u) + phi x (rho x omega) + rho x (phi x omega))
//     + d2 (phi . rho) phi x (phi x omega)
//
// Domain: |phi| < 2 pi; at 2 pi J_r^-1 is singular. Error 8 eps |w| for |phi| <= pi.

#include <liecheck/multibody/joint_place.hpp>
#include <liecheck/spatial/jacobians.hpp>

namespace liecheck::scene {

/// The rates for |phi| > pi, once for all methods.
template <Scalar S>
[[gnu::noinline, gnu::cold]] Vector3<S> tangentRateBeyondPi(const Vector3<S>& phi, const Vector3<S>& omega) {
  return product<S>(rightJacobianInverse<S>(phi), omega);
}
template <Scalar S>
[[gnu::noinline, gnu::cold]] Vector6<S> tangentRateBeyondPi(const Vector6<S>& xi, const Vector6<S>& w) {
  return rightJacobianInverse<S>(Motion<S>(xi)) * w;
}

/// J_r^-1(phi) omega [3, rad/s].
template <Scalar S>
[[gnu::always_inline]] inline Vector3<S> tangentRate(const Vector3<S>& phi, const Vector3<S>& omega) {
  const S x = dot<S>(phi, phi);
  if (!within_pi(x)) return tangentRateBeyondPi<S>(phi, omega);
  const InverseCoefficient<S> c(x);
  const Vector3<S> once = cross<S>(phi, omega), twice = cross<S>(phi, once);
  return each<S>([&](int i) { return mul_add(c.d, twice[i], S(omega[i] + once[i] / S(2))); });
}

/// J_r^-1(xi) w [6; m/s, rad/s].
template <Scalar S>
[[gnu::always_inline]] inline Vector6<S> tangentRate(const Vector6<S>& xi, const Vector6<S>& w) {
  const Vector3<S> rho(xi[0], xi[1], xi[2]), phi(xi[3], xi[4], xi[5]);
  const Vector3<S> u(w[0], w[1], w[2]), omega(w[3], w[4], w[5]);
  const S x = dot<S>(phi, phi);
  if (!within_pi(x)) return tangentRateBeyondPi<S>(xi, w);
  const InverseCoefficient<S> c(x);
  const Vector3<S> a = cross<S>(phi, omega), aa = cross<S>(phi, a);
  const Vector3<S> b =
      each<S>([f = cross<S>(phi, u), r = cross<S>(rho, omega)](int i) { return f[i] + r[i]; });
  const Vector3<S> bb = cross<S>(phi, b), ra = cross<S>(rho, a);
  const S along = c.d2 * dot<S>(phi, rho);
  Vector6<S> rate;
  for (int i = 0; i < 3; ++i) {
    rate[i] = mul_add(along, aa[i], mul_add(c.d, S(bb[i] + ra[i]), S(u[i] + b[i] / S(2))));
    rate[3 + i] = mul_add(c.d, aa[i], S(omega[i] + a[i] / S(2)));
  }
  return rate;
}

/// J_r^-1(delta) v of one joint. It is v if the increments of the joint commute.
template <Scalar S, class J>
typename J::Tangent tangentRateOf(const J&, const typename J::Tangent& delta, const typename J::Tangent& v) {
  if constexpr (std::is_same_v<J, FreeFlyer<S>> || std::is_same_v<J, Spherical<S>>) {
    return tangentRate<S>(delta, v);
  } else if constexpr (std::is_same_v<J, Planar<S>>) {
    const auto in_space = [](const Vector3<S>& x) {
      Vector6<S> xi;
      xi << x[0], x[1], S(0), S(0), S(0), x[2];
      return xi;
    };
    const Vector6<S> rate = tangentRate<S>(in_space(delta), in_space(v));
    return Vector3<S>(rate[0], rate[1], rate[5]);
  } else {
    return v;
  }
}

}  // namespace liecheck::scene
