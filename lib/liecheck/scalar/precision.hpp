#pragma once
// How much of the time an operation may spend on its last digits: the one place that chooses.

namespace liecheck {

/// fast      one rounding a product, nothing carried: 16 eps of each block;
/// standard  roundings carried where they would show: the bounds that each function states, 2 to 6 eps;
/// tight     in twice the digits and rounded at the end: 1 eps of each block up to half a turn.
enum class Precision { fast, standard, tight };

}  // namespace liecheck
