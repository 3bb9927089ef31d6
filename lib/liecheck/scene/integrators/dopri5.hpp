#pragma once
// Adaptive steps on the group by the embedded 5(4) pair of Dormand and Prince. The error estimate e covers
// the tangent increment and the velocity.
//
//   e = h sum (b_i - b^_i) (K_i, A_i),  next h = h clamp(0.9 |e|^(-1/5), 1/5, 5),
//   accepted if |e_delta| <= tolerance [m, rad] and |e_v| <= tolerance (1 + |v|), in maximum norms
//
// step(h) advances by exactly h, in as many internal steps as the tolerance requires. Order 5.

#include <liecheck/scene/integrators/munthe_kaas.hpp>
#include <optional>

namespace liecheck::scene {

struct DormandPrinceTableau {
  static constexpr int stages = 7;
  static constexpr Rational a[7][7] = {{},
                                       {{1, 5}},
                                       {{3, 40}, {9, 40}},
                                       {{44, 45}, {-56, 15}, {32, 9}},
                                       {{19372, 6561}, {-25360, 2187}, {64448, 6561}, {-212, 729}},
                                       {{9017, 3168}, {-355, 33}, {46732, 5247}, {49, 176}, {-5103, 18656}},
                                       {{35, 384}, {}, {500, 1113}, {125, 192}, {-2187, 6784}, {11, 84}}};
  static constexpr Rational b[7] = {{35, 384}, {}, {500, 1113}, {125, 192}, {-2187, 6784}, {11, 84}, {}},
                            error[7] = {{71, 57600},      {},        {-71, 16695}, {71, 1920},
                                        {-17253, 339200}, {22, 525}, {-1, 40}},
                            c[7] = {{}, {1, 5}, {3, 10}, {4, 5}, {8, 9}, {1}, {1}};
};

template <System Sys>
class Dopri5 final : public Method<Sys> {
 public:
  using S = typename Sys::Scalar;
  static constexpr MethodInfo info{
      .name = "dopri5",
      .order = 5,
      .equation = "embedded 5(4) for (delta, v), error estimated in the tangent space",
      .source = "Dormand & Prince 1980; Munthe-Kaas 1999",
      .increments = true,
      .adaptive = true};
  explicit Dopri5(const MethodOptions& options) : tolerance_(options.tolerance), stop_(options.stop) {}
  const MethodInfo& what() const override { return info; }
  MethodCounts counts() const override { return counts_; }
  void begin(Sys&, const State<Sys>& state) override {
    stages_.begin(state), delta_ = dv_ = e_delta_ = e_v_ = state.v, at_ = state;
    h_ = S(0);
  }
  void step(Sys& system, State<Sys>& state, const S& h) override {
    if (!(h_ > S(0)) || h_ > h) h_ = h;
    at_ = state;
    S done(0);
    while (done < h) {
      const bool last = h - done <= h_ * (S(1) + S(64) * eps<S>());
      const S trial = last ? S(h - done) : h_;
      if (!(S(done + trial) > done) || !(last || S(h + trial) > h))
        throw StepFailed("no step is small enough for the tolerance");
      if (++tried_ % 256 == 0 && stop_ && stop_()) throw Interrupted();
      stages_.compute(system, *at_, trial);
      stages_.template sum<DormandPrinceTableau::error>(trial, e_delta_, e_v_);
      using std::max, std::min, std::pow;
      const S scale = tolerance_ * (S(1) + at_->v.cwiseAbs().maxCoeff());
      const S error =
          max(S(e_delta_.cwiseAbs().maxCoeff() / tolerance_), S(e_v_.cwiseAbs().maxCoeff() / scale));
      const bool good = error <= S(1);  // false for NaN
      const S factor = error > S(0) ? S(S(9) / S(10) * S(pow(error, S(S(-1) / S(5))))) : S(5);
      const S next = trial * (finite<S>(error) ? max(S(S(1) / S(5)), min(S(5), factor)) : S(S(1) / S(5)));
      if (!last || next < h_ || !good) h_ = next;
      if (!good) {
        ++counts_.rejected;
        continue;
      }
      ++counts_.steps;
      stages_.template sum<DormandPrinceTableau::b>(trial, delta_, dv_);
      checkFinite(delta_, dv_);
      system.accumulate(at_->q, at_->q_low, delta_);
      accumulateAll(at_->v, at_->v_low, dv_);
      done = last ? h : S(done + trial);
      at_->t = state.t + done;
    }
    const S t = state.t;
    state = *at_;
    state.t = t;
  }

 private:
  MuntheKaasStages<Sys, DormandPrinceTableau> stages_;
  typename Sys::Tangent delta_, dv_, e_delta_, e_v_;
  std::optional<State<Sys>> at_;
  S tolerance_, h_ = S(0);
  std::function<bool()> stop_;
  long tried_ = 0;
  MethodCounts counts_;
};

}  // namespace liecheck::scene
