#pragma once
// The subjects correct:NAME: ordinary implementations of the operations on poses and bodies that differ from
// liecheck and from each other in representation and formulas (correct_styles.hpp, correct_forms.hpp). They
// share no code with the library. A law that refuses one of them asks for more than a correct library can
// give; `lab limits` measures what each of them needs. They run only if they are named.
//
// A quaternion that is off unit by 8 eps, or a matrix that is off orthogonal, is not repaired by every style:
// the limits of a style include what it makes of such inputs.

#include <correct/correct_forms.hpp>

namespace liecheck::properties::correct {

/// Q0* Q1 / |Q0* Q1|. Products of stored numbers are exact in 113 bits, so that rotations that are nearly equal
/// keep their digits although the norms differ.
Vec<float128, 4> relative_any_norm(const Vec<double, 4>& Q0, const Vec<double, 4>& Q1);

/// The operations of a style in the scalar S. The style computes in its own precision W; results are rounded
/// once at the end.
template <class S, class Style>
struct Correct : Types<S> {
  using W = typename Style::Scalar;
  using typename Types<S>::V3, typename Types<S>::V4, typename Types<S>::V6, typename Types<S>::V7,
      typename Types<S>::M3, typename Types<S>::M6;
  using X3 = Vec<W, 3>;
  using X4 = Vec<W, 4>;
  using X6 = Vec<W, 6>;
  using X66 = Mat<W, 6>;
  using Rot = typename Style::Rot;

  template <class M>
  static auto wide(const M& m) {
    return m.template cast<W>().eval();
  }
  template <class M>
  static auto narrow(const M& m) {
    return m.template cast<S>().eval();
  }
  struct Placement {
    Rot R;
    X3 p;
  };
  static Placement wide(const Pose<S>& X) { return {Style::from_matrix(wide(X.R)), wide(X.p)}; }
  static Pose<S> narrow(const Placement& X) { return {narrow(Style::matrix(X.R)), narrow(X.p)}; }
  static Body<W> wide(const Body<S>& I) { return {W(I.mass), wide(I.c), wide(I.I_C)}; }
  static Placement inverted(const Placement& X) {
    const Rot R = Style::inverse(X.R);
    return {R, -Style::rotate(R, X.p)};
  }
  static Placement exp(const X6& xi) {
    return {Style::exp(Style::low(xi)), Style::arc(Style::low(xi), Style::top(xi))};
  }

  static V4 exp3_quaternion(const V3& phi) { return narrow(Style::quaternion(Style::exp(wide(phi)))); }
  static M3 exp3_matrix(const V3& phi) { return narrow(Style::matrix(Style::exp(wide(phi)))); }
  static V3 log3_quaternion(const V4& Q) { return narrow(Style::log(wide(Q))); }
  static V3 log3_matrix(const M3& R) { return narrow(Style::log_of_matrix(wide(R))); }
  static Pose<S> exp6(const V6& xi) { return narrow(exp(wide(xi))); }
  static V6 log6(const Pose<S>& X) {
    const X3 phi = Style::log_of_matrix(wide(X.R));
    return narrow(Style::stack(Style::arc_inverse(phi, wide(X.p)), phi));
  }
  static M3 left_jacobian3(const V3& phi) { return narrow(Style::jacobian(wide(phi))); }
  static M3 right_jacobian3(const V3& phi) { return left_jacobian3(-phi); }
  static M3 left_jacobian3_inverse(const V3& phi) { return narrow(Style::jacobian_inverse(wide(phi))); }
  static M3 right_jacobian3_inverse(const V3& phi) { return left_jacobian3_inverse(-phi); }
  static M6 left_jacobian6(const V6& xi) { return narrow(Style::jacobian6(wide(xi))); }
  static M6 right_jacobian6(const V6& xi) { return left_jacobian6(-xi); }
  static M6 left_jacobian6_inverse(const V6& xi) { return narrow(Style::jacobian6_inverse(wide(xi))); }
  static M6 right_jacobian6_inverse(const V6& xi) { return left_jacobian6_inverse(-xi); }

  static Pose<S> compose(const Pose<S>& X, const Pose<S>& Y) {
    const Placement x = wide(X), y = wide(Y);
    return narrow(Placement{Style::product(x.R, y.R), Style::rotate(x.R, y.p) + x.p});
  }
  static Pose<S> inverse(const Pose<S>& X) { return narrow(inverted(wide(X))); }
  static V3 act_point(const Pose<S>& X, const V3& x) {
    const Placement at = wide(X);
    return narrow(Style::rotate(at.R, wide(x)) + at.p);
  }
  static V3 rotate_point(const V4& Q, const V3& x) {
    return narrow(Style::rotate(Style::from_quaternion(wide(Q)), wide(x)));
  }

  static V6 act_motion(const Pose<S>& X, const V6& V) {
    const Placement x = wide(X);
    const X3 u = wide(Style6::top(V)), w = wide(Style6::low(V));
    return narrow(Style::stack(Style::transport(x.R, x.p, u, w), Style::rotate(x.R, w)));
  }
  static V6 act_inverse_motion(const Pose<S>& X, const V6& V) {
    const Placement x = wide(X);
    const X3 u = wide(Style6::top(V)), w = wide(Style6::low(V));
    return narrow(Style::stack(Style::transport_back(x.R, x.p, u, w), Style::rotate(Style::inverse(x.R), w)));
  }
  static V6 act_force(const Pose<S>& X, const V6& F) { return swapped(act_motion(X, swapped(F))); }
  static V6 act_inverse_force(const Pose<S>& X, const V6& F) {
    return swapped(act_inverse_motion(X, swapped(F)));
  }
  static V6 swapped(const V6& v) { return Style6::stack(Style6::low(v), Style6::top(v)); }
  static V6 cross_motion(const V6& V, const V6& W_) {
    const X6 v = wide(V), w = wide(W_);
    return narrow(Style::stack(Style::cross_dual(Style::low(v), Style::top(v), Style::low(w), Style::top(w)),
                               Style::cross(Style::low(v), Style::low(w))));
  }
  static V6 cross_force(const V6& V, const V6& F) { return swapped(cross_motion(V, swapped(F))); }

  /// R M R^T, column by column.
  static M3 turned(const Rot& R, const M3& M) {
    Mat<W, 3> A = wide(M);
    for (int pass = 0; pass < 2; ++pass) {
      for (int i = 0; i < 3; ++i) A.col(i) = Style::rotate(R, X3(A.col(i)));
      A.transposeInPlace();
    }
    return narrow(A);
  }
  static Body<S> act_inertia(const Pose<S>& X, const Body<S>& I) {
    return {I.mass, act_point(X, I.c), turned(Style::from_matrix(wide(X.R)), I.I_C)};
  }
  static Body<S> act_inverse_inertia(const Pose<S>& X, const Body<S>& I) {
    const Rot R = Style::inverse(Style::from_matrix(wide(X.R)));
    return {I.mass, narrow(Style::rotate(R, X3(wide(I.c) - wide(X.p)))), turned(R, I.I_C)};
  }
  static V6 momentum(const Body<S>& I, const V6& V) { return narrow(Style::momentum(wide(I), wide(V))); }
  static S kinetic_energy(const Body<S>& I, const V6& V) { return S(Style::energy(wide(I), wide(V))); }
  static M6 inertia_matrix(const Body<S>& I) { return narrow(Style::inertia_matrix(wide(I))); }

  static V7 integrate(const V7& q, const V6& delta) {
    const X4 Q0 = wide(V4(q.template tail<4>()));
    const Placement T0{Style::from_quaternion(Q0), wide(V3(q.template head<3>()))}, T = exp(wide(delta));
    const X4 Q = Style::quaternion(Style::product(T0.R, T.R));
    V7 result;
    result << narrow(T0.p + Style::rotate(T0.R, T.p)), narrow(Q.dot(Q0) < 0 ? X4(-Q) : Q);
    return result;
  }
  /// Q0* Q1. Its vector part is that of Q0* (Q1 - Q0): nothing cancels if the rotations are nearly equal. What
  /// Q1 - Q0 has along Q0, because the norms differ, cancels in products that are rounded once.
  static X4 relative(const X4& Q0, const X4& Q1) {
    const X4 d = Q0.dot(Q1) < 0 ? X4(-Q1 - Q0) : X4(Q1 - Q0);
    const X3 a = Q0.template head<3>(), b = d.template head<3>(), turn = exact_cross<W>(a, b);
    X4 Q;
    for (int i = 0; i < 3; ++i) Q[i] = difference_of_products<W>(Q0[3], b[i], d[3], a[i]) - turn[i];
    Q[3] = std::abs(Q0.dot(Q1));
    return Q;
  }
  static X6 between(const V7& q0, const V7& q1) {
    const X4 Q0 = wide(V4(q0.template tail<4>())), Q1 = wide(V4(q1.template tail<4>()));
    return between(q0, q1, Q0, relative(Q0, Q1));
  }
  /// `turn` is the rotation from Q0 to the quaternion of q1.
  static X6 between(const V7& q0, const V7& q1, const X4& Q0, const X4& turn) {
    const X3 phi = Style::log(turn),
             apart = wide(V3(q1.template head<3>())) - wide(V3(q0.template head<3>()));
    const X3 p = Style::rotate(Style::inverse(Style::from_quaternion(Q0)), apart);
    return Style::stack(Style::arc_inverse(phi, p), phi);
  }
  static V6 difference(const V7& q0, const V7& q1) { return narrow(between(q0, q1)); }
  static M6 d_integrate_arg0(const V7&, const V6& delta) {
    const Placement T = exp(wide(V6(-delta)));
    const Mat<W, 3> R = Style::matrix(T.R);
    return narrow(Style::blocks(R, hat(T.p) * R));
  }
  static M6 d_integrate_arg1(const V7&, const V6& delta) { return right_jacobian6(delta); }
  static M6 d_difference_arg0(const V7& q0, const V7& q1) {
    return narrow(X66(-Style::jacobian6_inverse(between(q0, q1))));
  }
  static M6 d_difference_arg1(const V7& q0, const V7& q1) {
    return narrow(Style::jacobian6_inverse(X6(-between(q0, q1))));
  }
  /// [[R, 0], [0, (w I + [v]) / 2], [0, -v^T / 2]] for Q = (v, w).
  static Mat<S, 7, 6> integrate_coefficient_jacobian(const V7& q) {
    const V4 Q = q.template tail<4>();
    const V3 v = Q.template head<3>();
    Mat<S, 7, 6> J = Mat<S, 7, 6>::Zero();
    J.template topLeftCorner<3, 3>() = narrow(Style::matrix(Style::from_quaternion(wide(Q))));
    J.template block<3, 3>(3, 3) = (Q[3] * M3::Identity() + hat(v)) / 2;
    J.template bottomRightCorner<1, 3>() = -v.transpose() / 2;
    return J;
  }

  /// Q/|Q|, first divided by its largest number, so that no square overflows or underflows.
  static X4 unit(const V4& Q) { return wide(V4(Q / Q.cwiseAbs().maxCoeff())).normalized(); }
  static V4 normalize(const V4& Q) { return narrow(unit(Q)); }
  static V4 first_order_normalize(const V4& Q) {
    const X4 q = wide(Q);
    return narrow(X4(q * ((3 - q.squaredNorm()) / 2)));
  }
  static M3 matrix_from_quaternion_any_norm(const V4& Q) {
    return narrow(Style::matrix(Style::from_quaternion(unit(Q))));
  }
  static V3 rotate_point_any_norm(const V4& Q, const V3& x) { return rotate_point(normalize(Q), x); }
  static V3 log3_any_norm(const V4& Q) { return narrow(Style::log(unit(Q))); }
  static V7 integrate_any_norm(const V7& q, const V6& delta) {
    return integrate((V7() << q.template head<3>(), normalize(q.template tail<4>())).finished(), delta);
  }
  static X6 between_any_norm(const V7& q0, const V7& q1) {
    const V4 Q0 = q0.template tail<4>(), Q1 = q1.template tail<4>();
    return between(
        q0, q1, unit(Q0),
        relative_any_norm(Q0.template cast<double>(), Q1.template cast<double>()).template cast<W>());
  }
  static V6 difference_any_norm(const V7& q0, const V7& q1) { return narrow(between_any_norm(q0, q1)); }
  static M6 d_difference_any_norm(const V7& q0, const V7& q1) {
    return narrow(Style::jacobian6_inverse(X6(-between_any_norm(q0, q1))));
  }

  // Between rotations and directions.
  static S relative_angle(const V4& Q0, const V4& Q1) {
    return S(Style::log(relative(wide(Q0), wide(Q1))).stableNorm());
  }
  static S twist_angle(const V4& Q, const V3& axis) {
    const W s = wide(V3(Q.template head<3>())).dot(wide(axis)), w = W(Q[3]);
    return S(w < 0 ? 2 * std::atan2(-s, -w) : 2 * std::atan2(s, w));
  }
  static V4 slerp(const V4& Q0, const V4& Q1, const S& t) {
    const X3 phi = Style::log(relative(wide(Q0), wide(Q1)));
    return narrow(
        X4(Style::quaternion(Style::product(Style::from_quaternion(wide(Q0)), Style::exp(W(t) * phi)))
               .normalized()));
  }
  /// exp of the angle times a x b / |a x b|. For opposite directions any perpendicular axis is right.
  static V4 rotation_between(const V3& a, const V3& b) {
    const X3 from = wide(a).normalized(), to = wide(b).normalized(), c = exact_cross<W>(from, to);
    X3 n = c.isZero(0) ? X3(from.unitOrthogonal()) : X3(c / c.stableNorm());
    n = X3(n - from.dot(n) * from);
    n = n.squaredNorm() < W(0.5) ? X3(from.unitOrthogonal()) : X3(n.normalized());
    return narrow(Style::quaternion(Style::exp(std::atan2(c.stableNorm(), from.dot(to)) * n)));
  }

  /// Axes i, j and the third one of an order with rotating axes. Static axes are rotating ones in the opposite order.
  struct Axes {
    int i, j, k;
    bool proper, reversed;
    W sign;
    explicit Axes(const S& order) {
      const int n = static_cast<int>(order), s = n / 2;
      proper = s >= 6, reversed = n % 2 == 0;
      i = s % 6 / 2, j = ((s % 2 == 0) == (i != 1) ? i + 1 : i + 2) % 3, k = 3 - i - j;
      if (reversed && !proper) std::swap(i, k);
      sign = (j - i + 3) % 3 == 1 ? 1 : -1;
    }
    V3 ordered(const V3& x) const { return reversed ? V3(x.reverse()) : x; }
  };
  static Rot turn(int axis, const W& angle) { return Style::exp(angle * X3(X3::Unit(axis))); }
  static Rot euler(const S& order, const V3& angles) {
    const Axes o(order);
    const X3 x = wide(o.ordered(angles));
    return Style::product(Style::product(turn(o.i, x[0]), turn(o.j, x[1])), turn(o.proper ? o.i : o.k, x[2]));
  }
  static V4 euler_to_quaternion(const S& order, const V3& x) {
    return narrow(Style::quaternion(euler(order, x)));
  }
  static M3 euler_to_matrix(const S& order, const V3& x) { return narrow(Style::matrix(euler(order, x))); }
  /// The first angle by entries of R; the others by those of R_i(-a) R, which are right at gimbal lock, too.
  static V3 euler_from(const S& order, const Mat<W, 3>& R) {
    const Axes o(order);
    const int i = o.i, j = o.j, k = o.k;
    const W a = o.proper ? std::atan2(R(j, i), -o.sign * R(k, i)) : std::atan2(-o.sign * R(j, k), R(k, k));
    const Mat<W, 3> rest = Style::matrix(turn(i, -a)) * R;
    const W b =
        o.proper ? std::atan2(-o.sign * rest(k, i), rest(i, i)) : std::atan2(o.sign * rest(i, k), rest(k, k));
    const W c =
        o.proper ? std::atan2(-o.sign * rest(j, k), rest(j, j)) : std::atan2(o.sign * rest(j, i), rest(j, j));
    // Rounding may carry the middle angle across the end of its range, where it is 0 or pi/2 up to rounding.
    return o.ordered(narrow(X3(a, o.proper ? std::abs(b) : b, c)));
  }
  static V3 euler_from_quaternion(const S& order, const V4& Q) {
    return euler_from(order, Style::matrix(Style::from_quaternion(wide(Q))));
  }
  static V3 euler_from_matrix(const S& order, const M3& R) { return euler_from(order, wide(R)); }

  static V7 velocity_to_rate(const V7& q, const V6& V) {
    const X4 Q = wide(V4(q.template tail<4>()));
    const X3 v = Q.template head<3>(), omega = wide(Style6::low(V));
    V7 rate;
    rate << narrow(Style::rotate(Style::from_quaternion(Q), X3(wide(Style6::top(V))))),
        narrow(X3((Q[3] * omega + v.cross(omega)) / 2)), S(-v.dot(omega) / 2);
    return rate;
  }
  static V6 rate_to_velocity(const V7& q, const V7& rate) {
    const X4 Q = wide(V4(q.template tail<4>())), Q_dot = wide(V4(rate.template tail<4>()));
    const X3 v = Q.template head<3>(), d = Q_dot.template head<3>();
    const X3 omega = (Q[3] * d - Q_dot[3] * v - v.cross(d)) * (2 / Q.squaredNorm());
    return narrow(Style::stack(
        Style::rotate(Style::inverse(Style::from_quaternion(Q)), X3(wide(V3(rate.template head<3>())))),
        omega));
  }

  // Poses in the plane.
  using X2 = Vec<W, 2>;
  static X2 turned_by(const X2& r, const X2& x) {
    return {r[0] * x[0] - r[1] * x[1], r[1] * x[0] + r[0] * x[1]};
  }
  static X2 top2(const V4& q) { return {W(q[0]), W(q[1])}; }
  static X2 unit2(const V4& q) { return X2(W(q[2]), W(q[3])).normalized(); }
  static V4 planar(const X2& p, const X2& r) { return {S(p[0]), S(p[1]), S(r[0]), S(r[1])}; }
  static Vec<W, 4> planar_step(const V3& d) {
    const X3 p = Style::arc(X3(0, 0, W(d[2])), X3(W(d[0]), W(d[1]), 0));
    return {p[0], p[1], std::cos(W(d[2])), std::sin(W(d[2]))};
  }
  static V3 planar_log(const X2& p, const W& angle) {
    const X3 rho = Style::arc_inverse(X3(0, 0, angle), X3(p[0], p[1], 0));
    return {S(rho[0]), S(rho[1]), S(angle)};
  }
  static V4 se2_exp(const V3& d) { return narrow(planar_step(d)); }
  static V3 se2_log(const V4& q) { return planar_log(top2(q), std::atan2(W(q[3]), W(q[2]))); }
  static V4 se2_compose(const V4& q0, const V4& q1) {
    const X2 r = unit2(q0);
    return planar(top2(q0) + turned_by(r, top2(q1)), turned_by(r, unit2(q1)).normalized());
  }
  static V4 se2_integrate(const V4& q, const V3& d) {
    const Vec<W, 4> step = planar_step(d);
    const X2 r = unit2(q);
    return planar(top2(q) + turned_by(r, step.template head<2>()),
                  turned_by(r, step.template tail<2>()).normalized());
  }
  static V3 se2_difference(const V4& q0, const V4& q1) {
    const X2 back(unit2(q0)[0], -unit2(q0)[1]);
    const W c = W(q0[2]) * W(q1[2]) + W(q0[3]) * W(q1[3]),
            s = difference_of_products<W>(W(q0[2]), W(q1[3]), W(q0[3]), W(q1[2]));
    return planar_log(turned_by(back, top2(q1) - top2(q0)), std::atan2(s, c));
  }

  using Style6 = Basics<void, S>;
};

}  // namespace liecheck::properties::correct
