#pragma once
// Adaptive steps on the group (adaptive.hpp) by Radau IIA with three stages, for the increment and the velocity
// (implicit_stages.hpp). Order 5, stiffly accurate and L-stable: modes that decay much faster than a step vanish.
//
//   z_i = (delta_i, v_i - v0),   e_raw = g h f(0) + g/3 ((-13 - 7 r) z_1 + (-13 + 7 r) z_2 - z_3),   r = sqrt(6)
//   e = (1 - g h J)^-1 e_raw,    g = the real eigenvalue of (a_ij),   J = df/dy at the start,   f = y_dot
//
// If e exceeds the tolerance, it is filtered once more, with f(e) for f(0). (Hairer & Wanner 1996, IV.8.) J is that of
// Newton's method; where the fixed-point iteration converges, no mode is stiff, and e = e_raw.

#include <liecheck/scene/integrators/adaptive.hpp>
#include <liecheck/scene/integrators/implicit_stages.hpp>

namespace liecheck::scene {

template <System Sys>
class Radau5 final : public Adaptive<Sys> {
 public:
  using S = typename Sys::Scalar;
  using Tangent = typename Sys::Tangent;
  static constexpr MethodInfo info{.name = "radau5",
                                   .order = 5,
                                   .equation = "Radau IIA with 3 stages for (delta, v), L-stable",
                                   .source = "Ehle 1969; Hairer & Wanner 1996, IV.8",
                                   .increments = true,
                                   .adaptive = true,
                                   .estimate_order = 4};
  using Adaptive<Sys>::Adaptive;
  const MethodInfo& what() const override { return info; }
  MethodCounts counts() const override {
    MethodCounts all = this->counts_;
    all.iterations = stages_.iterations();
    return all;
  }
  using Memory = typename Method<Sys>::Memory;
  std::optional<Memory> memory() const override {
    auto all = stages_.memory();
    const auto own = Adaptive<Sys>::memory();
    if (all) all->insert(all->end(), own->begin(), own->end());
    return all;
  }
  void recall(const Memory& all) override {
    Adaptive<Sys>::recall(Memory(all.end() - 2, all.end()));
    stages_.recall(Memory(all.begin(), all.end() - 2));
  }
  void begin(Sys& system, const State<Sys>& state) override {
    Adaptive<Sys>::begin(system, state);
    stages_.begin(state);
    q_ = state.q, v_ = K_ = A_ = x_ = state.v;
  }

 private:
  S attempt(Sys& system, const State<Sys>& from, const S& h) override {
    static const auto g = CollocationPoints<S>::radau();
    if (!stages_.solve(system, from, h, g)) return std::numeric_limits<S>::infinity();
    const bool crossed = system.switches().crossed();
    if (this->estimates()) estimate(system, from, h, g);
    if (!crossed) system.switches().forget();  // the states of the estimate are not on the motion
    stages_.sum(g.b, h, this->delta_, this->dv_);
    return this->estimates() ? this->errorOf(from) : S(0);
  }
  void accepted(const S& h) override { stages_.accept(h); }

  /// K_ and A_: f at the increment x and the change dv of the velocity.
  void rate(Sys& system, const State<Sys>& from, const Tangent& x, const Tangent& dv) {
    v_ = from.v + dv;
    if (system.readsConfiguration()) system.integrate(from.q, x, q_);
    system.acceleration(from.t, q_, v_, A_);
    system.tangentRate(x, v_, K_);
  }
  void estimate(Sys& system, const State<Sys>& from, const S& h, const CollocationPoints<S>& g) {
    using std::sqrt;
    static const S r = S(sqrt(S(6))), gamma = realEigenvalue();
    static const S weights[3] = {gamma / S(3) * (S(-13) - S(7) * r), gamma / S(3) * (S(-13) + S(7) * r),
                                 -gamma / S(3)};
    Tangent &e = this->e_delta_, &e_v = this->e_v_;
    x_.setZero(), e.setZero(), e_v.setZero();
    rate(system, from, x_, x_);
    for (std::size_t i = 0; i < 3; ++i) {
      stages_.sum(g.a[i], h, this->delta_, this->dv_);
      e += weights[i] * this->delta_, e_v += weights[i] * this->dv_;
    }
    const Eigen::MatrixXd* const J = stages_.jacobian();
    if (!J) {
      e += S(gamma * h) * K_, e_v += S(gamma * h) * A_;
    } else if constexpr (std::is_same_v<S, double>) {
      raw_.resize(2 * system.nv());
      raw_ << e, e_v;
      M_ = -gamma * h * *J;
      M_.diagonal().array() += 1;
      lu_.compute(M_);
      filter(gamma * h);
      if (this->errorOf(from) > 1) {
        rate(system, from, e, e_v);
        filter(gamma * h);
      }
    }
  }
  /// (e_delta_, e_v_) = (1 - g h J)^-1 (g h (K_, A_) + raw_).
  void filter(double gh) {
    const Eigen::Index n = v_.size();
    y_.resize(2 * n);
    y_ << K_, A_;
    y_ = gh * y_ + raw_;
    filtered_ = lu_.solve(y_);
    this->e_delta_ = filtered_.head(n), this->e_v_ = filtered_.tail(n);
  }
  /// The real root x of 60 x^3 - 36 x^2 + 9 x = 1, the characteristic polynomial of (a_ij); 0.2749 (ibid., eq. 8.6).
  static S realEigenvalue() {
    S x = S(11) / S(40);
    for (int newton = 0; newton < 8; ++newton)
      x -= (((S(60) * x - S(36)) * x + S(9)) * x - S(1)) / ((S(180) * x - S(72)) * x + S(9));
    return x;
  }

  ImplicitStages<Sys, 3> stages_;
  typename Sys::Configuration q_;
  Tangent v_, K_, A_, x_;
  Eigen::MatrixXd M_;
  VectorX<double> raw_, y_, filtered_;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
};

}  // namespace liecheck::scene
