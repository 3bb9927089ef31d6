#pragma once
// Wrong formulas that libraries have in place of the right ones.

#include <failures/blocks.hpp>

namespace liecheck::properties {

/// The formula that gives the results of most calls that are wrong by more than a millionth, in words; or "".
std::string alternative_of(const FailedBlock& failed);

}  // namespace liecheck::properties
