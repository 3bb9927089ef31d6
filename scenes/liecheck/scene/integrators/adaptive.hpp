#pragma once
// Steps whose lengths follow from an error estimate e of the tangent increment and of the velocity.
//
//   next h = h clamp(0.9 |e|^(-1/k), 1/5, 5),  e = O(h^k)
//   accepted if |e_delta| <= tolerance [m, rad] and |e_v| <= tolerance (1 + |v|), in maximum norms
//
// step(h) advances by exactly h, in as many internal steps as the tolerance requires. If branches of forces are held
// (switches.hpp), it ends after the first internal step in which one of them should have changed.

#include <liecheck/scene/integrators/method.hpp>
#include <optional>

namespace liecheck::scene {

template <System Sys>
class Adaptive : public Method<Sys> {
 public:
  using S = typename Sys::Scalar;
  using Tangent = typename Sys::Tangent;
  explicit Adaptive(const MethodOptions& options) : tolerance_(options.tolerance), stop_(options.stop) {}
  MethodCounts counts() const override { return counts_; }
  S reached() const final { return reached_; }
  using Memory = typename Method<Sys>::Memory;
  std::optional<Memory> memory() const override { return Memory{h_, usual_}; }
  void recall(const Memory& all) override { h_ = all.at(0), usual_ = all.at(1); }
  void begin(Sys&, const State<Sys>& state) override {
    delta_ = dv_ = e_delta_ = e_v_ = state.v, at_ = state;
    h_ = S(0);
    if (state.t == S(0)) usual_ = S(0);  // another run
  }
  void step(Sys& system, State<Sys>& state, const S& h) final {
    if (!(h_ > S(0))) h_ = usual_ > S(0) ? usual_ : h;
    if (h_ > h) h_ = h;
    at_ = state;
    S done(0);
    while (done < h) {
      const bool last = h - done <= h_ * (S(1) + S(64) * eps<S>());
      const S trial = last ? S(h - done) : h_;
      if (!(S(done + trial) > done) || !(last || S(h + trial) > h))
        throw StepFailed("no step is small enough for the tolerance");
      if (++tried_ % 256 == 0 && stop_ && stop_()) throw Interrupted();
      system.switches().forget();
      S error = std::numeric_limits<S>::infinity();
      try {
        error = attempt(system, *at_, trial);
      } catch (const std::domain_error&) {
        // SingularInertia: of a stage that went astray, if a shorter step has none.
        if (!(S(h + trial / S(4)) > h)) throw;
      }
      using std::max, std::min, std::pow;
      const bool good = error <= S(1);  // false for NaN
      const S factor =
          error > S(0) ? S(S(9) / S(10) * S(pow(error, S(S(-1) / S(this->what().estimate_order))))) : S(5);
      const S next = trial * (finite<S>(error) ? max(S(S(1) / S(5)), min(S(5), factor)) : S(S(1) / S(5)));
      if (!last || next < h_ || !good) h_ = next;
      if (!good) {
        ++counts_.rejected;
        continue;
      }
      ++counts_.steps;
      if (!last) usual_ = trial;
      accepted(trial);
      checkFinite(delta_, dv_);
      advance(system, *at_, delta_, dv_);
      done = last ? h : S(done + trial);
      at_->t = state.t + done;
      if (system.switches().crossed()) break;
    }
    reached_ = done;
    const S t = state.t;
    state = *at_;
    state.t = t;
  }

 protected:
  /// Takes a step from a state and returns errorOf() of its estimate; not finite if the step fails.
  virtual S attempt(Sys& system, const State<Sys>& from, const S& h) = 0;
  /// Sets delta_ and dv_ of the attempted step, if attempt() has not.
  virtual void accepted(const S& h) = 0;
  /// The estimate (e_delta_, e_v_) in units of the tolerance.
  S errorOf(const State<Sys>& from) const {
    const S scale = tolerance_ * (S(1) + from.v.cwiseAbs().maxCoeff());
    return std::max(S(e_delta_.cwiseAbs().maxCoeff() / tolerance_), S(e_v_.cwiseAbs().maxCoeff() / scale));
  }
  bool estimates() const { return finite<S>(tolerance_); }

  Tangent delta_, dv_, e_delta_, e_v_;
  MethodCounts counts_;

 private:
  std::optional<State<Sys>> at_;
  S tolerance_, h_ = S(0), reached_ = S(0);
  S usual_ = S(0);  ///< the last step that no end limited: the first one after an event
  std::function<bool()> stop_;
  long tried_ = 0;
};

}  // namespace liecheck::scene
