#include <oracles/condition.hpp>

namespace liecheck::oracles {
namespace {

template <class T>
T block_norm(const std::vector<T>& y, const ConditionBlockOf<T>& block) {
  T square(0);
  for (int k = block.first; k < block.first + block.size; ++k) {
    const T& y_k = y.at(static_cast<std::size_t>(k));
    square += y_k * y_k;
  }
  return sqrt(square);
}

/// kappa to two digits.
double settled_kappa(const Real& kappa) {
  return static_cast<double>(kappa);
}
template <BallNumber T>
double settled_kappa(const T& kappa) {
  if (!(kappa.r <= 0.01 * kappa.size())) throw Undecided();
  return kappa.head();
}

}  // namespace

namespace {

template <class T>
std::vector<double> differences(const FunctionOf<T>& f, const std::vector<T>& x,
                                const std::vector<ConditionBlockOf<T>>& blocks, const T& relative,
                                const T& smallest) {
  std::vector<T> sums(blocks.size(), T(0));
  std::vector<T> moved = x;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const T size = abs(x[i]);
    if (size == T(0)) continue;
    T step = size > T(1) ? relative : T(size * relative);
    if (step < size * smallest) step = size * smallest;
    moved[i] = x[i] + step;
    std::vector<T> change = f(moved);
    moved[i] = x[i] - step;
    const std::vector<T> minus = f(moved);
    moved[i] = x[i];
    for (std::size_t k = 0; k < change.size(); ++k) change[k] -= minus.at(k);
    const T weight = size / (T(2) * step);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      sums[b] += block_norm(change, blocks[b]) * weight;
    }
  }
  std::vector<T> y;
  std::vector<double> kappa;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (!blocks[b].denominator && y.empty()) y = f(x);
    const T denominator = blocks[b].denominator ? *blocks[b].denominator : block_norm(y, blocks[b]);
    kappa.push_back(sums[b] == T(0) ? 0.0 : settled_kappa(T(sums[b] / denominator)));
  }
  return kappa;
}

}  // namespace

std::vector<double> condition(const Function& f, const std::vector<Real>& x,
                              const std::vector<ConditionBlock>& blocks) {
  static const Real relative("1e-36"), smallest("1e-40");
  return differences<Real>(f, x, blocks, relative, smallest);
}
template <BallNumber T>
std::vector<double> condition(const FunctionOf<T>& f, const std::vector<T>& x,
                              const std::vector<ConditionBlockOf<T>>& blocks) {
  const T relative(0x1p-64);
  return differences<T>(f, x, blocks, relative, relative * T(0x1p-12));
}
template std::vector<double> condition(const FunctionOf<FastDouble>&, const std::vector<FastDouble>&,
                                       const std::vector<ConditionBlockOf<FastDouble>>&);

}  // namespace liecheck::oracles
