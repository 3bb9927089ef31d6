#include <timing/tiers.hpp>

#include <boost/multiprecision/eigen.hpp>
#include <subjects/wide_scalars.hpp>
#include <timing/wide_errors.hpp>

namespace liecheck::properties {
namespace {

/// The errors of a function on arguments that are doubles, which its scalar holds exactly.
Score<double> wide_score(const Operation& operation, const Property<double>& law, const Signature& signature,
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
void add_tier(CostPlan& plan, const std::string& scalar, int digits, std::size_t each,
              const std::vector<std::unique_ptr<Property<double>>>& laws) {
  if (!plan.wants(plan.options.scalars, scalar) || !plan.wants(plan.options.subjects, "liecheck")) return;
  static const Subject<T> library{"liecheck", LIECHECK_VERSION, wide_scalar_operations<T>()};
  const double eps = std::ldexp(1.0, 1 - digits);
  add_cost_rows<T, double>(plan, scalar, eps, {&library}, each, false, laws,
                           [&](const Operation& operation, const Property<double>& law, const Subject<T>&,
                               const Signature& signature,
                               AnyFunction f) { return wide_score(operation, law, signature, f, eps); });
}

}  // namespace

const std::vector<std::string>& cost_scalars() {
  static const std::vector<std::string> all = {"float",         "double",
#ifdef LIECHECK_QD
                                               "double-double",
#endif
                                               "float128",      "digits50", "digits100"};
  return all;
}

void add_tiers(CostPlan& plan, const std::vector<std::unique_ptr<Property<double>>>& laws) {
  // A thirty-second and a sixty-fourth of the inputs of double: a call takes a hundred and a thousand times as long.
  const std::size_t each = plan.options.inputs_per_band, few = std::max<std::size_t>(1, each / 32),
                    fewer = std::max<std::size_t>(1, each / 64);
#ifdef LIECHECK_QD
  add_tier<dd_real>(plan, "double-double", std::numeric_limits<dd_real>::digits, few, laws);
#endif
  add_tier<float128>(plan, "float128", std::numeric_limits<float128>::digits, few, laws);
  add_tier<Digits50>(plan, "digits50", std::numeric_limits<Digits50>::digits, fewer, laws);
  add_tier<Digits100>(plan, "digits100", std::numeric_limits<Digits100>::digits, fewer, laws);
}

}  // namespace liecheck::properties
