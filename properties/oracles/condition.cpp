#include <oracles/condition.hpp>

namespace liecheck::oracles {
namespace {

Real block_norm(const std::vector<Real>& y, const ConditionBlock& block) {
  Real square(0);
  for (int k = block.first; k < block.first + block.size; ++k) {
    const Real& y_k = y.at(static_cast<std::size_t>(k));
    square += y_k * y_k;
  }
  return sqrt(square);
}

}  // namespace

std::vector<double> condition(const Function& f, const std::vector<Real>& x,
                              const std::vector<ConditionBlock>& blocks) {
  static const Real relative("1e-36"), smallest("1e-40");
  std::vector<Real> sums(blocks.size(), Real(0));
  std::vector<Real> moved = x;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Real size = abs(x[i]);
    if (size == 0) continue;
    Real step = size > 1 ? relative : size * relative;
    if (step < size * smallest) step = size * smallest;
    moved[i] = x[i] + step;
    std::vector<Real> change = f(moved);
    moved[i] = x[i] - step;
    const std::vector<Real> minus = f(moved);
    moved[i] = x[i];
    for (std::size_t k = 0; k < change.size(); ++k) change[k] -= minus.at(k);
    const Real weight = size / (2 * step);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      sums[b] += block_norm(change, blocks[b]) * weight;
    }
  }
  std::vector<Real> y;
  std::vector<double> kappa;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (!blocks[b].denominator && y.empty()) y = f(x);
    const Real denominator = blocks[b].denominator ? *blocks[b].denominator : block_norm(y, blocks[b]);
    kappa.push_back(sums[b] == 0 ? 0.0 : static_cast<double>(Real(sums[b] / denominator)));
  }
  return kappa;
}

}  // namespace liecheck::oracles
