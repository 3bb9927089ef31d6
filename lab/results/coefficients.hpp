#pragma once
// Errors of the scalar coefficients and proved bounds as records, for the reader of `--json` and for the report.

#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace liecheck::properties {

struct ProvedBound;
struct SweepResult;
struct SweptCoefficient;

/// The sweep of the scalar coefficients: key "sweep" of a campaign's record.
nlohmann::json record_of(const SweepResult& result);

/// Proved bounds of whole operations: key "bounds" of a campaign's record. `failed`: a claim is not proved.
nlohmann::json record_of(const std::vector<ProvedBound>& bounds, bool complete, bool failed);

/// "absolute" or "relative": how the error of a coefficient is measured.
const char* error_kind(const SweptCoefficient& c);

/// "fail" if an error exceeds the documented bound; otherwise "pass" if every float was swept, or "sampled".
const char* status_of(const SweepResult& result, const SweptCoefficient& c);

}  // namespace liecheck::properties
