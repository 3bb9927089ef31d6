#pragma once
// The hard cases in a record: key "hard_cases", documented in docs/record.md.

#include <hard_cases/hard_cases.hpp>
#include <nlohmann/json_fwd.hpp>

namespace liecheck::properties {

nlohmann::json record_of(const std::vector<HardRow>& rows);

/// Adds them to a campaign's record. The record's verdict becomes "fail" if one of them failed.
void add_hard_cases(nlohmann::json& record, const std::vector<HardRow>& rows);

}  // namespace liecheck::properties
