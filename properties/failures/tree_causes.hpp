#pragma once
// Operations on trees that fail on the same trees have one cause, and are told with the simplest of them.

#include <failures/blocks.hpp>
#include <map>
#include <string_view>

namespace liecheck::properties {

/// Operations that fail, each with a simpler one, of which a law forms it or that fails on the same trees. `blocks` are those
/// of one subject in one scalar. It measures up to 100 random trees with each law.
std::map<std::string_view, std::string_view> tree_causes(const std::vector<const FailedBlock*>& blocks,
                                                         std::uint64_t seed);

/// Whether a function on trees may use the spatial operation, as the bodies' inertias and forces.
bool serves_trees(std::string_view operation);

}  // namespace liecheck::properties
