#pragma once
// Loops written by hand for one scene and one method each, the classical Runge-Kutta-Munthe-Kaas method: a lower
// bound of the cost of a step. They share no code with scenes/liecheck/scene, except the kinematics and dynamics of
// trees, and give the same bits.

#include <algorithm>
#include <array>
#include <cmath>
#include <liecheck/algorithms/aba.hpp>
#include <liecheck/scene/tangent_rate.hpp>
#include <stdexcept>

namespace liecheck::test {

using Double3 = std::array<double, 3>;

inline Double3 crossed(const Double3& a, const Double3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// J_r^-1(phi) omega for a small angle.
inline Double3 rateByHand(const Double3& phi, const Double3& omega) {
  const double x = phi[0] * phi[0] + phi[1] * phi[1] + phi[2] * phi[2];
  const double d = 1. / 12 + x * (1. / 720 + x * (1. / 30240));
  const Double3 a = crossed(phi, omega), b = crossed(phi, a);
  return {omega[0] + (a[0] / 2 + d * b[0]), omega[1] + (a[1] / 2 + d * b[1]),
          omega[2] + (a[2] / 2 + d * b[2])};
}
/// Q := Q exp(phi) for a small angle.
inline void turnByHand(double* Q, const Double3& phi) {
  const double x = phi[0] * phi[0] + phi[1] * phi[1] + phi[2] * phi[2], y = x / 4;
  const double s = 0.5 - y * (1. / 12 - y * (1. / 240 - y * (1. / 10080)));
  const double c = 1 - y * (0.5 - y * (1. / 24 - y * (1. / 720)));
  const double a = s * phi[0], b = s * phi[1], e = s * phi[2];
  const double i = Q[3] * a + Q[0] * c + Q[1] * e - Q[2] * b, j = Q[3] * b + Q[1] * c + Q[2] * a - Q[0] * e,
               k = Q[3] * e + Q[2] * c + Q[0] * b - Q[1] * a, w = Q[3] * c - Q[0] * a - Q[1] * b - Q[2] * e;
  const double scale = (3 - ((i * i + j * j) + (k * k + w * w))) / 2;
  Q[0] = scale * i, Q[1] = scale * j, Q[2] = scale * k, Q[3] = scale * w;
}

/// A free body of diagonal inertia.
class FreeBodyByHand {
 public:
  explicit FreeBodyByHand(const Double3& I)
      : k_{(I[1] - I[2]) / I[0], (I[2] - I[0]) / I[1], (I[0] - I[1]) / I[2]} {}
  void step(double h) {
    const double half = 0.5 * h, sixth = 1. / 6 * h, third = 1. / 3 * h;
    const Double3 K1 = omega, A1 = euler(omega);
    Double3 d, w;
    for (int i = 0; i < 3; ++i) d[i] = half * K1[i], w[i] = half * A1[i] + omega[i];
    const Double3 A2 = euler(w), K2 = rateByHand(d, w);
    for (int i = 0; i < 3; ++i) d[i] = half * K2[i], w[i] = half * A2[i] + omega[i];
    const Double3 A3 = euler(w), K3 = rateByHand(d, w);
    for (int i = 0; i < 3; ++i) d[i] = h * K3[i], w[i] = h * A3[i] + omega[i];
    const Double3 A4 = euler(w), K4 = rateByHand(d, w);
    for (int i = 0; i < 3; ++i) {
      d[i] = ((sixth * K1[i] + third * K2[i]) + third * K3[i]) + sixth * K4[i];
      omega[i] += ((sixth * A1[i] + third * A2[i]) + third * A3[i]) + sixth * A4[i];
    }
    turnByHand(Q.data(), d);
  }
  std::array<double, 4> Q{0, 0, 0, 1};
  Double3 omega{};

 private:
  Double3 euler(const Double3& w) const {
    return {k_[0] * (w[1] * w[2]), k_[1] * (w[2] * w[0]), k_[2] * (w[0] * w[1])};
  }
  Double3 k_;
};

/// A free body of diagonal inertia under gravity, with drag at its centre of mass: linear and quadratic in c_dot.
class DraggedBodyByHand {
 public:
  DraggedBodyByHand(const Double3& I, double m, double linear, double quadratic, const Double3& g)
      : k_{(I[1] - I[2]) / I[0], (I[2] - I[0]) / I[1], (I[0] - I[1]) / I[2]},
        linear_(linear / m),
        quadratic_(quadratic / m),
        g_(g) {}
  void step(double h) {
    const double half = 0.5 * h, sixth = 1. / 6 * h, third = 1. / 3 * h;
    const Double3 K1 = omega, A1 = euler(omega), U1 = u, F1 = fall(u);
    Double3 d, w, U2, U3, U4;
    for (int i = 0; i < 3; ++i)
      d[i] = half * K1[i], w[i] = half * A1[i] + omega[i], U2[i] = half * F1[i] + u[i];
    const Double3 A2 = euler(w), K2 = rateByHand(d, w), F2 = fall(U2);
    for (int i = 0; i < 3; ++i)
      d[i] = half * K2[i], w[i] = half * A2[i] + omega[i], U3[i] = half * F2[i] + u[i];
    const Double3 A3 = euler(w), K3 = rateByHand(d, w), F3 = fall(U3);
    for (int i = 0; i < 3; ++i) d[i] = h * K3[i], w[i] = h * A3[i] + omega[i], U4[i] = h * F3[i] + u[i];
    const Double3 A4 = euler(w), K4 = rateByHand(d, w), F4 = fall(U4);
    for (int i = 0; i < 3; ++i) {
      d[i] = ((sixth * K1[i] + third * K2[i]) + third * K3[i]) + sixth * K4[i];
      omega[i] += ((sixth * A1[i] + third * A2[i]) + third * A3[i]) + sixth * A4[i];
      c[i] += ((sixth * U1[i] + third * U2[i]) + third * U3[i]) + sixth * U4[i];
      u[i] += ((sixth * F1[i] + third * F2[i]) + third * F3[i]) + sixth * F4[i];
    }
    turnByHand(Q.data(), d);
  }
  std::array<double, 4> Q{0, 0, 0, 1};
  Double3 omega{}, c{}, u{};

 private:
  Double3 euler(const Double3& w) const {
    return {k_[0] * (w[1] * w[2]), k_[1] * (w[2] * w[0]), k_[2] * (w[0] * w[1])};
  }
  Double3 fall(const Double3& v) const {
    const double k = linear_ + quadratic_ * std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    Double3 a;
    for (int i = 0; i < 3; ++i) a[i] = g_[i] - k * v[i];
    return a;
  }
  Double3 k_;
  double linear_, quadratic_;
  Double3 g_;
};

/// A tree of revolute joints, with a free-flyer or without: gravity, PD control, damping, and feet in contact with the
/// ground z = 0. The poses and twists that feet need are those of the dynamics.
class TreeByHand {
 public:
  struct Contact {
    std::vector<std::pair<std::size_t, Vector3<double>>> feet;  ///< joint, and position in it
    double stiffness = 0, dissipation = 0, friction = 0, slip = 0;
  };
  TreeByHand(const Model<double>& robot, const VectorX<double>& target, double stiffness, double damping,
             double joint_damping, const Contact& contact)
      : model(robot),
        target_(target),
        k_(stiffness),
        d_(damping),
        joint_d_(joint_damping),
        contact_(contact),
        data_(model),
        tau_(VectorX<double>::Zero(model.nv)),
        f_(std::size_t(model.njoints), Force<double>::Zero()) {
    q_ = VectorX<double>(model.nq);
    for (VectorX<double>* x :
         {&delta_, &w_, &dv_, &K_[0], &K_[1], &K_[2], &K_[3], &A_[0], &A_[1], &A_[2], &A_[3]})
      *x = VectorX<double>::Zero(model.nv);
    moved_ = stiffness > 0;
    root_ = model.nq - model.nv == 1 ? 6 : 0;
    margins_ = signs_ = std::vector<double>(std::size_t(model.nv) + contact.feet.size());
    q_before_ = q_, v_before_ = w_;
  }
  void step(double h) {
    const double half = 0.5 * h, sixth = 1.0 / 6.0 * h, third = 1.0 / 3.0 * h;
    K_[0] = v, accelerate(q, v, A_[0]);
    checkEvents();
    q_before_ = q, v_before_ = v;
    for (int i = 1; i < 4; ++i) {
      const double share = i == 3 ? h : half;
      delta_ = share * K_[i - 1], w_ = share * A_[i - 1], w_ += v;
      moved(delta_, q_);
      accelerate(q_, w_, A_[i]);
      K_[i] = w_;
      if (root_)
        K_[i].head<6>() =
            scene::tangentRate<double>(Vector6<double>(delta_.head<6>()), Vector6<double>(w_.head<6>()));
    }
    delta_ = sixth * K_[0], delta_ += third * K_[1], delta_ += third * K_[2], delta_ += sixth * K_[3];
    dv_ = sixth * A_[0], dv_ += third * A_[1], dv_ += third * A_[2], dv_ += sixth * A_[3];
    moved(delta_, q), v += dv_;
  }
  Model<double> model;
  VectorX<double> q, v;

 private:
  void moved(const VectorX<double>& delta, VectorX<double>& to) const {
    if (root_)
      to.head<7>() = integrateSE3<double>(Vector7<double>(q.head<7>()), Vector6<double>(delta.head<6>()));
    const int more = root_ / 6;
    for (int k = root_; k < model.nv; ++k) to[k + more] = q[k + more] + delta[k];
  }
  /// A scene ends a step where a torque reaches its limit or a foot touches the ground. The loop sees it at the first
  /// evaluation after that, at which it would return to the state before. It does not do so, since no event happens in
  /// the steps that are counted, but throws.
  void checkEvents() {
    for (std::size_t i = 0; i < margins_.size(); ++i) {
      if (margins_[i] * signs_[i] < 0) throw std::logic_error("the loop by hand does not locate events");
      if (signs_[i] == 0) signs_[i] = margins_[i] > 0 ? 1 : -1;
    }
  }
  void accelerate(const VectorX<double>& q_at, const VectorX<double>& v_at, VectorX<double>& a) {
    algorithms_detail::bodiesInWorldAxes<double>(model, data_, q_at, v_at);
    if (!moved_) return finish(a);
    const int more = root_ / 6;
    for (int k = root_; k < model.nv; ++k) {
      const double limit = model.effortLimit[k];
      const double tau = k_ * (target_[k - root_] - q_at[k + more]) - d_ * v_at[k];
      tau_[k] = 0.0 - joint_d_ * v_at[k] + std::clamp(tau, -limit, limit);
      margins_[std::size_t(k)] = limit - std::abs(tau);
    }
    std::size_t foot = std::size_t(model.nv);
    for (const auto& [joint, p] : contact_.feet) {
      const SE3<double>& X = data_.oMi[joint];
      const Vector3<double> at = X.act(p), arm = at - X.translation();
      const double depth = -at[2];
      f_[joint] = Force<double>::Zero();
      margins_[foot++] = depth;
      if (!(depth > 0)) continue;
      const Motion<double>& V = data_.work.velocity[joint];
      const Vector3<double> u = V.linear() + cross<double>(V.angular(), arm);
      if (!(1 - contact_.dissipation * u[2] > 0)) continue;
      const double normal = contact_.stiffness * depth * (1 - contact_.dissipation * u[2]);
      const double drag = contact_.friction * normal / std::sqrt(u[0] * u[0] + u[1] * u[1] + contact_.slip);
      const Vector3<double> f(-drag * u[0], -drag * u[1], normal);
      f_[joint] = Force<double>(f, cross<double>(arm, f));
    }
    finish(a);
  }
  void finish(VectorX<double>& a) {
    algorithms_detail::articulatedBodies<double>(
        model, data_, tau_, contact_.feet.empty() ? External<double>() : External<double>(f_), true);
    a = data_.ddq.write(Level::Velocity);
  }
  VectorX<double> target_;
  double k_, d_, joint_d_;
  Contact contact_;
  Data<double> data_;
  std::vector<double> margins_, signs_;
  VectorX<double> q_before_, v_before_, tau_, q_, delta_, w_, dv_, K_[4], A_[4];
  std::vector<Force<double>> f_;
  int root_;
  bool moved_;  ///< whether forces act
};

}  // namespace liecheck::test
