#include <oracles/closed_forms.hpp>

#include <mpfr.h>

namespace liecheck::oracles {
namespace {

/// An MPFR number whose precision is chosen at run time; only angles beyond 2^42 need it.
class Long {
 public:
  explicit Long(long precision) { mpfr_init2(value_, precision); }
  ~Long() { mpfr_clear(value_); }
  Long(const Long&) = delete;
  Long& operator=(const Long&) = delete;
  mpfr_ptr get() { return value_; }

 private:
  mpfr_t value_;
};

/// Sets `reduced` to theta = ||phi|| modulo 2 pi with an absolute error of 2^-bits, for theta < 2^exponent.
/// Returns whether an odd multiple of 2 pi was subtracted.
template <class T>
bool reduce(const Vec3<T>& phi, int exponent, T& reduced) {
  const long precision = 2L * bits<T> + exponent;
  Long theta(precision), square(precision), period(precision), periods(precision);
  mpfr_set_zero(theta.get(), 1);
  for (int i = 0; i < 3; ++i) {
    mpfr_sqr(square.get(), phi[i].backend().data(), MPFR_RNDN);
    mpfr_add(theta.get(), theta.get(), square.get(), MPFR_RNDN);
  }
  mpfr_sqrt(theta.get(), theta.get(), MPFR_RNDN);
  mpfr_const_pi(period.get(), MPFR_RNDN);
  mpfr_mul_2ui(period.get(), period.get(), 1, MPFR_RNDN);
  mpfr_div(periods.get(), theta.get(), period.get(), MPFR_RNDN);
  mpfr_rint(periods.get(), periods.get(), MPFR_RNDN);
  mpfr_mul(period.get(), period.get(), periods.get(), MPFR_RNDN);
  mpfr_sub(theta.get(), theta.get(), period.get(), MPFR_RNDN);
  mpfr_set(reduced.backend().data(), theta.get(), MPFR_RNDN);
  mpfr_div_2ui(periods.get(), periods.get(), 1, MPFR_RNDN);
  return mpfr_integer_p(periods.get()) == 0;
}

/// c_k(x) for 0 <= x <= 1. Horner's rule gives k! c_k = 1 - x/((k+1)(k+2)) (1 - x/((k+3)(k+4)) (1 - ...)).
template <class T>
T stumpff_series(int k, const T& x) {
  constexpr int terms = bits < T >> 200 ? 34 : 20;  // x^j/(2j)! < 2^-bits
  T sum(1);
  for (int j = terms; j >= 1; --j) {
    sum *= x;
    sum /= (k + 2 * j - 1) * (k + 2 * j);
    sum = 1 - sum;
  }
  for (int i = 2; i <= k; ++i) sum /= i;
  return sum;
}

}  // namespace

template <class T>
HalfAngle<T> half_angle(const Vec3<T>& phi, const T& theta) {
  HalfAngle<T> h;
  h.theta = theta;
  h.reduced = h.theta;
  if (h.theta == 0) {
    h.s = 0;
    h.c = 1;
    h.n = phi;
    return h;
  }
  if constexpr (BallNumber<T>) h.inverse = T(1) / h.theta;
  for (int i = 0; i < 3; ++i) h.n[i] = h.over_theta(phi[i]);
  if constexpr (BallNumber<T>) {                     // the radius includes the error of a large angle
    sin_cos(power_scaled(h.reduced, -1), h.s, h.c);  // exact, unlike a quotient
  } else {
    const int exponent = exponent_of(h.theta);
    h.large = isfinite(h.theta) && exponent > bits<T> / 4;
    const bool odd = h.large && reduce(phi, exponent, h.reduced);
    sin_cos(T(h.reduced / 2), h.s, h.c);
    if (odd) h.s = -h.s, h.c = -h.c;
  }
  return h;
}

template <BallNumber T>
double bound(const Vec3<T>& v) {
  return std::fabs(v[0].head()) + std::fabs(v[1].head()) + std::fabs(v[2].head()) + v[0].r + v[1].r + v[2].r;
}
/// Below this angle balls use the first-order expansion and add its remainder to the radius.
inline constexpr double tiny_angle = 0x1p-60;

template <class T>
UnitPose<T> closed_exp(const Vec6<T>& xi, const T& theta) {
  const Vec3<T> rho = head3(xi);
  if constexpr (BallNumber<T>) {
    const Vec3<T> phi = tail3(xi);
    const double angle = bound(phi), remainder = angle > 0 ? std::fmax(angle * angle, 0x1p-1000) : 0;
    if (angle < tiny_angle) {
      UnitPose<T> pose{{{T(0.5) * phi[0], T(0.5) * phi[1], T(0.5) * phi[2], widened(T(1), remainder)}},
                       rho + T(0.5) * cross(phi, rho)};
      for (int i = 0; i < 3; ++i) {
        pose.Q[i] = widened(pose.Q[i], remainder * angle);
        if (remainder > 0) pose.p[i] = widened(pose.p[i], remainder * bound(rho));
      }
      return pose;
    }
  }
  const HalfAngle<T> h = half_angle(tail3(xi), theta);
  UnitPose<T> pose;
  pose.Q = {{h.s * h.n[0], h.s * h.n[1], h.s * h.n[2], h.c}};
  pose.p = rho;
  if (h.theta != 0) {
    const Vec3<T> along = h.over_theta(dot(tail3(xi), rho)) * h.n;  // exactly zero if phi.rho is
    const T s2 = 2 * h.over_theta(h.s);
    pose.p = along + T(s2 * h.c) * (rho - along) + T(s2 * h.s) * cross(h.n, rho);
  }
  return pose;
}

template <class T>
Vec6<T> closed_log(const Quaternion<T>& Q, const Vec3<T>& p, bool as_signed) {
  const bool flip = !as_signed && Q[3] < 0;
  const Vec3<T> v = flip ? -head3(Q) : head3(Q);
  const T w = flip ? T(-Q[3]) : Q[3];
  if constexpr (BallNumber<T>) {
    const double sine = bound(v), cosine = w.head() - w.r;
    if (cosine > 0 &&
        sine < tiny_angle * cosine) {  // phi = 2 v / w (1 - O(s^2 / w^2)), V^-1 = I - [phi]/2 + O(phi^2)
      const double ratio = 2 * sine / cosine, remainder = std::fmax(ratio * ratio, 0x1p-1000);
      Vec3<T> phi = T(T(2) / w) * v, rho = p - T(0.5) * cross(phi, p);
      for (int i = 0; i < 3; ++i) {
        if (sine > 0) phi[i] = widened(phi[i], remainder * ratio);
        if (sine > 0) rho[i] = widened(rho[i], remainder * bound(p) + 0x1p-1070);
      }
      return stack(rho, phi);
    }
  }
  const T s = norm(v);
  if (s == 0) return stack(p, v);
  const T theta = 2 * atan2(s, w);
  const Vec3<T> n = T(1 / s) * v;
  const Vec3<T> phi = theta * n, n_p = cross(n, p);
  const T half = theta / 2;
  return stack(p - half * n_p + T(1 - half * w / s) * cross(n, n_p), phi);
}

template <class T>
UnitPose<T> closed_integrate(const Vec7<T>& q0, const Vec6<T>& delta) {
  const Quaternion<T> Q0 = normalized(quaternion_of(q0));
  const UnitPose<T> step = closed_exp(delta);
  return {quaternion_product(Q0, step.Q), head3(q0) + rotate(Q0, step.p)};
}

template <class T>
RelativePose<T> relative_pose(const Vec7<T>& q0, const Vec7<T>& q1) {
  const Quaternion<T> Q0 = quaternion_of(q0), Q1 = quaternion_of(q1);
  RelativePose<T> relative;
  relative.Q = conjugate_product(Q0, Q1);
  relative.p1_minus_p0 = head3(q1) - head3(q0);
  relative.p = rotate(Q0, relative.p1_minus_p0, true);
  return relative;
}

template <class T>
Vec6<T> closed_difference(const Vec7<T>& q0, const Vec7<T>& q1) {
  const RelativePose<T> relative = relative_pose(q0, q1);
  return closed_log(relative.Q, relative.p);
}

namespace {

/// J = I + e [phi] + f [phi]^2 and C = e [rho] + f ([phi][rho] + [rho][phi]) + g [phi] + h [phi]^2. The
/// elements of [phi]^2 are phi_i phi_j and -(phi_j^2 + phi_k^2). Those of [phi][rho] + [rho][phi] are
/// phi_i rho_j + phi_j rho_i and -2 (phi_j rho_j + phi_k rho_k).
template <class T>
JacobianBlocks<T> blocks(const Vec3<T>& phi, const Vec3<T>& rho, const T& e, const T& f, const T& g,
                         const T& h) {
  JacobianBlocks<T> b;
  T square[3], mixed[3];
  for (int i = 0; i < 3; ++i) square[i] = phi[i] * phi[i], mixed[i] = phi[i] * rho[i];
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const T diagonal = -(square[j] + square[k]), cross_diagonal = T(-2) * (mixed[j] + mixed[k]);
    b.J(i, i) = T(1) + f * diagonal;
    b.C(i, i) = f * cross_diagonal + h * diagonal;
    // The element (j, k) of a hat matrix is -v_i, (k, j) is v_i.
    const T off = phi[j] * phi[k], cross_off = phi[j] * rho[k] + phi[k] * rho[j];
    const T symmetric = f * off, skew = e * phi[i];
    b.J(j, k) = symmetric - skew, b.J(k, j) = symmetric + skew;
    const T c_symmetric = f * cross_off + h * off, c_skew = e * rho[i] + g * phi[i];
    b.C(j, k) = c_symmetric - c_skew, b.C(k, j) = c_symmetric + c_skew;
  }
  return b;
}

}  // namespace

template <class T>
JacobianBlocks<T> closed_left_jacobian(const Vec6<T>& xi) {
  const Vec3<T> rho = head3(xi), phi = tail3(xi);
  const T x = squared_norm(phi);
  T c2, c3, c4, c5;
  if (x < 1) {
    c4 = stumpff_series(4, x);
    c5 = stumpff_series(5, x);
    c2 = T(1) / 2 - x * c4;
    c3 = T(1) / 6 - x * c5;
  } else {
    const HalfAngle<T> h = half_angle(phi);
    const T s2 = 2 * h.s;
    c2 = s2 * h.s / x;
    c3 = (1 - s2 * h.c / h.theta) / x;
    c4 = (T(1) / 2 - c2) / x;
    c5 = (T(1) / 6 - c3) / x;
  }
  const T phi_rho = dot(phi, rho);
  return blocks(phi, rho, c2, c3, T(phi_rho * (2 * c4 - c3)), T(phi_rho * (3 * c5 - c4)));
}

template <class T>
JacobianBlocks<T> closed_left_jacobian_inverse(const Vec6<T>& xi) {
  const Vec3<T> rho = head3(xi), phi = tail3(xi);
  const T x = squared_norm(phi);
  if (x < 1) {
    if constexpr (BallNumber<T>) {
      // g = h / (2 c2), h = c3 - 2 c4, h' = (5 c5 - c4 - 8 c6) / 2, c2' = -h / 2. Forming g' loses two bits.
      const T c5 = stumpff_series(5, x), c6 = stumpff_series(6, x), c4 = T(1) / T(24) - x * c6;
      const T c2 = T(0.5) - x * c4, c3 = T(1) / T(6) - x * c5, h = c3 - doubled(c4);
      const T slope = T(0.5) * (T(5) * c5 - c4 - T(8) * c6);
      const T dg = (slope * c2 + T(0.5) * h * h) / (doubled(c2) * c2);
      return blocks(phi, rho, T(-0.5), T(h / doubled(c2)), T(0), T(doubled(dg) * dot(phi, rho)));
    }
    const JacobianBlocks<T> jacobian = closed_left_jacobian(xi);
    const Mat3<T> K = inverse(jacobian.J);
    return {K, T(-1) * (K * jacobian.C * K)};
  }
  const HalfAngle<T> h = half_angle(phi);
  const T cot = h.c / h.s, half = h.theta / 2;
  const T g = (1 - half * cot) / x;
  const T dg = ((half / (h.s * h.s) - cot) / (2 * x) - 2 * g / h.theta) / (2 * h.theta);
  return blocks(phi, rho, T(T(-1) / 2), g, T(0), T(2 * dg * dot(phi, rho)));
}

#define LIECHECK_CLOSED_FORMS(T)                                           \
  template HalfAngle<T> half_angle(const Vec3<T>&, const T&);              \
  template UnitPose<T> closed_exp(const Vec6<T>&, const T&);               \
  template Vec6<T> closed_log(const Quaternion<T>&, const Vec3<T>&, bool); \
  template UnitPose<T> closed_integrate(const Vec7<T>&, const Vec6<T>&);   \
  template RelativePose<T> relative_pose(const Vec7<T>&, const Vec7<T>&);  \
  template Vec6<T> closed_difference(const Vec7<T>&, const Vec7<T>&);      \
  template JacobianBlocks<T> closed_left_jacobian(const Vec6<T>&);         \
  template JacobianBlocks<T> closed_left_jacobian_inverse(const Vec6<T>&);
LIECHECK_CLOSED_FORMS(Real)
LIECHECK_CLOSED_FORMS(Real100)
LIECHECK_CLOSED_FORMS(DoubleBall)
LIECHECK_CLOSED_FORMS(DoubleDoubleBall)

}  // namespace liecheck::oracles
