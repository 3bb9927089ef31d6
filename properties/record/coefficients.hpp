#pragma once
// The sweep of the scalar coefficients in a record: key "sweep", documented in docs/record.md.

#include <coefficients/sweep.hpp>
#include <nlohmann/json_fwd.hpp>

namespace liecheck::properties {

/// "absolute" or "relative": how the error of a coefficient is measured.
const char* error_kind(const SweptCoefficient& c);

/// "fail" if an error exceeds the documented bound; otherwise "pass" if every float was swept, or "sampled".
const char* status_of(const SweepResult& result, const SweptCoefficient& c);

nlohmann::json record_of(const SweepResult& result);

/// Adds it to a campaign's record. The record's verdict becomes "fail" if a documented bound is wrong.
void add_sweep(nlohmann::json& record, const SweepResult& result);

}  // namespace liecheck::properties
