#include <oracles/motions/elliptic.hpp>

#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <boost/math/special_functions/ellint_rj.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>

namespace liecheck::oracles {
namespace {

template <class T>
const T& pi() {
  static const T value = boost::math::constants::pi<T>();
  return value;
}

/// The integer m for which m pi is nearest to phi.
template <class T>
T half_periods(const T& phi) {
  return floor(T(phi / pi<T>() + T(0.5)));
}

/// F and Pi for |phi| <= pi/2, by Carlson's integrals: DLMF 19.25.5 and 19.25.14. (ellint_3 of Boost 1.74
/// does not compile for these numbers.)
template <class T>
T first_kind_within(const T& phi, const T& k) {
  T s, c;
  sin_cos(phi, s, c);
  return s * boost::math::ellint_rf(T(c * c), T(1 - k * k * s * s), T(1));
}
template <class T>
T third_kind_within(const T& n, const T& phi, const T& k) {
  T s, c;
  sin_cos(phi, s, c);
  const T s2 = s * s, c2 = c * c, d2 = 1 - k * k * s2, first = boost::math::ellint_rf(c2, d2, T(1));
  if (n * s2 == 0) return s * first;
  return s * (first + n * s2 / 3 * boost::math::ellint_rj(c2, d2, T(1), T(1 - n * s2)));
}

}  // namespace

template <class T>
Jacobi<T> jacobi(const T& u, const T& k) {
  Jacobi<T> r;
  if (k == 1) {  // hyperbolic functions, without a period
    r.sn = tanh(u);
    r.cn = r.dn = 1 / cosh(u);
    r.am = 2 * atan(T(tanh(T(u / 2))));
    return r;
  }
  const T K = first_kind_within<T>(pi<T>() / 2, k), m = floor(T(u / (2 * K) + T(0.5))),
          reduced = u - 2 * K * m;
  r.sn = boost::math::jacobi_elliptic(k, reduced, &r.cn, static_cast<T*>(nullptr));
  r.dn = sqrt(T((1 - k) * (1 + k) + k * k * r.cn * r.cn));  // Boost's quotient is 0/0 at u = K
  r.am = atan2(r.sn, r.cn) + pi<T>() * m;
  if (fmod(m, T(2)) != 0) r.sn = -r.sn, r.cn = -r.cn;
  return r;
}

template <class T>
T first_kind(const T& phi, const T& k) {
  if (k == 1) return asinh(T(tan(phi)));
  const T m = half_periods(phi);
  const T reduced = first_kind_within<T>(phi - m * pi<T>(), k);
  return m == 0 ? reduced : T(reduced + 2 * m * first_kind_within<T>(pi<T>() / 2, k));
}

template <class T>
T third_kind(const T& n, const T& phi, const T& k) {
  const T m = half_periods(phi);
  const T reduced = third_kind_within<T>(n, phi - m * pi<T>(), k);
  return m == 0 ? reduced : T(reduced + 2 * m * third_kind_within<T>(n, pi<T>() / 2, k));
}

template Jacobi<Real> jacobi(const Real&, const Real&);
template Jacobi<Real100> jacobi(const Real100&, const Real100&);
template Real first_kind(const Real&, const Real&);
template Real100 first_kind(const Real100&, const Real100&);
template Real third_kind(const Real&, const Real&, const Real&);
template Real100 third_kind(const Real100&, const Real100&, const Real100&);

}  // namespace liecheck::oracles
