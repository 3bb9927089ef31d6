#pragma once
// The precision in which an operation is evaluated. More accurate results take more time.

namespace liecheck {

/// The error of each vector or 3 x 3 block of the result, for theta <= pi:
/// fast      16 eps: rounding errors are not compensated;
/// standard  as each function states, at most 7.5 eps: the largest rounding errors are compensated;
/// tight     1 eps: computed in double words and rounded once.
enum class Precision { fast, standard, tight };

/// An argument that names the scalar and the precision in which a formula is evaluated.
template <class S, Precision P>
struct Arithmetic {};

}  // namespace liecheck
