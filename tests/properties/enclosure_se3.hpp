#pragma once
// Enclosures of the operations on SE(3), by the formulas in enclosure.hpp.

#include "enclosure.hpp"

namespace liecheck::enclosures {

template <class T>
struct Exp {
  Q4<T> Q;  ///< continuous in phi
  M3<T> R;
  V3<T> p;
};

template <class T>
Exp<T> exp(const V6<T>& xi) {
  const V3<T> rho = xi.template head<3>(), phi = xi.template tail<3>();
  const T x = phi.dot(phi);
  const auto c = stumpff<T>(x).c, half = stumpff<T>(x / 4).c;
  const M3<T> F = hat<T>(phi);
  Exp<T> e;
  e.Q << phi * T(half[1] / 2), half[0];
  e.R = M3<T>::Identity() + F * c[1] + F * F * c[2];
  e.p = rho * c[1] + phi.cross(rho) * c[2] + phi * T(c[3] * phi.dot(rho));
  return e;
}

/// [[J, C], [0, J]]
template <class T>
struct Blocks {
  M3<T> J, C;
};

template <class T>
Blocks<T> left_jacobian(const V6<T>& xi) {
  const V3<T> rho = xi.template head<3>(), phi = xi.template tail<3>();
  const Stumpff<T> s = stumpff<T>(phi.dot(phi));
  const T dx = 2 * phi.dot(rho);  // derivative of x = phi.phi along rho
  const M3<T> F = hat<T>(phi), P = hat<T>(rho), FF = F * F;
  return {M3<T>::Identity() + F * s.c[2] + FF * s.c[3],
          P * s.c[2] + (F * P + P * F) * s.c[3] + F * T(s.d[2] * dx) + FF * T(s.d[3] * dx)};
}

/// The inverse of A = [[J, C], [0, J]]. K is an approximate inverse of J.
template <class T>
Blocks<T> inverse(const Blocks<T>& A, const M3<T>& K) {
  const M3<T> E = M3<T>::Identity() - K * A.J;
  T e(0), k(0);
  for (int i = 0; i < 9; ++i) {
    e += E(i) * E(i);
    k += K(i) * K(i);
  }
  e = sqrt(e);
  if (!(upper(e) < 0.5)) throw Undecided("no approximate inverse");
  // K* = K + E K*, so that ||K* - K|| <= ||E|| ||K|| / (1 - ||E||) = r. Insert it once.
  const T r = around_zero<T>(e * sqrt(k) / (1 - e));
  const M3<T> exact = K + E * (K + M3<T>::Constant(r));
  return {exact, -(exact * A.C * exact)};
}

template <class T>
Blocks<T> adjoint_of_inverse(const V6<T>& xi) {
  const Exp<T> e = exp<T>(xi);
  const M3<T> Rt = e.R.transpose();
  return {Rt, -(Rt * hat<T>(e.p))};
}

/// atan2(s, c), s >= 0.
template <class T>
T angle_of(const T& s, const T& c) {
  const T a(std::atan2(median(s).template convert_to<double>(), median(c).template convert_to<double>()));
  const auto k = stumpff<T>(a * a).c;
  const T sine = a * k[1], cosine = k[0];
  const T t = (s * cosine - c * sine) / (c * cosine + s * sine);
  if (!(largest(t) < 0.125)) throw Undecided("an angle");
  T sum = a, power = t;
  const long enough = exponent(t) - precision(t) - 20;
  for (int j = 0; !is_zero(power) && exponent(power) > enough; ++j) {
    sum += power / (2 * j + 1);
    power = -(power * t * t);
  }
  return sum + around_zero(power);
}

template <class T>
struct Log {
  V3<T> rho, phi;
  T theta, pi_minus_theta;
};

/// The log of the pose (Q / ||Q||, p). `opposite` selects the branch of the opposite axis, theta >= pi. If
/// the interval of w contains zero, it must be within 2^-300 of zero. The two branches may then be exchanged.
template <class T>
Log<T> log(Q4<T> Q, const V3<T>& p, bool opposite = false) {
  const bool open = lower(Q[3]) < 0 && upper(Q[3]) > 0;
  if (open && exponent<T>(Q[3]) > -300) throw Undecided("the sign of w");
  if ((!open && lower(Q[3]) < 0) != opposite) Q = -Q;
  const V3<T> v = Q.template head<3>();
  const T s = sqrt(T(v.dot(v)));
  if (is_zero(s)) return {p, v, s, 2 * angle_of<T>(Q[3], s)};
  Log<T> r{p, v, 2 * angle_of<T>(s, Q[3]), 2 * angle_of<T>(Q[3], s)};
  r.phi = v * T(r.theta / s);
  V6<T> xi;
  xi << V3<T>::Zero(), r.phi;
  const M3<T> V = left_jacobian<T>(xi).J;
  r.rho = V.inverse() * p;
  return r;
}

/// The rotation nearest to R. Q0 is an approximation of it.
template <class T>
Q4<T> nearest(const M3<T>& R, const Q4<T>& Q0) {
  const M3<T> B = rotation<T>(Q0).transpose() * R;
  const M3<T> defect = B - M3<T>::Identity();
  T far(0);
  for (int i = 0; i < 9; ++i) far += defect(i) * defect(i);
  if (!(upper(far) < 0.25)) throw Undecided("no approximate rotation");
  // g(d) = vee(R(d)^T B) (1 + d.d) = 0,   R(d) (1 + d.d) = (1 - d.d) I + 2 [d] + 2 d d^T
  const auto derivative = [&](const V3<T>& d) {
    M3<T> g;
    for (int i = 0; i < 3; ++i) {
      const V3<T> e = M3<T>::Identity().col(i);
      g.col(i) =
          twice_vee<T>((e * d.transpose() + d * e.transpose() - hat<T>(e) - M3<T>::Identity() * d[i]) * B);
    }
    return g;
  };
  const V3<T> value = twice_vee<T>(B) / T(2);
  V3<T> d = V3<T>::Zero();
  if (!(is_zero(value[0]) && is_zero(value[1]) && is_zero(value[2]))) {
    const M3<T> Y = derivative(d).inverse();
    const V3<T> step = Y * value;
    const T radius = around_zero<T>(4 * sqrt(T(step.dot(step))));
    if (!(largest(radius) < 0.01)) throw Undecided("no approximate rotation");
    const V3<T> box = V3<T>::Constant(radius);
    d = -step + (M3<T>::Identity() - Y * derivative(box)) * box;
    for (int i = 0; i < 3; ++i)
      if (!(largest(d[i]) < upper(radius))) throw Undecided("the nearest rotation");
  }
  Q4<T> small;
  small << d, T(1);
  return product<T>(Q0, small);  // X^T R is symmetric, and within 1/2 + 0.05 of I, so positive
}

/// q = (p, Q), where Q stands for Q / ||Q||.
template <class T>
Exp<T> integrate(const V7<T>& q, const V6<T>& delta) {
  const Q4<T> Q0 = q.template tail<4>();
  const Exp<T> step = exp<T>(delta);
  Exp<T> r;
  r.Q = product<T>(Q0, step.Q) / T(sqrt(T(Q0.dot(Q0))));
  r.R = rotation<T>(Q0) * step.R;
  r.p = q.template head<3>() + rotate<T>(Q0, step.p);
  return r;
}

template <class T>
Log<T> difference(const V7<T>& q0, const V7<T>& q1, bool opposite = false) {
  const Q4<T> back = conjugate<T>(q0.template tail<4>());
  return log<T>(product<T>(back, q1.template tail<4>()),
                rotate<T>(back, q1.template head<3>() - q0.template head<3>()), opposite);
}

}  // namespace liecheck::enclosures
