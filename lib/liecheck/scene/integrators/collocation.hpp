#pragma once
// Gauss collocation on the group: the implicit Runge-Kutta method with s Gauss points for the increment and
// the velocity, in the same coordinates as munthe_kaas.hpp.
//
//   delta_i = h sum_j a_ij K_j,   v_i = v0 + h sum_j a_ij A_j
//   K_i = J_r^-1(delta_i) v_i,    A_i = a(q0 exp delta_i, v_i)
//
// Order 2 s (Butcher 1964, Implicit Runge-Kutta processes; Hairer, Lubich & Wanner 2006, II.1.3). With s = 1
// it is the implicit midpoint rule on the group. A fixed-point iteration solves the equations (ibid.,
// VIII.6). It starts from the last step's polynomial, ends when rounding errors prevent progress, and
// converges while h |da/d(q, v)| is below about 1. If it does not, Newton's method solves them in double
// (stage_newton.hpp).

#include <algorithm>
#include <array>
#include <liecheck/scalar/double_word.hpp>
#include <liecheck/scene/integrators/method.hpp>
#include <liecheck/scene/integrators/stage_newton.hpp>
#include <vector>

namespace liecheck::scene {

/// c_i, b_i, a_ij of s Gauss points on [0, 1]. e_ij extrapolates a polynomial through the points of one step
/// to the points of the next step. All are computed in double words and accurate to half an ulp.
template <Scalar S>
struct GaussPoints {
  std::vector<S> c, b;
  std::vector<std::vector<S>> a, e;
  explicit GaussPoints(int s);
};
template <Scalar S>
GaussPoints<S>::GaussPoints(int s) : c(std::size_t(s)), b(c), a(c.size(), c), e(a) {
  using T = DoubleWord<S>;
  std::vector<T> x(c.size()), w(x);
  for (int i = 0; i < s; ++i) {
    using std::cos;
    T z(S(cos(pi<S>() * (S(i) + S(3) / S(4)) / (S(s) + S(1) / S(2)))));
    T slope(1);
    for (int newton = 0; newton < 8; ++newton) {  // root of the Legendre polynomial; 6 iterations suffice
      T p0(1), p1 = z;
      for (int n = 2; n <= s; ++n) {
        const T p2 = (T(2 * n - 1) * z * p1 - T(n - 1) * p0) / T(n);
        p0 = p1, p1 = p2;
      }
      slope = T(s) * (z * p1 - p0) / (z * z - T(1));
      z -= p1 / slope;
    }
    if (s == 1) z = T(0), slope = T(1);
    x[std::size_t(s - 1 - i)] = (T(1) + z) / T(2);
    w[std::size_t(s - 1 - i)] = T(1) / ((T(1) - z * z) * slope * slope);
  }
  const auto lagrange = [&](std::size_t j, const T& at) {
    T product(1);
    for (std::size_t m = 0; m < x.size(); ++m)
      if (m != j) product *= (at - x[m]) / (x[j] - x[m]);
    return product;
  };
  for (std::size_t i = 0; i < x.size(); ++i) {
    c[i] = S(x[i]), b[i] = S(w[i]);
    for (std::size_t j = 0; j < x.size(); ++j) {
      T sum(0);  // mean of Lagrange polynomial j over [0, c_i], for which Gauss quadrature is exact
      for (std::size_t k = 0; k < x.size(); ++k) sum += w[k] * lagrange(j, x[i] * x[k]);
      a[i][j] = S(x[i] * sum);
      e[i][j] = S(lagrange(j, T(1) + x[i]));
    }
  }
}

/// The properties of the method with s Gauss points.
template <int s>
inline constexpr MethodInfo collocation_info{};
/// The implicit midpoint rule on the group. Its increment h v_m / 2 is parallel to v_m, so that J_r^-1 of the
/// increment leaves v_m unchanged:
///   v_m = v0 + h/2 a(q0 exp(h v_m/2), v_m),   q1 = q0 exp(h v_m),   v1 = 2 v_m - v0
/// The rule is symmetric: a step of -h undoes a step of h. Therefore the energy of a reversible motion does
/// not drift.
template <>
inline constexpr MethodInfo collocation_info<1>{
    .name = "implicit_midpoint",
    .order = 2,
    .equation = "v_m = v0 + h/2 a(q0 exp(h v_m/2), v_m), q1 = q0 exp(h v_m)",
    .source = "Hairer, Lubich & Wanner 2006, II.1.3",
    .increments = true,
    .preserves_energy = true};
template <>
inline constexpr MethodInfo collocation_info<3>{
    .name = "gauss6",
    .order = 6,
    .equation = "collocation of (delta, v) at 3 Gauss points, q1 = q0 exp(delta)",
    .source = "Butcher 1964, Implicit Runge-Kutta processes; Munthe-Kaas 1999",
    .increments = true};
template <>
inline constexpr MethodInfo collocation_info<6>{
    .name = "gauss12",
    .order = 12,
    .equation = "collocation of (delta, v) at 6 Gauss points, q1 = q0 exp(delta)",
    .source = "Butcher 1964, Implicit Runge-Kutta processes; Munthe-Kaas 1999",
    .increments = true};

template <System Sys, int s>
class Collocation final : public Method<Sys> {
 public:
  using S = typename Sys::Scalar;
  using Tangent = typename Sys::Tangent;
  const MethodInfo& what() const override { return collocation_info<s>; }
  MethodCounts counts() const override { return counts_; }
  void begin(Sys&, const State<Sys>& state) override {
    q_ = state.q, delta_ = v_ = K_new_ = A_new_ = state.v;
    K_.fill(state.v), A_.fill(state.v), last_.fill(state.v);
    has_last_ = stiff_ = false;
  }
  void step(Sys& system, State<Sys>& state, const S& h) override {
    static const GaussPoints<S> g(s);
    if constexpr (std::is_same_v<S, double>) {
      if (!stiff_) stiff_ = !iterate(system, state, h, g);
      if (stiff_ && !newton(system, state, h, g)) fail("by Newton's method");
    } else if (!iterate(system, state, h, g)) {
      fail("in " + std::to_string(limit) + " iterations");
    }
    sum(g.b, h, delta_, v_);
    checkFinite(delta_, v_);
    system.accumulate(state.q, state.q_low, delta_);
    accumulateAll(state.v, state.v_low, v_);
    last_ = A_, h_ = h, has_last_ = true;
    ++counts_.steps;
  }

 private:
  [[noreturn]] static void fail(const std::string& how) {
    throw StepFailed(std::string(collocation_info<s>.name) + " did not converge " + how +
                     ": take a smaller step");
  }
  /// The fixed-point iteration. False if it does not converge.
  bool iterate(Sys& system, const State<Sys>& state, const S& h, const GaussPoints<S>& g) {
    predict(system, state, h, g);
    // A body that comes to rest has no scale of its own: 1 m/s^2 (or rad/s^2) bounds the scale from below.
    const S scale = state.v.cwiseAbs().maxCoeff() + absolute<S>(h) * (A_[0].cwiseAbs().maxCoeff() + S(1));
    S change(0), before = std::numeric_limits<S>::max();
    int settled = 0;
    for (int k = 0; k <= limit; ++k) {
      change = S(0);
      for (std::size_t i = 0; i < s; ++i) {
        sum(g.a[i], h, delta_, v_);
        v_ += state.v;
        if (system.readsConfiguration()) system.integrate(state.q, delta_, q_);
        system.acceleration(S(state.t + g.c[i] * h), q_, v_, A_new_);
        system.tangentRate(delta_, v_, K_new_);
        change = std::max({change, S((K_new_ - K_[i]).cwiseAbs().maxCoeff()),
                           S(absolute<S>(h) * (A_new_ - A_[i]).cwiseAbs().maxCoeff())});
        K_[i] = K_new_, A_[i] = A_new_;
      }
      ++counts_.iterations;
      // Small elements of v may still change when the largest have converged: one more iteration.
      if (change == S(0) || (change <= S(64) * eps<S>() * scale && !(change < before) && ++settled == 2))
        return true;
      if (!finite<S>(change)) return false;
      before = change;
    }
    return false;
  }
  /// Newton's method, for double. From its first use on, it replaces the fixed-point iteration.
  bool newton(Sys& system, const State<Sys>& state, double h, const GaussPoints<S>& g) {
    const int n = system.nv();
    Y_.resize(2 * n, s);
    for (int i = 0; i < s; ++i) Y_.col(i) << h * g.c[std::size_t(i)] * state.v, 0 * state.v;
    const auto rate = [&](int i, const VectorX<double>& y, VectorX<double>& f) {
      delta_ = y.head(n), v_ = state.v + y.tail(n);
      if (system.readsConfiguration()) system.integrate(state.q, delta_, q_);
      system.acceleration(state.t + g.c[std::size_t(i)] * h, q_, v_, A_new_);
      system.tangentRate(delta_, v_, K_new_);
      f.head(n) = K_new_, f.tail(n) = A_new_;
    };
    const auto made = newton_.solve(g.a, h, state.v.cwiseAbs().maxCoeff(), std::ref(rate), Y_, F_);
    if (!made) return false;
    counts_.iterations += *made;
    for (int i = 0; i < s; ++i)
      K_[std::size_t(i)] = F_.col(i).head(n), A_[std::size_t(i)] = F_.col(i).tail(n);
    return true;
  }
  static constexpr int limit = 200;
  void sum(const std::vector<S>& weights, const S& h, Tangent& delta, Tangent& dv) const {
    delta = S(h * weights[0]) * K_[0], dv = S(h * weights[0]) * A_[0];
    for (std::size_t j = 1; j < s; ++j) delta += S(h * weights[j]) * K_[j], dv += S(h * weights[j]) * A_[j];
  }
  void predict(Sys& system, const State<Sys>& state, const S& h, const GaussPoints<S>& g) {
    if (has_last_ && h == h_ && s > 1) {
      for (std::size_t i = 0; i < s; ++i) {
        A_[i] = g.e[i][0] * last_[0];
        for (std::size_t j = 1; j < s; ++j) A_[i] += g.e[i][j] * last_[j];
      }
    } else {
      system.acceleration(state.t, state.q, state.v, A_[0]);
      for (std::size_t i = 1; i < s; ++i) A_[i] = A_[0];
    }
    for (std::size_t i = 0; i < s; ++i) {
      K_[i] = state.v;
      for (std::size_t j = 0; j < s; ++j) K_[i] += S(h * g.a[i][j]) * A_[j];
    }
  }

  typename Sys::Configuration q_;
  Tangent delta_, v_, K_new_, A_new_;
  std::array<Tangent, s> K_, A_, last_;
  S h_ = S(0);
  bool has_last_ = false, stiff_ = false;
  StageNewton newton_;
  Eigen::MatrixXd Y_, F_;
  MethodCounts counts_;
};

template <System Sys>
using ImplicitMidpoint = Collocation<Sys, 1>;
template <System Sys>
using Gauss6 = Collocation<Sys, 3>;
template <System Sys>
using Gauss12 = Collocation<Sys, 6>;

}  // namespace liecheck::scene
