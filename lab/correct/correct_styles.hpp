#pragma once
// How the subjects correct:NAME represent rotations and compute on them. Each style is an ordinary way to
// write an SE(3) library: nothing in it is adapted to the limits of the laws. W is the working precision.
//
// A style has a type Rot and static functions: exp, log of a quaternion and of a matrix, the conversions, the
// product and the inverse, rotate, and the other functions of Basics, where it differs from Basics.

#include <Eigen/Geometry>
#include <algorithm>
#include <correct/correct_coefficients.hpp>
#include <subjects/typed.hpp>

namespace liecheck::properties::correct {

/// What the formulas need of a rotation vector phi = m n, m = max(1, theta): no power of m n can overflow.
template <class W>
struct Angle {
  W theta, m;
  Vec<W, 3> n;
  Coefficients<W> c;
};

/// The unit quaternion (w >= 0 only for the largest pivot w) of a rotation matrix: Shepperd 1978.
template <class W>
Vec<W, 4> quaternion_of_matrix(const Mat<W, 3>& R) {
  return Eigen::Quaternion<W>(R).normalized().coeffs();
}
template <class W>
W length(const Vec<W, 3>& v) {
  return std::hypot(v[0], v[1], v[2]);
}

/// a y - b x with the rounding of b x restored by a fused multiply-add (Kahan).
template <class W>
W difference_of_products(const W& a, const W& y, const W& b, const W& x) {
  const W bx = b * x;
  return std::fma(a, y, -bx) + std::fma(-b, x, bx);
}
template <class W>
Vec<W, 3> exact_cross(const Vec<W, 3>& a, const Vec<W, 3>& b) {
  return {difference_of_products(a[1], b[2], a[2], b[1]), difference_of_products(a[2], b[0], a[0], b[2]),
          difference_of_products(a[0], b[1], a[1], b[0])};
}

/// The usual formulas.
template <class Style, class W>
struct Basics : Types<W> {
  using Scalar = W;
  using typename Types<W>::V3, typename Types<W>::V4, typename Types<W>::V6, typename Types<W>::M3,
      typename Types<W>::M6;

  static V3 top(const V6& v) { return v.template head<3>(); }
  static V3 low(const V6& v) { return v.template tail<3>(); }
  static V6 stack(const V3& a, const V3& b) { return (V6() << a, b).finished(); }
  static M6 blocks(const M3& J, const M3& C) { return (M6() << J, C, M3::Zero(), J).finished(); }

  static V3 cross(const V3& a, const V3& b) { return a.cross(b); }
  static Coefficients<W> coefficients(const W& theta) { return by_half_angles(theta); }
  static Angle<W> angle(const V3& phi) {
    const W theta = phi.norm(), m = std::max(W(1), theta);
    return {theta, m, phi / m, Style::coefficients(theta)};
  }
  static V4 product_of_quaternions(const V4& a, const V4& b) {
    const V3 u = a.template head<3>(), v = b.template head<3>();
    return (V4() << a[3] * v + b[3] * u + u.cross(v), a[3] * b[3] - u.dot(v)).finished();
  }
  static V4 exp_quaternion(const V3& phi) {
    const W theta = phi.norm(), h = theta > 0 ? std::sin(theta / 2) / theta : W(0.5);
    return (V4() << h * phi, std::cos(theta / 2)).finished();
  }
  /// sgn(w) angle(|v|, |w|) v / |v|
  template <class F>
  static V3 log_by(const V4& Q, F angle) {
    const V3 v = Q.template head<3>();
    const W s = length<W>(v);
    return s > 0 ? V3((Q[3] < 0 ? -1 : 1) * angle(s, std::abs(Q[3])) / s * v) : V3(V3::Zero());
  }
  static V3 log(const V4& Q) {
    return log_by(Q, [](W s, W w) { return 2 * std::atan2(s, w); });
  }
  static V3 log_of_matrix(const M3& R) { return Style::log(quaternion_of_matrix<W>(R)); }

  /// J_l = I + c_2 [phi] + c_3 [phi]^2
  static M3 jacobian(const V3& phi) {
    const Angle<W> a = angle(phi);
    const M3 N = hat(a.n);
    return M3::Identity() + a.m * a.c[2] * N + a.m * a.m * a.c[3] * (N * N);
  }
  static M3 jacobian_inverse(const V3& phi) {
    const Angle<W> a = angle(phi);
    const M3 N = hat(a.n);
    return M3::Identity() - a.m / 2 * N + a.m * a.m * InverseCoefficients<W>(a.theta, a.c).e * (N * N);
  }
  /// J_l rho
  static V3 arc(const V3& phi, const V3& rho) {
    const Angle<W> a = angle(phi);
    const V3 across = Style::cross(a.n, rho);
    return rho + a.m * a.c[2] * across + a.m * a.m * a.c[3] * Style::cross(a.n, across);
  }
  static V3 arc_inverse(const V3& phi, const V3& p) {
    const Angle<W> a = angle(phi);
    const V3 across = Style::cross(a.n, p);
    return p - a.m / 2 * across +
           a.m * a.m * InverseCoefficients<W>(a.theta, a.c).e * Style::cross(a.n, across);
  }
  /// The derivative of J_l in the direction rho, as J_l of the dual vector phi + e rho.
  static M6 jacobian6(const V6& xi) {
    const Angle<W> a = angle(low(xi));
    const auto& c = a.c;
    return derivative(xi, a, c[2], c[3], slope(2, a.theta, c), slope(3, a.theta, c));
  }
  static M6 jacobian6_inverse(const V6& xi) {
    const Angle<W> a = angle(low(xi));
    const InverseCoefficients<W> i(a.theta, a.c);
    return derivative(xi, a, W(-0.5), i.e, W(0), 2 * i.slope);
  }
  /// I + f [phi] + g [phi]^2 and its derivative. df and dg are the derivatives by theta, over theta.
  static M6 derivative(const V6& xi, const Angle<W>& a, W f, W g, W df, W dg) {
    const M3 N = hat(a.n), P = hat(top(xi)), N2 = N * N;
    const W along = a.m * a.m * a.n.dot(top(xi));
    return blocks(M3::Identity() + a.m * f * N + a.m * a.m * g * N2,
                  f * P + a.m * g * (N * P + P * N) + along * (df * N + a.m * dg * N2));
  }

  /// R a + p x R b: the linear part of a motion, the angular part of a force; and its inverse.
  template <class Rot>
  static V3 transport(const Rot& R, const V3& p, const V3& a, const V3& b) {
    return Style::rotate(R, a) + Style::cross(p, Style::rotate(R, b));
  }
  template <class Rot>
  static V3 transport_back(const Rot& R, const V3& p, const V3& a, const V3& b) {
    return Style::rotate(Style::inverse(R), V3(a - Style::cross(p, b)));
  }
  /// a x b' + b x a' for dual vectors.
  static V3 cross_dual(const V3& a, const V3& b, const V3& c, const V3& d) {
    return Style::cross(a, d) + Style::cross(b, c);
  }
  static M6 inertia_matrix(const Body<W>& I) {
    const M3 c = hat(I.c);
    return (M6() << I.mass * M3::Identity(), -I.mass * c, I.mass * c, I.I_C - I.mass * (c * c)).finished();
  }
  static V6 momentum(const Body<W>& I, const V6& V) {
    const V3 f = I.mass * (top(V) + Style::cross(low(V), I.c));
    return stack(f, I.I_C * low(V) + Style::cross(I.c, f));
  }
  static W energy(const Body<W>& I, const V6& V) {
    const V3 u = top(V) + Style::cross(low(V), I.c);
    return (I.mass * u.squaredNorm() + low(V).dot(I.I_C * low(V))) / 2;
  }
};

/// Rotations stored as unit quaternions; half angles; v + 2 w q x v + 2 q x (q x v).
template <class W>
struct Quaternions : Basics<Quaternions<W>, W> {
  using B = Basics<Quaternions<W>, W>;
  using typename B::V3, typename B::V4, typename B::M3;
  using Rot = V4;
  static Rot from_quaternion(const V4& Q) { return Q; }
  static Rot from_matrix(const M3& R) { return quaternion_of_matrix<W>(R); }
  static V4 quaternion(const Rot& Q) { return Q.normalized(); }
  static M3 matrix(const Rot& Q) { return Eigen::Quaternion<W>(Q).toRotationMatrix(); }
  static Rot exp(const V3& phi) { return B::exp_quaternion(phi); }
  static Rot product(const Rot& a, const Rot& b) { return B::product_of_quaternions(a, b); }
  static Rot inverse(const Rot& Q) { return {-Q[0], -Q[1], -Q[2], Q[3]}; }
  static V3 rotate(const Rot& Q, const V3& v) {
    const V3 q = Q.template head<3>(), t = 2 * q.cross(v);
    return v + Q[3] * t + q.cross(t);
  }
};

/// Rotations stored as matrices.
template <class Style, class W>
struct MatrixBasics : Basics<Style, W> {
  using B = Basics<Style, W>;
  using typename B::V3, typename B::V4, typename B::M3;
  using Rot = M3;
  static Rot from_quaternion(const V4& Q) { return Eigen::Quaternion<W>(Q).normalized().toRotationMatrix(); }
  static Rot from_matrix(const M3& R) { return R; }
  static V4 quaternion(const Rot& R) { return quaternion_of_matrix<W>(R); }
  static M3 matrix(const Rot& R) { return R; }
  static Rot exp(const V3& phi) {
    const Angle<W> a = B::angle(phi);
    const M3 N = hat(a.n);
    return M3::Identity() + a.m * a.c[1] * N + a.m * a.m * a.c[2] * (N * N);
  }
  static Rot product(const Rot& a, const Rot& b) { return a * b; }
  static Rot inverse(const Rot& R) { return R.transpose(); }
  static V3 rotate(const Rot& R, const V3& v) { return R * v; }
  /// theta n from 2 sin(theta) n = vee(R - R^T), cos(theta), and n n^T for obtuse angles.
  template <class F>
  static V3 log_by_trace(const M3& R, F angle) {
    const V3 a(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
    const W sine = length<W>(a) / 2, cosine = (R.trace() - 1) / 2;
    if (sine == 0 && cosine > 0) return V3::Zero();
    const W theta = angle(sine, cosine);
    if (cosine > 0) return theta / (2 * sine) * a;
    int k = 0;
    R.diagonal().maxCoeff(&k);
    V3 n = (R.col(k) + R.row(k).transpose()) / 2;  // (1 - cos theta) n n_k + cos(theta) e_k
    n[k] -= cosine;
    return (n.dot(a) < 0 ? -theta : theta) / length<W>(n) * n;
  }
};

/// 3 x 3 matrices, dense 6 x 6 adjoint and inertia matrices, polynomials of ad.
template <class W>
struct Matrices : MatrixBasics<Matrices<W>, W> {
  using B = MatrixBasics<Matrices<W>, W>;
  using typename B::V3, typename B::V4, typename B::V6, typename B::M3, typename B::M6;
  static Coefficients<W> coefficients(const W& theta) { return by_full_angles(theta); }
  static V3 cross(const V3& a, const V3& b) { return hat(a) * b; }
  /// The angle of the matrix of Q: sin(theta) = 2 |w| |v|, cos(theta) = w^2 - |v|^2.
  static V3 log(const V4& Q) {
    return B::log_by(Q, [](W s, W w) { return std::atan2(2 * s * w, (w - s) * (w + s)); });
  }
  static V3 log_of_matrix(const M3& R) {
    return B::log_by_trace(R, [](W s, W c) { return std::atan2(s, c); });
  }
  static V3 transport(const M3& R, const V3& p, const V3& a, const V3& b) {
    return B::top(B::blocks(R, hat(p) * R) * B::stack(a, b));
  }
  static V3 transport_back(const M3& R, const V3& p, const V3& a, const V3& b) {
    return B::top(B::blocks(R.transpose(), -R.transpose() * hat(p)) * B::stack(a, b));
  }
  static V3 cross_dual(const V3& a, const V3& b, const V3& c, const V3& d) {
    return B::top(B::blocks(hat(a), hat(b)) * B::stack(d, c));
  }
  static V6 momentum(const Body<W>& I, const V6& V) { return B::inertia_matrix(I) * V; }
  static W energy(const Body<W>& I, const V6& V) { return V.dot(B::inertia_matrix(I) * V) / 2; }
  /// I + b_1 A + b_2 A^2 + b_3 A^3 + b_4 A^4 with A = ad / m and b_k = m^k a_k: Selig 2005, section 7.6.
  static M6 polynomial(const V6& xi, const W& m, const std::array<W, 4>& b) {
    const V6 y = xi / m;
    const M6 A = B::blocks(hat(B::low(y)), hat(B::top(y))), A2 = A * A;
    return M6::Identity() + (b[0] * M6::Identity() + b[2] * A2) * A +
           (b[1] * M6::Identity() + b[3] * A2) * A2;
  }
  static M6 jacobian6(const V6& xi) {
    const Angle<W> t = B::angle(B::low(xi));
    const auto& c = t.c;
    const W m = t.m, x = m * m;
    if (t.theta >= W(2))
      return polynomial(xi, m,
                        {m * (2 * c[2] - c[1] / 2), (4 - 5 * c[1] + c[0]) / 2, m * (2 * c[2] - c[1]) / 2,
                         (2 - 3 * c[1] + c[0]) / 2});
    return polynomial(xi, m,
                      {m * (2 * c[2] - c[1] / 2), x * (5 * c[3] - c[2]) / 2, m * x * (c[3] - 2 * c[4]) / 2,
                       x * x * (c[4] - 3 * c[5]) / 2});
  }
  static M6 jacobian6_inverse(const V6& xi) {
    const Angle<W> t = B::angle(B::low(xi));
    const InverseCoefficients<W> i(t.theta, t.c);
    const W x = t.m * t.m;
    return polynomial(xi, t.m, {-t.m / 2, x * (i.e - t.theta * t.theta * i.slope), W(0), -x * (x * i.slope)});
  }
};

}  // namespace liecheck::properties::correct
