#pragma once
// The stage equations of an implicit Runge-Kutta method by collocation, in the coordinates of munthe_kaas.hpp.
//
//   delta_i = h sum_j a_ij K_j,   v_i = v0 + h sum_j a_ij A_j
//   K_i = J_r^-1(delta_i) v_i,    A_i = a(q0 exp delta_i, v_i)
//
// A fixed-point iteration solves them (Hairer, Lubich & Wanner 2006, VIII.6). It starts from the last step's
// polynomial, ends when rounding errors prevent progress, and converges while h |da/d(q, v)| is below about 1.
// If it does not, Newton's method solves them in double, from then on (stage_newton.hpp).

#include <algorithm>
#include <array>
#include <liecheck/scene/integrators/collocation_points.hpp>
#include <liecheck/scene/integrators/method.hpp>
#include <liecheck/scene/integrators/stage_newton.hpp>

namespace liecheck::scene {

template <System Sys, int s>
class ImplicitStages {
 public:
  using S = typename Sys::Scalar;
  using Tangent = typename Sys::Tangent;
  using Points = CollocationPoints<S>;

  void begin(const State<Sys>& state) {
    q_ = state.q, delta_ = v_ = K_new_ = A_new_ = state.v;
    K_.fill(state.v), A_.fill(state.v), last_.fill(state.v);
    has_last_ = stiff_ = false;
    if (!(state.t > S(0))) newton_.forget();  // A run begins at time 0. After an event, J may still be good.
  }
  /// Computes K and A of all stages. False if no iteration converges.
  bool solve(Sys& system, const State<Sys>& state, const S& h, const Points& g) {
    if constexpr (std::is_same_v<S, double>) {
      if (!stiff_) stiff_ = !iterate(system, state, h, g);
      return !stiff_ || newton(system, state, h, g);
    } else {
      return iterate(system, state, h, g);
    }
  }
  /// The step was accepted, so that the next one starts from its polynomial.
  void accept(const S& h) { last_ = A_, h_ = h, has_last_ = true; }
  /// For Method::memory(): the last step's polynomial. None with Newton's method, which also keeps a Jacobian.
  std::optional<std::vector<S>> memory() const {
    std::vector<S> all;
    if (stiff_) return {};
    if (has_last_) all.push_back(h_);
    for (std::size_t i = 0; i < s && has_last_; ++i)
      for (int k = 0; k < last_[i].size(); ++k) all.push_back(last_[i][k]);
    return all;
  }
  void recall(const std::vector<S>& all) {
    has_last_ = !all.empty();
    if (!has_last_) return;
    h_ = all.at(0);
    std::size_t at = 1;
    for (Tangent& A : last_)
      for (int k = 0; k < A.size(); ++k) A[k] = all.at(at++);
  }
  /// h sum w_j K_j and h sum w_j A_j.
  void sum(const std::vector<S>& weights, const S& h, Tangent& delta, Tangent& dv) const {
    delta = S(h * weights[0]) * K_[0], dv = S(h * weights[0]) * A_[0];
    for (std::size_t j = 1; j < s; ++j) delta += S(h * weights[j]) * K_[j], dv += S(h * weights[j]) * A_[j];
  }
  /// df/dy at the start of a recent step [2 nv, 2 nv], if Newton's method needed it.
  const Eigen::MatrixXd* jacobian() const { return stiff_ ? newton_.jacobian() : nullptr; }
  long iterations() const { return iterations_; }
  static std::string failure() {
    return std::is_same_v<S, double> ? "by Newton's method" : "in " + std::to_string(limit) + " iterations";
  }

 private:
  /// The fixed-point iteration. False if it does not converge.
  bool iterate(Sys& system, const State<Sys>& state, const S& h, const Points& g) {
    predict(system, state, h, g);
    // A body that comes to rest has no scale of its own: 1 m/s^2 (or rad/s^2) bounds the scale from below.
    const S scale = state.v.cwiseAbs().maxCoeff() + absolute<S>(h) * (A_[0].cwiseAbs().maxCoeff() + S(1));
    S change(0), before = std::numeric_limits<S>::max();
    int settled = 0, grown = 0;
    for (int k = 0; k <= limit; ++k) {
      change = S(0);
      system.switches().forget();
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
      ++iterations_;
      // Small elements of v may still change when the largest have converged: one more iteration.
      if (change == S(0) || (change <= S(64) * eps<S>() * scale && !(change < before) && ++settled == 2))
        return true;
      if (!finite<S>(change) || (change > S(2) * before && ++grown == 5)) return false;
      before = change;
    }
    return false;
  }
  /// Newton's method, for double. From its first use on, it replaces the fixed-point iteration.
  bool newton(Sys& system, const State<Sys>& state, double h, const Points& g) {
    const int n = system.nv();
    Y_.resize(2 * n, s), f_.resize(2 * n);
    for (int i = 0; i < s; ++i) Y_.col(i) << h * g.c[std::size_t(i)] * state.v, 0 * state.v;
    const auto rate = [&](int i, const VectorX<double>& y, VectorX<double>& f) {
      const double c = i == StageNewton::start ? 0 : g.c[std::size_t(i)];
      delta_ = y.head(n), v_ = state.v + y.tail(n);
      if (system.readsConfiguration()) system.integrate(state.q, delta_, q_);
      system.acceleration(state.t + c * h, q_, v_, A_new_);
      system.tangentRate(delta_, v_, K_new_);
      f.head(n) = K_new_, f.tail(n) = A_new_;
    };
    const auto made = newton_.solve(g.a, h, state.v.cwiseAbs().maxCoeff(), std::ref(rate), Y_, F_);
    if (!made) return false;
    iterations_ += *made;
    system.switches().forget();
    for (int i = 0; i < s; ++i) rate(i, Y_.col(i), f_);
    for (int i = 0; i < s; ++i)
      K_[std::size_t(i)] = F_.col(i).head(n), A_[std::size_t(i)] = F_.col(i).tail(n);
    return true;
  }
  static constexpr int limit = 200;
  void predict(Sys& system, const State<Sys>& state, const S& h, const Points& g) {
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
  VectorX<double> f_;
  long iterations_ = 0;
};

}  // namespace liecheck::scene
