#pragma once
// The sweep of the scalar coefficients in a record: key "sweep", documented in docs/record.md.

#include <coefficients/sweep.hpp>
#include <nlohmann/json_fwd.hpp>

namespace liecheck::properties {

/// "absolute" or "relative": how the error of a coefficient is measured.
const char* error_kind(const SweptCoefficient& c);

/// "pass" and "fail" where every float was swept; "sampled" where a sample found nothing wrong.
const char* status_of(const SweepResult& result, const SweptCoefficient& c);

nlohmann::json record_of(const SweepResult& result);

/// Adds it to a campaign's record, whose verdict becomes "fail" where a documented bound is false.
void add_sweep(nlohmann::json& record, const SweepResult& result);

}  // namespace liecheck::properties
