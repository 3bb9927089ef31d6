#pragma once
// Time and error of operations in a record: key "cost", documented in docs/record.md.

#include <nlohmann/json_fwd.hpp>
#include <timing/cost.hpp>

namespace liecheck::properties {

nlohmann::json record_of(const CostResult& result);

/// Adds it to a campaign's record.
void add_cost(nlohmann::json& record, const CostResult& result);

/// Returns null if nothing was timed.
nlohmann::json record_of(const Spread& time);

/// Subject and scalar, such as "liecheck double".
std::string implementation_of(const CostRow& row);

}  // namespace liecheck::properties
