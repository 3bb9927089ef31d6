#pragma once
// The precision in which an operation is evaluated. More accurate results take more time.

namespace liecheck {

/// fast      no compensation of rounding errors: error 16 eps of each vector or 3 x 3 block;
/// standard  the largest rounding errors are compensated: error 2 to 6 eps, as each function states;
/// tight     computed in double words and rounded once: error 1 eps of each of them for theta <= pi.
enum class Precision { fast, standard, tight };

/// An argument that names the scalar and the precision in which a formula is evaluated.
template <class S, Precision P>
struct Arithmetic {};

}  // namespace liecheck
