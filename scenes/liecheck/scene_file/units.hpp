#pragma once
// Reads quantities such as "9.81 m/s^2", "30 deg", "2 ms". A number without a unit is in SI units.

#include <string>
#include <vector>

namespace liecheck {

/// The words of a text, which '|' separates.
std::vector<std::string> alternatives(const std::string& joined);

/// The number in SI units. unit is the expected SI unit, "1" for a plain number, or several units separated
/// by '|'. Symbols: m km cm mm um, kg g t, s ms us min h, rad mrad deg turn, N kN mN, Pa, Hz, rpm, l, %,
/// sqrt(Hz); with powers (^2, ^-1), spaces for products, and / before a divisor. Throws std::invalid_argument
/// with the reason, and with the nearest units if the unit is unknown.
double parseQuantity(const std::string& text, const std::string& unit);

}  // namespace liecheck
