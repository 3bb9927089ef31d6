#pragma once
// Hand-written loops, as a lower bound of the cost of a step: one method for one kind of robot without
// effects. They do not use the classes of lib/liecheck/scene, which give the same bits.

#include <liecheck/algorithms/aba.hpp>
#include <liecheck/scene/accumulate.hpp>
#include <liecheck/scene/tangent_rate.hpp>

namespace liecheck::test {

/// The classical Runge-Kutta-Munthe-Kaas method for a free body of diagonal inertia I_O, without forces.
class MinimalBody {
 public:
  explicit MinimalBody(const Vector3<double>& I)
      : k_((I[1] - I[2]) / I[0], (I[2] - I[0]) / I[1], (I[0] - I[1]) / I[2]) {}
  [[gnu::flatten]] void step(double h) {
    using scene::tangentRate;
    const double half = 0.5 * h, sixth = 1.0 / 6.0 * h, third = 1.0 / 3.0 * h;
    const Vector6<double> K1 = v, A1 = acceleration(v);
    Vector6<double> delta = half * K1;
    Vector6<double> w = half * A1 + v;
    const Vector6<double> A2 = acceleration(w), K2 = tangentRate<double>(delta, w);
    delta = half * K2, w = half * A2 + v;
    const Vector6<double> A3 = acceleration(w), K3 = tangentRate<double>(delta, w);
    delta = h * K3, w = h * A3 + v;
    const Vector6<double> A4 = acceleration(w), K4 = tangentRate<double>(delta, w);
    delta = ((sixth * K1 + third * K2) + third * K3) + sixth * K4;
    const Vector6<double> dv = ((sixth * A1 + third * A2) + third * A3) + sixth * A4;
    scene::accumulateSE3<double>(q, q_low, delta);
    scene::accumulateAll(v, v_low, dv);
  }
  Vector7<double> q;
  Vector6<double> v, q_low = Vector6<double>::Zero(), v_low = Vector6<double>::Zero();

 private:
  Vector6<double> acceleration(const Vector6<double>& v) const {
    const Vector3<double> omega(v[3], v[4], v[5]), u(v[0], v[1], v[2]), turning = cross<double>(omega, u);
    Vector6<double> a;
    a << -turning[0], -turning[1], -turning[2], k_[0] * (omega[1] * omega[2]), k_[1] * (omega[2] * omega[0]),
        k_[2] * (omega[0] * omega[1]);
    return a;
  }
  Vector3<double> k_;
};

/// The same method for a free-flyer that carries revolute joints, without forces.
class MinimalTree {
 public:
  explicit MinimalTree(const Model<double>& robot)
      : model(robot), data(model), tau(VectorX<double>::Zero(model.nv)) {
    q_ = VectorX<double>(model.nq);
    for (VectorX<double>* x :
         {&delta, &w, &dv, &v_low, &q_low, &K[0], &K[1], &K[2], &K[3], &A[0], &A[1], &A[2], &A[3]})
      *x = VectorX<double>::Zero(model.nv);
  }
  [[gnu::flatten]] void step(double h) {
    const double half = 0.5 * h, sixth = 1.0 / 6.0 * h, third = 1.0 / 3.0 * h;
    K[0] = v, A[0] = aba(model, data, q, v, tau);
    for (int i = 1; i < 4; ++i) {
      const double share = i == 3 ? h : half;
      delta = share * K[i - 1], w = share * A[i - 1], w += v;
      q_.head<7>() = integrateSE3<double>(Vector7<double>(q.head<7>()), Vector6<double>(delta.head<6>()));
      for (int k = 6; k < model.nv; ++k) q_[k + 1] = q[k + 1] + delta[k];
      A[i] = aba(model, data, q_, w, tau);
      K[i] = w;
      K[i].head<6>() =
          scene::tangentRate<double>(Vector6<double>(delta.head<6>()), Vector6<double>(w.head<6>()));
    }
    delta = sixth * K[0], delta += third * K[1], delta += third * K[2], delta += sixth * K[3];
    dv = sixth * A[0], dv += third * A[1], dv += third * A[2], dv += sixth * A[3];
    Vector7<double> root = q.head<7>();
    Vector6<double> low = q_low.head<6>();
    scene::accumulateSE3<double>(root, low, delta.head<6>());
    q.head<7>() = root, q_low.head<6>() = low;
    for (int k = 6; k < model.nv; ++k) scene::accumulate<double>(q[k + 1], q_low[k], delta[k]);
    scene::accumulateAll(v, v_low, dv);
  }
  Model<double> model;
  Data<double> data;
  VectorX<double> q, v, q_low, v_low;

 private:
  VectorX<double> tau, q_, delta, w, dv, K[4], A[4];
};

}  // namespace liecheck::test
