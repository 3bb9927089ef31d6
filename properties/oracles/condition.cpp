#include <oracles/condition.hpp>

namespace liecheck::oracles {
namespace {

template <class T>
T block_norm(const std::vector<T>& y, const ConditionBlock& block) {
  T square(0);
  for (int k = block.first; k < block.first + block.size; ++k) {
    const T& y_k = y.at(static_cast<std::size_t>(k));
    square += y_k * y_k;
  }
  return sqrt(square);
}

/// kappa as a double, accurate to two digits.
double settled_kappa(const Real& kappa) {
  return static_cast<double>(kappa);
}
template <BallNumber T>
double settled_kappa(const T& kappa) {
  if (!(kappa.r <= 0.01 * kappa.size())) throw Undecided();
  return kappa.head();
}

Real step_of(const Real& size) {
  static const Real relative("1e-36"), smallest("1e-40");
  const Real least = size * smallest, step = size > 1 ? relative : Real(size * relative);
  return step < least ? least : step;
}
/// The arguments are doubles, so that adding a step to them is exact. A step of 2^-1000 may exceed the
/// argument, but every differentiated function is linear up to rounding over such a step.
template <BallNumber T>
T step_of(const T& size) {
  const double step =
      size.head() > 1 ? std::fmax(0x1p-64, std::ldexp(size.head(), -76)) : std::ldexp(size.head(), -64);
  return T(std::fmax(step, 0x1p-1000));
}

}  // namespace

template <class T>
std::vector<T> movements(const FunctionOf<T>& f, const std::vector<T>& x,
                         const std::vector<ConditionBlock>& blocks) {
  if (std::is_same_v<T, DoubleBall>) throw Undecided();
  constexpr bool one_sided = BallNumber<T>;
  std::vector<T> sums(blocks.size(), T(0));
  std::vector<T> moved = x, base;
  if (one_sided) base = f(x);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const T size = abs(x[i]);
    if (size == T(0)) continue;
    const T step = step_of(size);
    moved[i] = x[i] + step;
    std::vector<T> change = f(moved);
    if (!one_sided) {
      moved[i] = x[i] - step;
      base = f(moved);
    }
    moved[i] = x[i];
    for (std::size_t k = 0; k < change.size(); ++k) change[k] -= base.at(k);
    const T weight = size / (one_sided ? step : T(T(2) * step));
    for (std::size_t b = 0; b < blocks.size(); ++b) sums[b] += block_norm(change, blocks[b]) * weight;
  }
  return sums;
}

template <class T>
double condition_number(const T& movement, const T& denominator) {
  if constexpr (BallNumber<T>)  // the digits of a small kappa do not matter
    if (movement.size() + movement.r < 0.5 * (denominator.size() - denominator.r))
      return movement.size() / denominator.size();
  return movement == T(0) ? 0.0 : settled_kappa(T(movement / denominator));
}

#define LIECHECK_CONDITION(T)                                                    \
  template std::vector<T> movements(const FunctionOf<T>&, const std::vector<T>&, \
                                    const std::vector<ConditionBlock>&);         \
  template double condition_number(const T&, const T&);
LIECHECK_CONDITION(Real)
LIECHECK_CONDITION(DoubleBall)
LIECHECK_CONDITION(DoubleDoubleBall)

}  // namespace liecheck::oracles
