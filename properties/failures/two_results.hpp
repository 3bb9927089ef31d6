#pragma once
// Calls whose results differ although their arguments are the same.

#include <campaign/series.hpp>
#include <string>

namespace liecheck::properties {

/// "phi[1] is 3, and -3 when the same call is made again", of a case that is measured again after others; "" if all results are
/// the same now.
std::string two_results_text(const Series& series, const CaseId& id, std::size_t output);

}  // namespace liecheck::properties
