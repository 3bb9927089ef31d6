#include <bounds/hunted.hpp>

#include <algorithm>
#include <campaign/case_id.hpp>
#include <campaign/robots.hpp>
#include <campaign/selection.hpp>
#include <hard_cases/attempt.hpp>
#include <map>
#include <utility>

namespace liecheck::properties {

namespace {

using Errors = std::map<std::pair<std::string, std::string>, double>;

/// Found by a search in double, for left_jacobian3, whose hard case is one of float:
/// liecheck hunt --subject liecheck --op left_jacobian3 --block jacobian --evaluations 9031621
constexpr const char* found =
    "raw.jacobian_oracle.liecheck.double.none.0x0.0000000000104p-1022,0x0p+0,-0x1.b0ef8dfc6bddcp+369,"
    "0x1.1064c0c6c14e5p-26,0x1.c3146b3958432p-2,0x1.8e26a8e6b5e8fp+1";

/// The errors of one input, where they are larger than those before.
void take(Errors& largest, const Series& s, const CaseId& id) {
  for (const Judged& j : attempt(s, id).judged) {
    if (j.residual.outcome != Outcome::measured || j.budget->rule != Rule::forward) continue;
    const Output& o = s.outputs[j.residual.output];
    double& error = largest[{std::string(o.operation), std::string(o.block)}];
    error = std::max(error, j.residual.error);
  }
}

Errors measured() {
  Errors largest;
  const CaseId case_found = CaseId::parse(found);
  for (const auto& s : select({{"liecheck"}, {"exp_oracle", "log_oracle", "jacobian_oracle"}, {"double"}},
                              built_in_robot())) {
    if (s->property == case_found.property) take(largest, *s, case_found);
    for (const HardCase& h : built_in_corpus())
      if (concerns(h, *s)) take(largest, *s, raw_case(*s, h));
  }
  return largest;
}

}  // namespace

double largest_error_of_hard_cases(const std::string& operation, const std::string& block) {
  static const Errors all = measured();
  const auto at = all.find({operation, block});
  return at == all.end() ? 0 : at->second;
}

}  // namespace liecheck::properties
