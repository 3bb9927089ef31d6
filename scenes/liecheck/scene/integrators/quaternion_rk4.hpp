#pragma once
// A common practice, for comparison: the classical Runge-Kutta method on the stored numbers of q with the
// rate q_dot = 1/2 Q (omega, 0), and normalisation after each step. Order 4. Its stages leave the group.

#include <liecheck/scene/integrators/method.hpp>

namespace liecheck::scene {

template <System Sys>
class QuaternionRk4 final : public Method<Sys> {
 public:
  using S = typename Sys::Scalar;
  static constexpr MethodInfo info{.name = "quaternion_rk4",
                                   .order = 4,
                                   .evaluations = 4,
                                   .equation = "classical Runge-Kutta on (q, v), q := q/|q|",
                                   .source = "Kutta 1901"};
  const MethodInfo& what() const override { return info; }
  void begin(Sys&, const State<Sys>& state) override {
    q_ = r1_ = r2_ = r3_ = r4_ = state.q;
    v_ = a1_ = a2_ = a3_ = a4_ = state.v;
  }
  void step(Sys& system, State<Sys>& state, const S& h) override {
    const S half = h / S(2), sixth = h / S(6), middle = state.t + half;
    const auto rates = [&](const S& t, const auto& q, const auto& v, auto& r, auto& a) {
      system.acceleration(t, q, v, a);
      system.coefficientRate(q, v, r);
    };
    rates(state.t, state.q, state.v, r1_, a1_);
    q_ = state.q + half * r1_, v_ = state.v + half * a1_;
    rates(middle, q_, v_, r2_, a2_);
    q_ = state.q + half * r2_, v_ = state.v + half * a2_;
    rates(middle, q_, v_, r3_, a3_);
    q_ = state.q + h * r3_, v_ = state.v + h * a3_;
    rates(S(state.t + h), q_, v_, r4_, a4_);
    q_ = sixth * (r1_ + S(2) * (r2_ + r3_) + r4_);
    v_ = sixth * (a1_ + S(2) * (a2_ + a3_) + a4_);
    checkFinite(q_, v_);
    state.q += q_, state.v += v_;
    system.normalize(state.q);
  }

 private:
  typename Sys::Configuration q_, r1_, r2_, r3_, r4_;
  typename Sys::Tangent v_, a1_, a2_, a3_, a4_;
};

}  // namespace liecheck::scene
