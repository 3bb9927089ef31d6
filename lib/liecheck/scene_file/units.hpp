#pragma once
// "9.81 m/s^2", "30 deg", "2 ms": a number and, after it, a unit of the right dimension; without one, SI.

#include <string>

namespace liecheck {

/// The number in SI units. unit: the SI unit that is wanted, "1" for a plain number, or several separated by '|'.
/// Symbols: m km cm mm um, kg g t, s ms us min h, rad mrad deg turn, N kN mN, Pa, Hz, rpm, l, %, sqrt(Hz); with powers
/// (^2, ^-1), spaces for products, and / for what is after it. Throws std::invalid_argument saying what is wrong and
/// what is known.
double parseQuantity(const std::string& text, const std::string& unit);

}  // namespace liecheck
