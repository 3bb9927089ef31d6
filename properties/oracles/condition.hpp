#pragma once
// The componentwise condition number of a block y of f(x) is kappa = sum_i ||dy/dx_i|| |x_i| / denominator.
// If every stored number x_i changes by a relative eps, y changes by at most kappa eps relative to the
// denominator, to first order. A number that is zero is stored exactly and adds nothing.
//
// The derivatives are central differences at 50 digits. The step is |x_i| 1e-36 / max(1, |x_i|), but at least
// |x_i| 1e-40. kappa needs two or three digits; these steps give about ten. The step is shorter than the
// distance of any tested number from a pole, such as 2 pi k of the inverse Jacobians. A longer step could
// cross the pole and make kappa small where it is infinite. If y has n digits fewer than 50, kappa has n
// digits fewer than ten.
//
// Sources: Higham 2002, section 1.6; Gohberg, Koltracht 1993 (componentwise condition).

#include <functional>
#include <oracles/number.hpp>
#include <utility>
#include <vector>

namespace liecheck::oracles {

template <class T>
using FunctionOf = std::function<std::vector<T>(const std::vector<T>& x)>;

/// Consecutive numbers of f(x).
struct ConditionBlock {
  int first = 0, size = 0;
};

/// sum_i ||dy/dx_i|| |x_i| of each block, which is kappa times its denominator. In Real, f is called
/// 2 x.size() times and needs no second formula. In double-double balls, f is called x.size() + 1 times for
/// one-sided differences with the step 2^-64. Balls of double always throw Undecided.
template <class T>
std::vector<T> movements(const FunctionOf<T>& f, const std::vector<T>& x,
                         const std::vector<ConditionBlock>& blocks);
/// kappa = movement / denominator; 0 if the movement is 0, infinite if only the denominator is 0. Throws
/// Undecided unless two digits are certain or kappa < 1/2, because errors are divided by max(kappa, 1).
template <class T>
double condition_number(const T& movement, const T& denominator);

/// The condition numbers of several blocks of one formula, computed together when the first one is needed.
/// `arguments()` returns the stored numbers.
template <class T, class F, class Arguments>
class Sensitivity {
 public:
  Sensitivity(F f, Arguments arguments, std::vector<ConditionBlock> blocks)
      : f_(std::move(f)), arguments_(std::move(arguments)), blocks_(std::move(blocks)) {}
  double kappa(std::size_t block, const T& denominator) const {
    return condition_number<T>(movement(block), denominator);
  }
  const T& movement(std::size_t block) const {
    if (movements_.empty()) movements_ = movements<T>(f_, arguments_(), blocks_);
    return movements_.at(block);
  }

 private:
  F f_;
  Arguments arguments_;
  std::vector<ConditionBlock> blocks_;
  mutable std::vector<T> movements_;
};
template <class T, class F, class Arguments>
Sensitivity<T, F, Arguments> sensitivity(F f, Arguments arguments, std::vector<ConditionBlock> blocks) {
  return {std::move(f), std::move(arguments), std::move(blocks)};
}

}  // namespace liecheck::oracles
