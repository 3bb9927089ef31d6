#pragma once
// `liecheck cost`: time beside error, as text and as JSON.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <timing/cost.hpp>

namespace liecheck::properties {

struct CostFlags {
  CostOptions options;
  std::string json;
};

/// Shows how far it is, and stops at stop_requested. Throws std::invalid_argument naming what is not known, before
/// anything runs.
CostResult run_cost(const CostFlags& flags);

/// `version`, `verdict`, `environment`, `bands`, `rows`, ...; documented in the README.
nlohmann::json cost_record(const CostResult& result);

/// Puts it into a campaign's record, whose environment it shares.
void add_cost(nlohmann::json& record, const CostResult& result);

/// The table and the record. 0, or 3 where it was stopped.
int run_cost_command(const CostFlags& flags);

}  // namespace liecheck::properties
