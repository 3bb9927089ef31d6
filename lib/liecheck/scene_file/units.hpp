#pragma once
// Quantities: "9.81 m/s^2", "30 deg", "2 ms". A number, and a unit of the right dimension; without a unit, SI.

#include <string>

namespace liecheck {

/// The number in SI units. unit: the SI unit that is wanted, "1" for a plain number, or several separated by '|'.
/// Symbols: m km cm mm um, kg g t, s ms us min h, rad mrad deg turn, N kN mN, Pa, Hz, rpm, l, %, sqrt(Hz); with powers
/// (^2, ^-1), spaces for products, and / before a divisor. Throws std::invalid_argument that names the fault
/// and the known units.
double parseQuantity(const std::string& text, const std::string& unit);

}  // namespace liecheck
