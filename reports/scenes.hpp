#pragma once
// Simulated scenes: error, order, drift and time of integrators.

#include <reports/record.hpp>
#include <string>

namespace liecheck::reports {

class Field;

/// Throws what is wrong with a record's `scenes`.
void check_scenes(const Field& scenes);

/// Films, diagrams of error against time, orders, drift, long spins, flips, other simulators, costs of effects.
std::string scenes_section(const Merged& merged);

}  // namespace liecheck::reports
