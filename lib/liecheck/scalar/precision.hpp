#pragma once
// How much time an operation may spend on its last digits. spatial/evaluate.hpp is the one place that acts on it.

namespace liecheck {

/// fast      every product and sum is rounded: 16 eps of each block;
/// standard  compensated where a rounding error would show: the bounds that each function states, 2 to 6 eps;
/// tight     computed in double words and rounded once: 1 eps of each block for theta <= pi.
enum class Precision { fast, standard, tight };

/// An argument that names the scalar and the precision in which a formula is evaluated.
template <class S, Precision P>
struct Arithmetic {};

}  // namespace liecheck
