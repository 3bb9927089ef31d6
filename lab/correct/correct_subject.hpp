#pragma once
// Correct forms of representations, transforms and means in each style, and the subjects correct:NAME.

#include <correct/correct.hpp>

namespace liecheck::properties::correct {

template <class S, class Style>
struct CorrectSubject : Correct<S, Style> {
  using Base = Correct<S, Style>;
  using Base::narrow, Base::wide, Base::unit, Base::integrate, Base::difference, Base::act_motion,
      Base::act_force, Base::cross_motion;
  using typename Base::V3, typename Base::V4, typename Base::V6, typename Base::V7, typename Base::M3,
      typename Base::M6, typename Base::W, typename Base::X3, typename Base::X4, typename Base::X66,
      typename Base::Rot, typename Base::Style6;

  // Representations.
  static X4 unit_of(const Rot& R) { return Style::quaternion(R).normalized(); }
  static V4 quaternion_from_matrix(const M3& R) { return narrow(unit_of(Style::from_matrix(wide(R)))); }
  static M3 matrix_from_quaternion(const V4& Q) {
    return narrow(Style::matrix(Style::from_quaternion(wide(Q))));
  }
  static V4 quaternion_product(const V4& a, const V4& b) {
    return narrow(unit_of(Style::product(Style::from_quaternion(wide(a)), Style::from_quaternion(wide(b)))));
  }
  static V4 quaternion_inverse(const V4& Q) {
    return narrow(unit_of(Style::inverse(Style::from_quaternion(wide(Q)))));
  }
  static V4 pair(const X3& phi) {
    const W angle = phi.stableNorm();
    const W largest = phi.cwiseAbs().maxCoeff();  // of a tiny turn, too, the axis has length 1
    return (V4() << narrow(angle > 0 ? X3(X3(phi / largest).normalized()) : X3(X3::UnitZ())), S(angle))
        .finished();
  }
  static V4 axis_angle_from_quaternion(const V4& Q) { return pair(Style::log(wide(Q))); }
  static V4 axis_angle_from_matrix(const M3& R) { return pair(Style::log_of_matrix(wide(R))); }
  static V4 quaternion_from_axis_angle(const V3& axis, const S& angle) {
    return narrow(Style::quaternion(Style::exp(W(angle) * wide(axis).normalized())));
  }
  static M3 matrix_from_axis_angle(const V3& axis, const S& angle) {
    return narrow(Style::matrix(Style::exp(W(angle) * wide(axis).normalized())));
  }
  static V3 gibbs_from_quaternion(const V4& Q) { return narrow(X3(unit(Q).template head<3>() / unit(Q)[3])); }
  /// tan(theta/4) n.
  static V3 mrp_from_quaternion(const V4& Q) {
    const X3 phi = Style::log(wide(Q));
    const W angle = phi.stableNorm();
    return narrow(X3(angle > 0 ? X3(std::tan(angle / 4) / angle * phi) : phi));
  }
  /// exp of a turn by factor atan(|x|) about x.
  static V4 turned_by_tangent(const V3& x, int factor) {
    const X3 v = wide(x);
    const W n = v.stableNorm();
    return n == 0 ? V4(V4::Unit(3)) : narrow(unit_of(Style::exp(factor * std::atan(n) / n * v)));
  }
  static V4 quaternion_from_gibbs(const V3& g) { return turned_by_tangent(g, 2); }
  static V4 quaternion_from_mrp(const V3& s) { return turned_by_tangent(s, 4); }
  /// Newton's iteration X <- (X + X^-T)/2.
  static M3 nearest_rotation(const M3& A) {
    Mat<W, 3> X = wide(A);
    for (int i = 0; i < 10; ++i) X = ((X + X.inverse().transpose()) / 2).eval();
    return narrow(Style::matrix(Style::from_matrix(X)));
  }
  /// z is across the first two columns, y across z and x.
  static M3 gram_schmidt(const M3& A) {
    Mat<W, 3> R = wide(A);
    const X3 x = X3(R.col(0)).normalized(), z = x.cross(X3(R.col(1))).normalized();
    R << x, z.cross(x), z;
    return narrow(R);
  }

  // Adjoint matrices, column by column.
  template <class Act>
  static M6 columns(Act act) {
    M6 m;
    for (int i = 0; i < 6; ++i) m.col(i) = act(V6(V6::Unit(i)));
    return m;
  }
  static M6 adjoint(const Pose<S>& X) {
    return columns([&](const V6& V) { return act_motion(X, V); });
  }
  static M6 coadjoint(const Pose<S>& X) {
    return columns([&](const V6& F) { return act_force(X, F); });
  }
  static M6 small_adjoint(const V6& V) {
    return columns([&](const V6& U) { return cross_motion(V, U); });
  }
  static M6 transport_covariance(const Pose<S>& X, const M6& Sigma) {
    const X66 Ad = wide(adjoint(X));
    return narrow(X66(Ad * (wide(Sigma) * Ad.transpose())));
  }
  static V7 screw_parameters(const V6& V) {
    const X3 u = wide(Style6::top(V)), n = wide(Style6::low(V));
    const W length = n.stableNorm();
    const X3 axis = n / length, along = axis.dot(u) * axis;
    return (V7() << narrow(axis), S(axis.dot(u) / length), narrow(X3(axis.cross(X3(u - along)) / length)))
        .finished();
  }

  // Means and what lies between.
  /// The dominant column of a high power of sum w Q Q^T.
  static V4 mean_rotation(const V4& Q0, const V4& Q1, const V4& Q2, const V3& weights) {
    const X4 q[3] = {wide(Q0).normalized(), wide(Q1).normalized(), wide(Q2).normalized()};
    const X4 back(-q[0][0], -q[0][1], -q[0][2], q[0][3]);
    Mat<W, 4> M = Mat<W, 4>::Zero();
    for (int i = 0; i < 3; ++i) {  // as seen from the first
      const X4 x = Style::product_of_quaternions(back, q[i]);
      M += W(weights[i]) * (x * x.transpose());
    }
    for (int i = 0; i < 50; ++i) M = (M / M.trace() * (M / M.trace())).eval();
    int k = 0;
    M.diagonal().maxCoeff(&k);
    return narrow(X4(Style::product_of_quaternions(q[0], X4(M.col(k).normalized())).normalized()));
  }
  static V7 mean_pose(const V7& q0, const V7& q1, const V7& q2, const V3& w) {
    V7 mean = q0;
    mean.template tail<4>() =
        mean_rotation(q0.template tail<4>(), q1.template tail<4>(), q2.template tail<4>(), w);
    for (int i = 0; i < 60; ++i)
      mean = integrate(
          mean, V6((w[0] * difference(mean, q0) + w[1] * difference(mean, q1) + w[2] * difference(mean, q2)) /
                   w.sum()));
    return mean;
  }
  static V4 geodesic_mean(const V4& Q0, const V4& Q1, const V4& Q2, const V3& w) {
    const auto turned = [](const V4& Q) { return (V7() << V3::Zero(), Q).finished(); };
    return mean_pose(turned(Q0), turned(Q1), turned(Q2), w).template tail<4>();
  }
  static V7 interpolate(const V7& q0, const V7& q1, const S& t) {
    return integrate(q0, V6(t * difference(q0, q1)));
  }
  static S angle_between(const V3& a, const V3& b) {
    return S(2 * std::atan2((wide(a) - wide(b)).norm(), (wide(a) + wide(b)).norm()));
  }
  static V3 slerp_directions(const V3& a, const V3& b, const S& t) {
    const X3 x = wide(a).normalized(), y = wide(b).normalized();
    const W theta = 2 * std::atan2((x - y).norm(), (x + y).norm());
    if (theta < W(1e-3)) {  // sin(t theta)/sin(theta) = t (1 + (1 - t^2) theta^2/6 + ...)
      const W u = W(t), v = 1 - u, h = theta * theta / 6;
      return narrow(X3((v * (1 + (1 - v * v) * h) * x + u * (1 + (1 - u * u) * h) * y).normalized()));
    }
    return narrow(X3((std::sin((1 - W(t)) * theta) * x + std::sin(W(t) * theta) * y).normalized()));
  }

  // Extended poses: two poses with one rotation.
  static Vec<S, 15> se23_exp(const Vec<S, 9>& xi) {
    const Pose<S> X = Base::exp6(stacked(xi, 0)), Y = Base::exp6(stacked(xi, 3));
    Vec<S, 15> x;
    Mat<S, 3> Rt = X.R.transpose();
    x << Eigen::Map<const Vec<S, 9>>(Rt.data()), X.p, Y.p;
    return x;
  }
  static V6 stacked(const Vec<S, 9>& xi, int from) {
    return (V6() << xi.template segment<3>(from), xi.template tail<3>()).finished();
  }
  static Pose<S> pose(const Vec<S, 15>& X, int from) {
    M3 Rt;
    Rt << X.template segment<3>(0), X.template segment<3>(3), X.template segment<3>(6);
    return {Rt.transpose(), X.template segment<3>(from)};
  }
  static Vec<S, 9> se23_log(const Vec<S, 15>& X) {
    const V6 a = Base::log6(pose(X, 9)), b = Base::log6(pose(X, 12));
    return (Vec<S, 9>() << a.template head<3>(), b.template head<3>(), a.template tail<3>()).finished();
  }
  static Mat<S, 9> nine(const M6& a, const M6& b) {
    Mat<S, 9> m = Mat<S, 9>::Zero();
    for (int i = 0; i < 9; i += 3) m.template block<3, 3>(i, i) = a.template topLeftCorner<3, 3>();
    m.template block<3, 3>(0, 6) = a.template topRightCorner<3, 3>();
    m.template block<3, 3>(3, 6) = b.template topRightCorner<3, 3>();
    return m;
  }
  static Mat<S, 9> se23_left_jacobian(const Vec<S, 9>& xi) {
    return nine(Base::left_jacobian6(stacked(xi, 0)), Base::left_jacobian6(stacked(xi, 3)));
  }
  static Mat<S, 9> se23_right_jacobian(const Vec<S, 9>& xi) { return se23_left_jacobian(-xi); }
  static Mat<S, 9> se23_adjoint(const Vec<S, 15>& X) {
    return nine(adjoint(pose(X, 9)), adjoint(pose(X, 12)));
  }

  // Preintegration: a measurement of 1/16 of its time by a series, doubled four times, with the derivative along one bias.
  using X33 = Mat<W, 3>;
  struct Increment {
    X33 R = X33::Identity(), dR = X33::Zero();
    X3 p = X3::Zero(), v = p, dp = p, dv = p;
    Increment then(const Increment& y, W dt_y) const {
      Increment z;
      z.R = R * y.R, z.dR = dR * y.R + R * y.dR;
      z.v = v + R * y.v, z.dv = dv + dR * y.v + R * y.dv;
      z.p = p + dt_y * v + R * y.p, z.dp = dp + dt_y * dv + dR * y.p + R * y.dp;
      return z;
    }
  };
  static Increment measured(const X3& phi, const X3& dphi, const X3& a, const X3& da, W dt, bool exact) {
    const W h = dt / 16;
    const X33 K = hat<W>(X3(phi / 16)), D = hat<W>(X3(dphi / 16));
    Increment s;
    X33 term = X33::Identity(), change = X33::Zero();
    s.v = h * a, s.dv = h * da, s.p = h * h / 2 * a, s.dp = h * h / 2 * da;
    for (int k = 1; k < 18; ++k) {
      change = ((D * term + K * change) / k).eval(), term = (K * term / k).eval();
      s.R += term, s.dR += change;
      if (!exact) continue;
      const X3 x = term * a, dx = change * a + term * da;
      s.v += h / (k + 1) * x, s.dv += h / (k + 1) * dx;
      s.p += h * h / ((k + 1) * (k + 2)) * x, s.dp += h * h / ((k + 1) * (k + 2)) * dx;
    }
    W t = h;
    for (int i = 0; i < 4; ++i, t *= 2) {
      const Increment half = s;
      s = half.then(half, t);
      if (!exact) s.v = 2 * half.v, s.dv = 2 * half.dv, s.p = 4 * half.p, s.dp = 4 * half.dp;
    }
    return s;
  }
  static Increment integrated(const Vec<S, 9>& gyro, const Vec<S, 9>& accelerometer, const S& dt, bool exact,
                              const X3& b_g = X3::Zero(), const X3& b_a = X3::Zero()) {
    Increment s;
    const W t = W(dt);
    for (int i = 0; i < 9; i += 3)
      s = s.then(measured(X3(t * wide(V3(gyro.template segment<3>(i)))), X3(-t * b_g),
                          wide(V3(accelerometer.template segment<3>(i))), X3(-b_a), t, exact),
                 t);
    return s;
  }
  template <bool exact>
  static Vec<S, 15> preintegrated(const Vec<S, 9>& gyro, const Vec<S, 9>& accelerometer, const S& dt) {
    const Increment s = integrated(gyro, accelerometer, dt, exact);
    const M3 Rt = narrow(s.R).transpose();
    return (Vec<S, 15>() << Eigen::Map<const Vec<S, 9>>(Rt.data()), narrow(s.p), narrow(s.v)).finished();
  }
  template <bool exact>
  static Mat<S, 15, 3> bias_jacobians(const Vec<S, 9>& gyro, const Vec<S, 9>& accelerometer, const S& dt) {
    Mat<S, 15, 3> m;
    for (int j = 0; j < 3; ++j) {
      const X3 e = X3::Unit(j);
      const Increment g = integrated(gyro, accelerometer, dt, exact, e),
                      a = integrated(gyro, accelerometer, dt, exact, X3::Zero(), e);
      const X33 turn = g.R.transpose() * g.dR;
      m.col(j) << S(turn(2, 1)), S(turn(0, 2)), S(turn(1, 0)), narrow(g.dp), narrow(a.dp), narrow(g.dv),
          narrow(a.dv);
    }
    return m;
  }

  static TypedSubject<S> make(const char* name, const char* version) {
    TypedSubject<S> s{std::string("correct:") + name, version, {}};
    auto& o = s.operations;
#define LIECHECK_OFFER(operation) o[op::operation] = CorrectSubject::operation
    LIECHECK_OFFER(exp3_quaternion), LIECHECK_OFFER(exp3_matrix), LIECHECK_OFFER(log3_quaternion);
    LIECHECK_OFFER(log3_matrix), LIECHECK_OFFER(exp6), LIECHECK_OFFER(log6), LIECHECK_OFFER(compose);
    LIECHECK_OFFER(inverse), LIECHECK_OFFER(act_point), LIECHECK_OFFER(rotate_point);
    LIECHECK_OFFER(act_motion), LIECHECK_OFFER(act_inverse_motion), LIECHECK_OFFER(act_force);
    LIECHECK_OFFER(act_inverse_force), LIECHECK_OFFER(cross_motion), LIECHECK_OFFER(cross_force);
    LIECHECK_OFFER(act_inertia), LIECHECK_OFFER(act_inverse_inertia), LIECHECK_OFFER(momentum);
    LIECHECK_OFFER(kinetic_energy), LIECHECK_OFFER(inertia_matrix), LIECHECK_OFFER(integrate);
    LIECHECK_OFFER(difference), LIECHECK_OFFER(left_jacobian3), LIECHECK_OFFER(right_jacobian3);
    LIECHECK_OFFER(left_jacobian3_inverse), LIECHECK_OFFER(right_jacobian3_inverse);
    LIECHECK_OFFER(left_jacobian6), LIECHECK_OFFER(right_jacobian6), LIECHECK_OFFER(left_jacobian6_inverse);
    LIECHECK_OFFER(right_jacobian6_inverse), LIECHECK_OFFER(d_integrate_arg0);
    LIECHECK_OFFER(d_integrate_arg1), LIECHECK_OFFER(d_difference_arg0), LIECHECK_OFFER(d_difference_arg1);
    LIECHECK_OFFER(integrate_coefficient_jacobian), LIECHECK_OFFER(normalize);
    LIECHECK_OFFER(first_order_normalize), LIECHECK_OFFER(matrix_from_quaternion_any_norm),
        LIECHECK_OFFER(log3_any_norm);
    LIECHECK_OFFER(rotate_point_any_norm), LIECHECK_OFFER(integrate_any_norm);
    LIECHECK_OFFER(difference_any_norm), LIECHECK_OFFER(d_difference_any_norm);
    LIECHECK_OFFER(relative_angle), LIECHECK_OFFER(twist_angle), LIECHECK_OFFER(slerp);
    LIECHECK_OFFER(rotation_between), LIECHECK_OFFER(euler_to_quaternion), LIECHECK_OFFER(euler_to_matrix);
    LIECHECK_OFFER(euler_from_quaternion), LIECHECK_OFFER(euler_from_matrix),
        LIECHECK_OFFER(velocity_to_rate);
    LIECHECK_OFFER(rate_to_velocity), LIECHECK_OFFER(se2_exp), LIECHECK_OFFER(se2_log);
    LIECHECK_OFFER(se2_compose), LIECHECK_OFFER(se2_integrate), LIECHECK_OFFER(se2_difference);
    LIECHECK_OFFER(quaternion_from_matrix), LIECHECK_OFFER(matrix_from_quaternion),
        LIECHECK_OFFER(quaternion_product), LIECHECK_OFFER(quaternion_inverse),
        LIECHECK_OFFER(axis_angle_from_quaternion), LIECHECK_OFFER(axis_angle_from_matrix),
        LIECHECK_OFFER(quaternion_from_axis_angle), LIECHECK_OFFER(matrix_from_axis_angle),
        LIECHECK_OFFER(gibbs_from_quaternion), LIECHECK_OFFER(quaternion_from_gibbs),
        LIECHECK_OFFER(mrp_from_quaternion), LIECHECK_OFFER(quaternion_from_mrp),
        LIECHECK_OFFER(gram_schmidt), LIECHECK_OFFER(adjoint), LIECHECK_OFFER(coadjoint),
        LIECHECK_OFFER(small_adjoint), LIECHECK_OFFER(transport_covariance), LIECHECK_OFFER(screw_parameters),
        LIECHECK_OFFER(mean_rotation), LIECHECK_OFFER(interpolate), LIECHECK_OFFER(angle_between),
        LIECHECK_OFFER(slerp_directions), LIECHECK_OFFER(nearest_rotation), LIECHECK_OFFER(geodesic_mean),
        LIECHECK_OFFER(mean_pose), LIECHECK_OFFER(se23_exp), LIECHECK_OFFER(se23_log),
        LIECHECK_OFFER(se23_left_jacobian), LIECHECK_OFFER(se23_right_jacobian), LIECHECK_OFFER(se23_adjoint);
    o[op::preintegrate_forster] = preintegrated<false>, o[op::preintegrate_brossard] = preintegrated<true>;
    o[op::forster_bias_jacobians] = bias_jacobians<false>;
    o[op::brossard_bias_jacobians] = bias_jacobians<true>;
#undef LIECHECK_OFFER
    return s;
  }
};

/// Registers styles in S: those of correct_matrices_*.cpp, or those of correct_quaternions_*.cpp.
template <class S>
struct RegisteredMatrices {
  Registered<S> all[4] = {
      Registered<S>(CorrectSubject<S, Matrices<S>>::make("matrices", "3 x 3 and 6 x 6 matrices")),
      Registered<S>(CorrectSubject<S, Books<S>>::make("books", "closed forms with series near 0")),
      Registered<S>(CorrectSubject<S, RotationVectors<S>>::make("rodrigues", "rotation vectors")),
      Registered<S>(CorrectSubject<S, HalfAngles<S>>::make("half_angles", "matrices from half angles"))};
};
template <class S>
struct RegisteredQuaternions {
  Registered<S> all[3] = {
      Registered<S>(CorrectSubject<S, Quaternions<S>>::make("quaternions", "unit quaternions, half angles")),
      Registered<S>(CorrectSubject<S, DualQuaternions<S>>::make("dual_quaternions", "unit dual quaternions")),
      Registered<S>(
          CorrectSubject<S, Cayley<S>>::make("cayley", "Cayley transform of a quarter of the angle"))};
};

}  // namespace liecheck::properties::correct
