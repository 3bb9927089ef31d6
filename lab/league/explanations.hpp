#pragma once
// What a finding says of an operation, whatever the library.

#include <string>

namespace liecheck::properties::league {

/// A form that does not have the defect.
std::string repair_of(const std::string& operation);

/// The two formulas of the oracle, which agree to 41 digits where a case is judged.
std::string oracles_of(const std::string& operation);

}  // namespace liecheck::properties::league
