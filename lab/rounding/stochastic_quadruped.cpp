#include <generators/random_bits.hpp>
#include <invariants/tree_law.hpp>
#include <rounding/subjects.hpp>
#include <subjects/liecheck_tree.hpp>
#include <support/embedded.hpp>

namespace liecheck {

// In stochastic_algorithms.cpp.
extern template decltype(aba<properties::Stochastic>) aba<properties::Stochastic>;
extern template decltype(rnea<properties::Stochastic>) rnea<properties::Stochastic>;

namespace properties {
namespace {

const RobotNumbers& quadruped() {
  static const RobotNumbers numbers =
      robot_numbers({.name = "quadruped", .urdf = quadruped_urdf, .path = "", .hash = ""});
  return numbers;
}

/// The quadruped with [q, v, a], in T.
template <class T>
TreeCase<T> state(const std::vector<double>& x) {
  const auto& [at, numbers] = quadruped();
  std::vector<T> in_T;
  for (const double number : numbers) in_T.push_back(T(number));
  TreeCase<T> c(at, numbers, in_T);
  auto next = x.begin();
  for (std::vector<T>* part : {&c.q, &c.v, &c.a})
    for (T& number : *part) number = T(*next++);
  return c;
}

template <class S>
std::vector<double> called(const Operation& operation, const std::vector<double>& x) {
  const TreeCase<S> c = state<S>(x);
  const Model<S> model = LiecheckTree<S>::model(described(c));
  Data<S> data(model);
  const bool inverse = &operation == static_cast<const Operation*>(&op::tree_rnea);
  const VecX<S> q = eigen(c.q), v = eigen(c.v), a = eigen(c.a),
                result = inverse ? rnea(model, data, q, v, a) : aba(model, data, q, v, a);
  std::vector<double> numbers;
  for (const S& number : result) numbers.push_back(double(number));
  return numbers;
}

/// M qdd + h or, for aba, M^-1 (tau - h).
std::vector<double> exact(const Operation& operation, const std::vector<double>& x) {
  using oracles::Real;
  const TreeCase<Real> c = state<Real>(x);
  const bool inverse = &operation == static_cast<const Operation*>(&op::tree_rnea);
  const oracles::TreeDynamics<Real> dynamics(c.tree, c.q, c.v,
                                             inverse ? c.a : std::vector<Real>(c.v.size(), Real(0)));
  std::vector<Real> result = dynamics.torque();
  if (!inverse) {
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = c.a[i] - result[i];
    result = oracles::Solver<Real>(dynamics.mass(), c.v.size())(result);
  }
  std::vector<double> numbers;
  for (const Real& number : result) numbers.push_back(double(number));
  return numbers;
}

}  // namespace

std::vector<RobotFunction> quadruped_functions() {
  std::vector<RobotFunction> all;
  for (const Operation* operation :
       {static_cast<const Operation*>(&op::tree_rnea), static_cast<const Operation*>(&op::tree_aba)})
    all.push_back({operation, [=](const auto& x) { return exact(*operation, x); },
                   [=](const auto& x) { return called<double>(*operation, x); },
                   [=](const auto& x) { return called<Stochastic>(*operation, x); }});
  return all;
}

std::vector<std::vector<double>> quadruped_states(std::size_t n, std::uint64_t seed) {
  const TreeCase<double> c(quadruped().at, quadruped().numbers, quadruped().numbers);
  std::vector<std::vector<double>> all;
  for (std::size_t i = 0; i < n; ++i) {
    Source source({seed, 0, i, 0x71756164});
    Vec<double, 4> Q;
    for (const int k : {3, 2, 1, 0}) Q[k] = source.symmetric<double>();
    Q.normalize();
    std::vector<double> x;
    for (std::size_t k = 0; k < c.q.size(); ++k)
      x.push_back(k < 3   ? source.symmetric<double>()
                  : k < 7 ? Q[Eigen::Index(k) - 3]
                          : 3 * source.symmetric<double>());
    for (std::size_t k = 0; k < 2 * c.v.size(); ++k) x.push_back(source.symmetric<double>());
    all.push_back(x);
  }
  return all;
}

}  // namespace properties
}  // namespace liecheck
