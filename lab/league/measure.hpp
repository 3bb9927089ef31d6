#pragma once
// The measurement of one library for the league: every operation that its adapter offers, by band of the angle.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <tellings/cells.hpp>

namespace liecheck::properties::league {

/// Registers the adapter and runs every law that it offers the operations of, judged by the profile `careful`. Returns
/// its name, its version and a list of cells, one for each operation and scalar: docs/laboratory.md. Throws
/// std::invalid_argument if the adapter does not start.
nlohmann::json measure(const std::string& adapter, const MeasureOptions& options);

/// The shortest of seven times of one call [ns], at angles from 0.3 to 2.5, through the adapter; 0 if a call fails.
double time_of_call(const std::string& adapter, const std::string& operation, const std::string& scalar);

}  // namespace liecheck::properties::league
