#include <oracles/motions/elliptic.hpp>
#include <oracles/motions/lagrange_top.hpp>

#include <stdexcept>

namespace liecheck::oracles {

/// Sets the roots of f. Newton's method gives u3: it starts at an upper bound, where f is convex, so that it
/// cannot overshoot. u1 and u2, between which u0 lies, are the roots of the remaining quadratic.
template <class T>
void LagrangeTop<T>::solve_cubic(const T& alpha, const T& beta, const T& u0, const T& rate) {
  // f / beta = u^3 - p u^2 + q u - r
  const T p = (alpha + a_ * a_) / beta, q = 2 * a_ * b_ / beta - 1, r = (b_ * b_ - alpha) / beta;
  // Beyond the inflection p/3 the cubic is convex; the start is an upper bound of all roots.
  T u = 1 + larger<T>(abs(p), larger<T>(abs(q), abs(r)));
  for (int i = 0; i < 2000; ++i) {
    const T next = u - (((u - p) * u + q) * u - r) / ((3 * u - 2 * p) * u + q);
    if (!(next < u)) break;
    u = next;
  }
  u3_ = u;
  // centre = (u1 + u2)/2, half = (u2 - u1)/2. The square of `half` follows without cancellation from
  // f(u0) = rate^2 = beta (u0-u1)(u2-u0)(u3-u0).
  const T centre = (p - u3_) / 2, off = u0 - centre, product = rate * rate / (beta * (u3_ - u0));
  const T half = sqrt(T(off * off + product));
  u1_ = centre - half, u2_ = centre + half;
}

template <class T>
LagrangeTop<T>::LagrangeTop(const T& transverse, const T& axial, const T& torque,
                            const AttitudeState<T>& initial)
    : initial_(initial) {
  if (!(torque > 0)) throw std::domain_error("LagrangeTop: the centre of mass is not above the fixed point");
  initial_.Q = normalized(initial.Q);
  const Vec3<T>& w = initial.omega;
  const Mat3<T> R = rotation_matrix(initial_.Q);
  const T u0 = R(2, 2), wz = w[2], ratio = axial / transverse;
  spin_ = wz;
  sleeping_ = R(0, 2) == 0 && R(1, 2) == 0 && w[0] == 0 && w[1] == 0;
  if (sleeping_) {
    u1_ = u2_ = u0;
    return;
  }
  a_ = ratio * wz;
  b_ = R(2, 0) * w[0] + R(2, 1) * w[1] + a_ * u0;
  if (b_ == a_ || b_ == -a_) throw std::domain_error("LagrangeTop: the axis passes through the vertical");
  const T beta = 2 * torque / transverse, alpha = w[0] * w[0] + w[1] * w[1] + beta * u0;
  const T rate = R(2, 0) * w[1] - R(2, 1) * w[0];  // u' = (R [omega])_zz
  solve_cubic(alpha, beta, u0, rate);
  lambda_ = sqrt(T(beta * (u3_ - u1_))) / 2;
  k_ = sqrt(T((u2_ - u1_) / (u3_ - u1_)));
  const T rise = sqrt(larger<T>(T(0), u0 - u1_)), fall = sqrt(larger<T>(T(0), u2_ - u0));
  const T am0 = atan2(rate < 0 ? T(-rise) : rise, fall);
  s0_ = first_kind<T>(am0, k_);
  upper0_ = fraction(1, am0), lower0_ = fraction(-1, am0);
  phi0_ = atan2(R(1, 2), R(0, 2));
  psi0_ = atan2(R(2, 1), T(-R(2, 0)));
}

template <class T>
T LagrangeTop<T>::fraction(int sign, const T& am) const {
  const T base = 1 - sign * u1_;
  return third_kind<T>(sign * (u2_ - u1_) / base, am, k_) / (base * lambda_);
}

template <class T>
AttitudeState<T> LagrangeTop<T>::at(const T& t) const {
  if (sleeping_) {
    return {quaternion_product(initial_.Q, rotation_by<T>(Vec3<T>{{T(0), T(0), T(t * spin_)}})),
            initial_.omega};
  }
  const Jacobi<T> e = jacobi<T>(lambda_ * t + s0_, k_);
  const T amplitude = u2_ - u1_, u = u1_ + amplitude * e.sn * e.sn;
  const T rate = 2 * lambda_ * amplitude * e.sn * e.cn * e.dn;
  const T upper = fraction(1, e.am) - upper0_, lower = fraction(-1, e.am) - lower0_;
  const T phi = phi0_ + ((b_ - a_) * upper + (b_ + a_) * lower) / 2;
  // u phi' = (b u - a u^2)/(1 - u^2) = a - [(a - b)/(1 - u) + (a + b)/(1 + u)] / 2
  const T psi = psi0_ + (spin_ - a_) * t + ((a_ - b_) * upper + (a_ + b_) * lower) / 2;
  const T sine = sqrt(T((1 - u) * (1 + u))), precession = (b_ - a_ * u) / ((1 - u) * (1 + u));
  const T theta_rate = -rate / sine, zero(0);
  T s, c;
  sin_cos(psi, s, c);
  AttitudeState<T> state;
  const T theta = atan2(sine, u);
  state.Q = quaternion_product(rotation_by<T>(Vec3<T>{{zero, zero, phi}}),
                               quaternion_product(rotation_by<T>(Vec3<T>{{zero, theta, zero}}),
                                                  rotation_by<T>(Vec3<T>{{zero, zero, psi}})));
  state.omega = {{theta_rate * s - precession * sine * c, theta_rate * c + precession * sine * s, spin_}};
  return state;
}

template class LagrangeTop<Real>;
template class LagrangeTop<Real100>;

}  // namespace liecheck::oracles
