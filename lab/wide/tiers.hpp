#pragma once
// The rows of `cost` in one wide scalar. tiers.cpp and tiers_digits.cpp compile two scalars each.

#include <boost/multiprecision/eigen.hpp>
#include <timing/rows.hpp>
#include <wide/wide_errors.hpp>
#include <wide/wide_scalars.hpp>

namespace liecheck::properties {

/// The errors of a function on arguments that are doubles, which its scalar holds exactly.
inline Score<double> wide_score(const Operation& operation, const Property& law, const Signature& signature,
                                AnyFunction f, double eps) {
  return [&operation, fields = law.fields(), signature, f, eps](const auto& inputs) {
    std::vector<BlockErrors> blocks;
    for (const auto& x : inputs) {
      WideNumbers in, out;
      const auto arguments = signature.arguments({FieldPositions(fields).arguments_of(operation, x)});
      signature.call(f, arguments.get(), in, out);
      add_wide_errors(blocks, operation, eps, in, out);
    }
    return blocks;
  };
}

template <class T>
void add_tier(CostPlan& plan, const std::string& scalar, std::size_t each,
              const std::vector<std::unique_ptr<Property>>& laws) {
  if (!plan.wants(plan.options.scalars, scalar) || !plan.wants(plan.options.subjects, "liecheck")) return;
  static const TypedSubject<T> library{"liecheck", LIECHECK_VERSION, wide_scalar_operations<T>()};
  const double eps = std::ldexp(1.0, 1 - std::numeric_limits<T>::digits);
  add_cost_rows<T, double>(
      plan, scalar, eps, {&library}, each, false, laws,
      [&](const Operation& operation, const Property& law, const TypedSubject<T>&, const Signature& signature,
          AnyFunction f) { return wide_score(operation, law, signature, f, eps); },
      [](const auto&...) {});
}

using AddTier = decltype(add_tier<float128>);
extern template AddTier add_tier<Digits50>;
extern template AddTier add_tier<Digits100>;

}  // namespace liecheck::properties
