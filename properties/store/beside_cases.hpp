#pragma once
// What a campaign finds beside its random cases, as a store keeps it with the campaign's environment.

#include <campaign/beside_cases.hpp>

namespace liecheck::properties {

/// The environment's JSON with what was found.
std::string with_beside_cases(const std::string& environment, const BesideCases& beside);
/// Takes what was found out of the environment's JSON. False if it is none.
bool take_beside_cases(std::string& environment, BesideCases& beside);

}  // namespace liecheck::properties
