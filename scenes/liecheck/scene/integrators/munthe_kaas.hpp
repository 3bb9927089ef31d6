#pragma once
// Runge-Kutta-Munthe-Kaas: an explicit Runge-Kutta method for the increment delta and the velocity v.
//
//   delta_i = h sum_j a_ij K_j,   v_i = v0 + h sum_j a_ij A_j
//   K_i = J_r^-1(delta_i) v_i,    A_i = a(t + c_i h, integrate(q0, delta_i), v_i)
//   q1 = integrate(q0, h sum b_i K_i),   v1 = v0 + h sum b_i A_i
//
// With the exact J_r^-1 the order is that of the tableau (Munthe-Kaas 1999). The sums over all steps are
// compensated if the state asks for it (accumulate.hpp). Domain: |phi| < pi in a step; at 2 pi J_r^-1 is singular.

#include <array>
#include <liecheck/scene/integrators/method.hpp>
#include <utility>

namespace liecheck::scene {

/// A coefficient of a tableau, exact in every scalar.
struct Rational {
  long numerator = 0, denominator = 1;
};

template <class S, Rational R>
[[gnu::always_inline]] inline S coefficient() {
  if constexpr (std::is_floating_point_v<S>) {
    constexpr S value = S(R.numerator) / S(R.denominator);
    return value;
  } else {
    static const S value = S(R.numerator) / S(R.denominator);
    return value;
  }
}

/// True if the vectors of a system have a size that is known to the compiler.
template <class Sys>
constexpr bool fixed_size = Sys::Tangent::SizeAtCompileTime != Eigen::Dynamic;

/// The stages of a tableau T, which has T::stages and the Rationals T::a[i][j], T::b[i] and T::c[i].
template <System Sys, class T>
class MuntheKaasStages {
 public:
  using S = typename Sys::Scalar;
  using Tangent = typename Sys::Tangent;

  void begin(const State<Sys>& state) {
    q_ = state.q, delta_ = v_ = state.v;
    K_.fill(state.v), A_.fill(state.v);
  }
  /// Computes K and A of all stages.
  void compute(Sys& system, const State<Sys>& state, const S& h) {
    system.acceleration(state.t, state.q, state.v, A_[0]);
    K_[0] = state.v;
    reads_ = system.readsConfiguration();
    rest(system, state, h, std::make_index_sequence<T::stages - 1>());
  }
  /// h sum w_j K_j and h sum w_j A_j with the weights W, which are T::b or T::error.
  template <const auto& W>
  void sum(const S& h, Tangent& delta, Tangent& dv) const {
    add<W>(K_, h, delta, std::make_index_sequence<T::stages>());
    add<W>(A_, h, dv, std::make_index_sequence<T::stages>());
  }

 private:
  template <std::size_t... I>
  void rest(Sys& system, const State<Sys>& state, const S& h, std::index_sequence<I...>) {
    (stage<I + 1>(system, state, h), ...);
  }
  template <std::size_t I>
  void stage(Sys& system, const State<Sys>& state, const S& h) {
    add<T::a[I]>(K_, h, delta_, std::make_index_sequence<I>());
    add<T::a[I]>(A_, h, v_, std::make_index_sequence<I>());
    v_ += state.v;
    if (reads_) place(system, state);
    system.acceleration(S(state.t + coefficient<S, T::c[I]>() * h), q_, v_, A_[I]);
    system.tangentRate(delta_, v_, K_[I]);
  }
  /// Not inlined, so that the loop stays small for a system that reads no q. Fixed sizes are passed as copies, so
  /// that the stages can stay in registers.
  void place(const Sys& system, const State<Sys>& state) {
    if constexpr (fixed_size<Sys>)
      q_ = placed(system, state.q, delta_);
    else
      system.integrate(state.q, delta_, q_);
  }
  [[gnu::noinline]] static typename Sys::Configuration placed(const Sys& system, typename Sys::Configuration q,
                                                              Tangent delta) {
    system.integrate(q, delta, q);
    return q;
  }
  template <const auto& W, std::size_t... J>
  static void add(const std::array<Tangent, T::stages>& X, const S& h, Tangent& sum,
                  std::index_sequence<J...>) {
    bool first = true;
    (
        [&] {
          if constexpr (W[J].numerator != 0) {
            const S weight = coefficient<S, W[J]>() * h;
            if (first)
              sum = weight * X[J];
            else
              sum += weight * X[J];
            first = false;
          }
        }(),
        ...);
  }

  bool reads_ = true;
  typename Sys::Configuration q_;
  Tangent delta_, v_;
  std::array<Tangent, T::stages> K_, A_;
};

/// The method of a tableau T, with properties T::info.
template <System Sys, class T>
class MuntheKaas final : public Method<Sys> {
 public:
  const MethodInfo& what() const override { return T::info; }
  void begin(Sys&, const State<Sys>& state) override {
    if constexpr (!fixed_size<Sys>) stages_.begin(state), delta_ = dv_ = state.v;
  }
  void step(Sys& system, State<Sys>& state, const typename Sys::Scalar& h) override {
    if constexpr (std::is_floating_point_v<typename Sys::Scalar>)
      flattened(system, state, h);
    else
      plain(system, state, h);  // gcc 12 cannot compile a flattened step of a Tree of wide scalars
  }

 private:
  using Stages = MuntheKaasStages<Sys, T>;
  using Tangent = typename Sys::Tangent;
  void plain(Sys& system, State<Sys>& state, const typename Sys::Scalar& h) {
    if constexpr (fixed_size<Sys>) {  // on the stack, where nothing else can refer to them
      Stages stages;
      Tangent delta, dv;
      with(stages, delta, dv, system, state, h);
    } else {
      with(stages_, delta_, dv_, system, state, h);
    }
  }
  static void with(Stages& stages, Tangent& delta, Tangent& dv, Sys& system, State<Sys>& state,
                   const typename Sys::Scalar& h) {
    stages.compute(system, state, h);
    stages.template sum<T::b>(h, delta, dv);
    checkFinite(delta, dv);
    advance(system, state, delta, dv);
  }
  [[gnu::flatten]] void flattened(Sys& system, State<Sys>& state, const typename Sys::Scalar& h) {
    plain(system, state, h);
  }

  Stages stages_;
  Tangent delta_, dv_;
};

}  // namespace liecheck::scene
