#pragma once
// The componentwise condition number of a block y of f(x):  kappa = sum_i ||dy/dx_i|| |x_i| / denominator:
// by how many times its own size may the result move when every stored number moves by a relative eps, to
// first order and in the worst combination. A number that is zero is stored exactly and adds nothing.
//
// The derivatives are central differences at 50 digits with the step |x_i| 1e-36 / max(1, |x_i|), at least
// |x_i| 1e-40: two or three digits of kappa are wanted, and these steps leave some ten. The step is smaller
// than the distance at which any scalar under test can stand from a pole (2 pi k of the inverse Jacobians): a
// longer one would step across it and make kappa small where it is infinite. Where y is known to n digits less
// than 50, so is kappa to n digits less than ten.
//
// Sources: Higham 2002, section 1.6; Gohberg, Koltracht 1993 (componentwise condition).

#include <functional>
#include <optional>
#include <oracles/real.hpp>
#include <utility>
#include <vector>

namespace liecheck::oracles {

template <class T>
using FunctionOf = std::function<std::vector<T>(const std::vector<T>& x)>;
using Function = FunctionOf<Real>;

/// Consecutive numbers of a result, and what their change is measured by: the 2-norm of the block of f(x)
/// unless told.
template <class T>
struct ConditionBlockOf {
  int first = 0, size = 0;
  std::optional<T> denominator{};
};
using ConditionBlock = ConditionBlockOf<Real>;

/// One kappa for each block, infinite where a denominator is zero and the block moves. f is called 2 x.size()
/// times; at the precision of Real it need not be confirmed, see closed_forms.hpp.
/// In double-double balls the differences are one-sided, over x.size() + 1 calls, with the step 2^-64 in place of
/// 1e-36; throws Undecided where that leaves less than two digits, and in balls of double, which have no room for such
/// a step, always.
template <class T>
std::vector<double> condition(const FunctionOf<T>& f, const std::vector<T>& x,
                              const std::vector<ConditionBlockOf<T>>& blocks);

inline std::vector<double> condition(const Function& f, const std::vector<Real>& x,
                                     const std::vector<ConditionBlock>& blocks) {
  return condition<Real>(f, x, blocks);
}

/// sum_i ||dy/dx_i|| |x_i| of each block: kappa times its denominator.
template <class T>
std::vector<T> movements(const FunctionOf<T>& f, const std::vector<T>& x,
                         const std::vector<ConditionBlockOf<T>>& blocks);
/// movement / denominator, to two digits or Undecided; 0 where nothing moves. In balls what is below 1/2 may be
/// anything below 1: a kappa counts from 1 up.
template <class T>
double condition_number(const T& movement, const T& denominator);

/// The condition numbers of several blocks of one formula, computed together when the first one is asked for.
/// `arguments()` gives the stored numbers.
template <class T, class F, class Arguments>
class Sensitivity {
 public:
  Sensitivity(F f, Arguments arguments, std::vector<ConditionBlockOf<T>> blocks)
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
  std::vector<ConditionBlockOf<T>> blocks_;
  mutable std::vector<T> movements_;
};
template <class T, class F, class Arguments>
Sensitivity<T, F, Arguments> sensitivity(F f, Arguments arguments, std::vector<ConditionBlockOf<T>> blocks) {
  return {std::move(f), std::move(arguments), std::move(blocks)};
}

}  // namespace liecheck::oracles
