#pragma once
// Section "Scenes" of the page.

#include <reports/record.hpp>
#include <string>

namespace liecheck::reports {

/// Films, charts of error against time, orders, drift, long spins, flips, other simulators, costs of effects.
std::string scenes_section(const Merged& merged);

}  // namespace liecheck::reports
