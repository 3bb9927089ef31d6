#pragma once
// Rigorous enclosures, in MPFI's interval arithmetic, of the results of the oracles at 50 and 100 digits.
//
// Every function returns intervals that contain the exact value, by formulas other than the oracle's:
//   c_k(x)      for x < 256 the power series; the remainder is at most the first omitted term (alternating);
//               for x >= 256 sin and cos of the full angle; the oracles use half angles and matrix squarings
//   exp         R = I + c1 [phi] + c2 [phi]^2,   p = c1 rho + c2 phi x rho + c3 phi (phi.rho)
//   log         theta / 2 = a + atan((s cos a - c sin a) / (c cos a + s sin a)) with a rounded guess a;
//               rho solves V(phi) rho = p
//   polar       Krawczyk's operator proves that a rotation R(d) R(Q0), d in a tiny box, makes X^T R symmetric
//   J, C        I + c2 [phi] + c3 [phi]^2 and its derivative along rho, c_k' from its own series;
//               the oracles use c4, c5
//   inverses    K* = K + (I - K J) K* around the oracle's K, with a Neumann bound of the error of K
//
// T is an Interval. If its precision is too small for the arguments or for reducing an angle modulo 2 pi, the
// result is wide, never wrong. A question that T cannot decide, such as the sign of an interval around zero,
// throws Undecided.
//
// Sources: Tucker 2011 (interval arithmetic); Neumaier 1990, chapter 5 (Krawczyk); Rump 2010, section 10
// (Neumann).

#include <boost/multiprecision/mpfi.hpp>

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <boost/multiprecision/eigen.hpp>
#include <climits>
#include <cmath>
#include <stdexcept>

namespace liecheck::enclosures {

template <unsigned Digits>
using Interval = boost::multiprecision::number<boost::multiprecision::mpfi_float_backend<Digits>,
                                               boost::multiprecision::et_off>;
template <class T>
using V3 = Eigen::Matrix<T, 3, 1>;
template <class T>
using V6 = Eigen::Matrix<T, 6, 1>;
template <class T>
using V7 = Eigen::Matrix<T, 7, 1>;
/// x y z w.
template <class T>
using Q4 = Eigen::Matrix<T, 4, 1>;
template <class T>
using M3 = Eigen::Matrix<T, 3, 3>;

struct Undecided : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// ---- intervals

/// largest(x) is the largest |y| for y in x; exponent(x) is an e with |y| < 2^e.
template <class T>
auto largest(const T& x) {
  auto m = upper(x);
  mpfi_mag(m.backend().data(), x.backend().data());
  return m;
}
template <class T>
long exponent(const T& x) {
  const auto m = largest(x);
  return mpfr_zero_p(m.backend().data()) ? LONG_MIN / 2 : mpfr_get_exp(m.backend().data());
}
/// [-m, m], m = largest(x).
template <class T>
T around_zero(const T& x) {
  const auto m = largest(x), minus = decltype(m)(-m);
  T r;
  mpfi_interv_fr(r.backend().data(), minus.backend().data(), m.backend().data());
  return r;
}
template <class T>
long precision(const T& x) {
  return static_cast<long>(mpfi_get_prec(x.backend().data()));
}
template <class T>
bool is_zero(const T& x) {
  return lower(x) == 0 && upper(x) == 0;
}

// ---- c_k

/// c[k](x) and its derivative d[k].
template <class T>
struct Stumpff {
  std::array<T, 4> c, d;
};

template <class T>
Stumpff<T> stumpff(const T& x) {
  Stumpff<T> r;
  if (upper(x) >= 256) {
    const T theta = sqrt(x);
    auto& [c, d] = r;
    c = {cos(theta), sin(theta) / theta, (1 - cos(theta)) / x, (1 - sin(theta) / theta) / x};
    d = {-c[1] / 2, (c[0] - c[1]) / (2 * x), (c[1] / 2 - c[2]) / x, T(0)};
    d[3] = -(d[1] + c[3]) / x;
    return r;
  }
  const long enough = -precision(x) - 20;
  for (int k = 0; k < 4; ++k) {
    auto &c = r.c[static_cast<std::size_t>(k)], &d = r.d[static_cast<std::size_t>(k)];
    c = d = 0;
    T term = T(1) / (k == 3 ? 6 : k == 2 ? 2 : 1);  // (-x)^j / (2j + k)!
    for (int j = 0;; ++j) {
      const int next = (2 * j + k + 1) * (2 * j + k + 2);
      if (next > 1024 && exponent(term) < enough)
        break;  // from here on each term is below a quarter of the one before
      c += term;
      d -= term * (j + 1) / next;
      term = -(term * x) / next;
    }
    c += around_zero(term);
    d += around_zero(term);
  }
  return r;
}

// ---- vectors, quaternions

template <class T>
M3<T> hat(const V3<T>& v) {
  M3<T> m;
  m << T(0), -v[2], v[1], v[2], T(0), -v[0], -v[1], v[0], T(0);
  return m;
}
/// The vector of m - m^T.
template <class T>
V3<T> twice_vee(const M3<T>& m) {
  return {m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)};
}
template <class T>
Q4<T> product(const Q4<T>& a, const Q4<T>& b) {
  const V3<T> u = a.template head<3>(), v = b.template head<3>();
  const V3<T> vector = v * a[3] + u * b[3] + u.cross(v);
  Q4<T> r;
  r << vector, a[3] * b[3] - u.dot(v);
  return r;
}
template <class T>
Q4<T> conjugate(const Q4<T>& q) {
  return {-q[0], -q[1], -q[2], q[3]};
}
/// Q (x, 0) Q* / ||Q||^2.
template <class T>
V3<T> rotate(const Q4<T>& q, const V3<T>& x) {
  Q4<T> pure;
  pure << x, T(0);
  return product<T>(product<T>(q, pure), conjugate<T>(q)).template head<3>() / q.dot(q);
}
template <class T>
M3<T> rotation(const Q4<T>& q) {
  M3<T> R;
  for (int i = 0; i < 3; ++i) R.col(i) = rotate<T>(q, V3<T>(M3<T>::Identity().col(i)));
  return R;
}

}  // namespace liecheck::enclosures
