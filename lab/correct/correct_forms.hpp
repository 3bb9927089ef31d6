#pragma once
// More styles of the subjects correct:NAME (correct_styles.hpp).

#include <correct/correct_styles.hpp>

namespace liecheck::properties::correct {

/// The closed forms as books print them, with series near 0: acos and asin, Barfoot & Furgale 2014, eq. 102.
template <class Style, class W>
struct BookBasics : MatrixBasics<Style, W> {
  using B = MatrixBasics<Style, W>;
  using typename B::V3, typename B::V4, typename B::V6, typename B::M3, typename B::M6;
  static M3 coupling(const V6& xi) {
    const Angle<W> t = B::angle(B::low(xi));
    const M3 p = hat(t.n), r = hat(B::top(xi)), pr = p * r, rp = r * p, prp = p * rp;
    const auto& c = t.c;
    return r / 2 + t.m * c[3] * (pr + rp + t.m * prp) + t.m * t.m * c[4] * (p * pr + rp * p - 3 * prp) -
           t.m * t.m * t.m * slope(3, t.theta, c) / 2 * (prp * p + p * prp);
  }
  static M6 jacobian6(const V6& xi) { return B::blocks(B::jacobian(B::low(xi)), Style::coupling(xi)); }
  /// -J^-1 C J^-1 squares the large J^-1 near 2 pi k, so that it is used only up to pi.
  static M6 jacobian6_inverse(const V6& xi) {
    if (B::low(xi).norm() > W(3.2)) return B::jacobian6_inverse(xi);
    const M3 inverse = B::jacobian_inverse(B::low(xi));
    return B::blocks(inverse, -inverse * Style::coupling(xi) * inverse);
  }
  /// I_O w + m c x u with the inertia about the origin.
  static V6 momentum(const Body<W>& I, const V6& V) {
    const V3 u = B::top(V), w = B::low(V);
    const M3 I_O = I.I_C + I.mass * (I.c.squaredNorm() * M3::Identity() - I.c * I.c.transpose());
    return B::stack(I.mass * u - I.mass * I.c.cross(w), I_O * w + I.mass * I.c.cross(u));
  }
  static W energy(const Body<W>& I, const V6& V) { return V.dot(momentum(I, V)) / 2; }
};

/// acos away from 0 and pi, asin near them.
template <class W>
struct Books : BookBasics<Books<W>, W> {
  using B = BookBasics<Books<W>, W>;
  using typename B::V3, typename B::V4, typename B::M3;
  static constexpr W pi = W(3.14159265358979323846264338327950288L);
  static Coefficients<W> coefficients(const W& theta) { return by_full_angles(theta); }
  static W angle_of(const W& sine, const W& cosine) {
    if (std::abs(cosine) < W(0.7)) return std::acos(cosine);
    return cosine > 0 ? std::asin(std::min(W(1), sine)) : W(pi - std::asin(std::min(W(1), sine)));
  }
  static V3 log(const V4& Q) {
    return B::log_by(Q.normalized(), [](W s, W w) { return 2 * angle_of(s, w); });
  }
  static V3 log_of_matrix(const M3& R) { return B::log_by_trace(R, angle_of); }
};

/// R = I + 2 w [v] + 2 [v]^2 with the half angle's v and w, moments about the other point first.
template <class W>
struct HalfAngles : BookBasics<HalfAngles<W>, W> {
  using B = BookBasics<HalfAngles<W>, W>;
  using typename B::V3, typename B::V4, typename B::M3;
  static M3 from_quaternion(const V4& Q) {
    const M3 v = hat<W>(Q.template head<3>());
    return M3::Identity() + 2 / Q.squaredNorm() * (Q[3] * v + v * v);
  }
  static M3 exp(const V3& phi) { return from_quaternion(B::exp_quaternion(phi)); }
  static V3 log(const V4& Q) {
    return B::log_by(Q, [](W s, W w) {
      return s < w ? 2 * std::asin(s / std::hypot(s, w)) : 2 * std::acos(w / std::hypot(s, w));
    });
  }
  static V3 log_of_matrix(const M3& R) { return log(quaternion_of_matrix<W>(R)); }
  static V3 transport(const M3& R, const V3& p, const V3& a, const V3& b) {
    return R * (a + (R.transpose() * p).cross(b));
  }
  static V3 transport_back(const M3& R, const V3& p, const V3& a, const V3& b) {
    return R.transpose() * a - (R.transpose() * p).cross(R.transpose() * b);
  }
};

/// Rotations stored as rotation vectors: R v = cos(theta) v + sin(theta) n x v + (1 - cos(theta)) n (n . v).
template <class W>
struct RotationVectors : Basics<RotationVectors<W>, W> {
  using B = Basics<RotationVectors<W>, W>;
  using typename B::V3, typename B::V4, typename B::M3;
  using Rot = V3;
  static Rot from_quaternion(const V4& Q) { return log(Q); }
  static Rot from_matrix(const M3& R) { return log(quaternion_of_matrix<W>(R)); }
  static V4 quaternion(const Rot& phi) { return B::exp_quaternion(phi); }
  static M3 matrix(const Rot& phi) {
    M3 R;
    for (int i = 0; i < 3; ++i) R.col(i) = rotate(phi, V3::Unit(i));
    return R;
  }
  static Rot exp(const V3& phi) { return phi; }
  static V3 log(const V4& Q) {
    return B::log_by(Q, [](W s, W w) { return 2 * std::atan(s / w); });
  }
  static Rot product(const Rot& a, const Rot& b) {
    return log(B::product_of_quaternions(quaternion(a), quaternion(b)));
  }
  static Rot inverse(const Rot& phi) { return -phi; }
  static V3 rotate(const Rot& phi, const V3& v) {
    const Angle<W> t = B::angle(phi);
    return t.c[0] * v + t.m * t.c[1] * cross(t.n, v) + t.m * t.m * t.c[2] * t.n.dot(v) * t.n;
  }
  static V3 cross(const V3& a, const V3& b) { return exact_cross(a, b); }
};

/// Rotations stored as s = tan(theta/4) n, |s| <= 1, with R = C^2 of the Cayley transform
/// C = (I - [s])^-1 (I + [s]) = ((1 - s^2) I + 2 [s] + 2 s s^T) / (1 + s^2).
template <class W>
struct Cayley : Basics<Cayley<W>, W> {
  using B = Basics<Cayley<W>, W>;
  using typename B::V3, typename B::V4, typename B::M3;
  using Rot = V3;
  static Coefficients<W> coefficients(const W& theta) { return by_tangents(theta); }
  static Rot from_quaternion(const V4& Q) {
    return Q.template head<3>() / (Q[3] + (Q[3] < 0 ? -Q.norm() : Q.norm()));
  }
  static Rot from_matrix(const M3& R) { return from_quaternion(quaternion_of_matrix<W>(R)); }
  static V4 quaternion(const Rot& s) {
    const W x = s.squaredNorm();
    return (V4() << 2 * s, 1 - x).finished() / (1 + x);
  }
  static M3 matrix(const Rot& s) {
    const M3 C = transform(s);
    return C * C;
  }
  static Rot exp(const V3& phi) {
    const W theta = phi.norm();
    if (theta == 0) return phi / 4;
    const W t = std::tan(theta / 4);
    return (std::abs(t) > 1 ? -1 / t : t) / theta * phi;
  }
  static V3 log(const V4& Q) {
    return B::log_by(Q, [](W s, W w) { return 4 * std::atan(s / (w + std::hypot(s, w))); });
  }
  static Rot product(const Rot& a, const Rot& b) {
    return from_quaternion(B::product_of_quaternions(quaternion(a), quaternion(b)));
  }
  static Rot inverse(const Rot& s) { return -s; }
  static M3 transform(const Rot& s) {
    const W x = s.squaredNorm();
    return ((1 - x) * M3::Identity() + 2 * hat(s) + 2 * s * s.transpose()) / (1 + x);
  }
  static V3 rotate(const Rot& s, const V3& v) {
    const M3 C = transform(s);
    return C * (C * v);
  }
};

/// Poses stored as unit dual quaternions r + e d, d = p r / 2, and motions and forces as dual vectors.
template <class W>
struct DualQuaternions : Basics<DualQuaternions<W>, W> {
  using B = Basics<DualQuaternions<W>, W>;
  using typename B::V3, typename B::V4, typename B::M3;
  using Rot = V4;
  static Rot from_quaternion(const V4& Q) { return Q.normalized(); }
  static Rot from_matrix(const M3& R) { return quaternion_of_matrix<W>(R); }
  static V4 quaternion(const Rot& r) { return r.normalized(); }
  static M3 matrix(const Rot& r) { return Eigen::Quaternion<W>(r).toRotationMatrix(); }
  static Rot exp(const V3& phi) { return B::exp_quaternion(phi); }
  static Rot product(const Rot& a, const Rot& b) { return B::product_of_quaternions(a, b); }
  static Rot inverse(const Rot& r) { return {-r[0], -r[1], -r[2], r[3]}; }
  static V4 pure(const V3& v) { return (V4() << v, W(0)).finished(); }
  static V4 dual_part(const Rot& r, const V3& p) { return product(pure(p), r) / 2; }
  static V3 rotate(const Rot& r, const V3& v) {
    return product(product(r, pure(v)), inverse(r)).template head<3>();
  }
  /// The dual part of (r + e d)(b + e a)(r + e d)*.
  static V3 transport(const Rot& r, const V3& p, const V3& a, const V3& b) {
    const V4 d = dual_part(r, p), real = product(r, pure(b)),
             dual = product(r, pure(a)) + product(d, pure(b));
    return (product(dual, inverse(r)) + product(real, inverse(d))).template head<3>();
  }
  static V3 transport_back(const Rot& r, const V3& p, const V3& a, const V3& b) {
    return transport(inverse(r), V3(-rotate(inverse(r), p)), a, b);
  }
  /// (a b - b a) / 2 of pure quaternions.
  static V3 cross(const V3& a, const V3& b) {
    return (product(pure(a), pure(b)) - product(pure(b), pure(a))).template head<3>() / 2;
  }
  /// exp of the dual vector (phi + e rho) / 2: p = 2 d r*.
  static V3 arc(const V3& phi, const V3& rho) {
    const W theta = phi.norm(), along = phi.dot(rho);
    const Coefficients<W> c = by_half_angles(W(theta / 2));
    const W h = c[1] / 2, slope = (c[3] - c[2]) / 8;  // h = sin(theta/2) / theta; slope = h' / theta
    const V4 r = (V4() << h * phi, c[0]).finished(),
             d = (V4() << h * rho + slope * along * phi, -h / 2 * along).finished();
    return 2 * product(d, inverse(r)).template head<3>();
  }
  /// log of the dual quaternion: phi = f v with f = theta / sin(theta/2), rho = f d + (df) v.
  static V3 arc_inverse(const V3& phi, const V3& p) {
    const W theta = phi.norm(), x = theta * theta / 4;
    const Coefficients<W> c = by_half_angles(W(theta / 2));
    const W f = 2 / c[1];
    const V4 r = (V4() << phi / f, c[0]).finished(), d = dual_part(r, p);
    // (2 w - f) / |v|^2 = 2 (c_0 c_1 - 1) / (x c_1^3), and c_0 c_1 - 1 = -x (c_2 + c_3 - x c_2 c_3)
    const W slope = -2 * (c[2] + c[3] - x * c[2] * c[3]) / (c[1] * c[1] * c[1]);
    const V3 v = r.template head<3>(), d_v = d.template head<3>();
    return f * d_v + (slope * v.dot(d_v) - 2 * d[3]) * v;
  }
};

}  // namespace liecheck::properties::correct
