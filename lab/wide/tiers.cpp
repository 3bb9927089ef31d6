#include <wide/tiers.hpp>

namespace liecheck::properties {
namespace {

void add_tiers(CostPlan& plan, const std::vector<std::unique_ptr<Property>>& laws) {
  // Fewer inputs than in double, because a call takes a hundred or a thousand times as long.
  const std::size_t few = std::max<std::size_t>(1, plan.options.inputs_per_band / 32),
                    fewer = std::max<std::size_t>(1, plan.options.inputs_per_band / 64);
#ifdef LIECHECK_QD
  add_tier<dd_real>(plan, "double-double", few, laws);
#endif
  add_tier<float128>(plan, "float128", few, laws);
  add_tier<Digits50>(plan, "digits50", fewer, laws);
  add_tier<Digits100>(plan, "digits100", fewer, laws);
}

const bool linked = [] {
  linked_wide_rows = &add_tiers;
  linked_wide_scalars() = {
#ifdef LIECHECK_QD
      "double-double",
#endif
      "float128", "digits50", "digits100"};
  return true;
}();

}  // namespace
}  // namespace liecheck::properties
