#include <liecheck/scene/modes.hpp>
#include <liecheck/scene/stability.hpp>

namespace liecheck::scene {
namespace {

using Vec = VectorX<double>;
using Matrix = Eigen::MatrixXd;

constexpr double increment = 1e-7;

/// The derivative of f at zero by central differences. f maps [n] to [n].
template <class F>
Matrix derivative(int n, F f) {
  Matrix D(n, n);
  for (int k = 0; k < n; ++k) {
    Vec x = Vec::Zero(n);
    x[k] = increment;
    const Vec plus = f(x);
    x[k] = -increment;
    D.col(k) = (plus - f(x)) / (2 * increment);
  }
  return D;
}

/// state with the increment y = (delta, v) [2 nv].
template <class Sys>
State<Sys> moved(const Sys& system, const State<Sys>& state, const Vec& y) {
  State<Sys> to = state;
  const typename Sys::Tangent delta = y.head(system.nv());
  system.integrate(state.q, delta, to.q);
  to.v += y.tail(system.nv());
  return to;
}

template <class Sys>
Matrix motion(Sys& system, const State<Sys>& state) {
  const int n = system.nv();
  return derivative(2 * n, [&](const Vec& y) {
    const State<Sys> at = moved(system, state, y);
    const typename Sys::Tangent delta = y.head(n);
    typename Sys::Tangent rate = at.v, a = at.v;
    system.tangentRate(delta, at.v, rate);
    system.acceleration(at.t, at.q, at.v, a);
    Vec result(2 * n);
    result << rate, a;
    return result;
  });
}

double fastest(const Matrix& J) {
  const auto modes = modesOf(J);
  return modes ? modes->fastest : 0;
}

}  // namespace

template <class Sys>
Stability stabilityOf(Setup<Sys>& setup, const State<Sys>& state, double h) {
  Sys& system = setup.system;
  const int n = system.nv();
  Stability s;
  if (const auto modes = modesOf(motion(system, state))) {
    s.stiffest = modes->fastest;
    s.natural = std::exp(std::min(std::max(h * modes->rising, 0.0), 100.0));
  }
  const auto method = makeMethod<Sys>(setup.scene.integrator, setup.scene.options);
  const auto step = [&](const Vec& y) {
    State<Sys> at = moved(system, state, y);
    method->begin(system, at);
    method->step(system, at, h);
    return at;
  };
  try {
    const State<Sys> end = step(Vec::Zero(2 * n));
    const auto modes = modesOf(derivative(2 * n, [&](const Vec& y) {
      const State<Sys> to = step(y);
      Vec result(2 * n);
      result << system.difference(end.q, to.q), to.v - end.v;
      return result;
    }));
    s.growth = modes ? modes->fastest : std::numeric_limits<double>::infinity();
  } catch (const std::runtime_error&) {  // StepFailed
    s.growth = std::numeric_limits<double>::infinity();
  } catch (const std::domain_error&) {  // SingularInertia
    s.growth = std::numeric_limits<double>::infinity();
  }
  return s;
}

template <class Sys>
std::string stiffestEffect(const Setup<Sys>& setup, const State<Sys>& state) {
  Sys all(setup.scene.model, setup.effects);
  double slowest = 0.9 * fastest(motion(all, state));
  std::string name;
  for (std::size_t i = 0; i < setup.effects.size(); ++i) {
    if (setup.effects[i]->acts() == Acts::OnModel) continue;
    Effects<double> others = setup.effects;
    others.erase(others.begin() + long(i));
    Sys without(setup.scene.model, others);
    const double fast = fastest(motion(without, state));
    if (fast < slowest) slowest = fast, name = setup.scene.effects[i].name;
  }
  return name;
}

template Stability stabilityOf(Setup<LoneBody<double>>&, const State<LoneBody<double>>&, double);
template Stability stabilityOf(Setup<ThrownBody<double>>&, const State<ThrownBody<double>>&, double);
template Stability stabilityOf(Setup<LoneJoint<double>>&, const State<LoneJoint<double>>&, double);
template Stability stabilityOf(Setup<Tree<double>>&, const State<Tree<double>>&, double);
template std::string stiffestEffect(const Setup<LoneBody<double>>&, const State<LoneBody<double>>&);
template std::string stiffestEffect(const Setup<ThrownBody<double>>&, const State<ThrownBody<double>>&);
template std::string stiffestEffect(const Setup<LoneJoint<double>>&, const State<LoneJoint<double>>&);
template std::string stiffestEffect(const Setup<Tree<double>>&, const State<Tree<double>>&);

}  // namespace liecheck::scene
