#pragma once
// A rotation vector on another branch of the logarithm: the rotation is right, the angle is theta - 2 pi k.

#include <oracles/error.hpp>
#include <oracles/exp.hpp>

namespace liecheck::properties {

/// Whether the computed rotation vector, with an error of `error` eps, is the same rotation on another
/// branch. Then its error comes from the choice of the branch and not from rounding. Rotations count as the
/// same within 1e-3 rad, half the digits of a float; branches differ if the vectors differ by more than 1
/// rad. In ball arithmetic a relative error above 0.1 throws Undecided.
template <class S, class T>
bool on_other_branch(const oracles::Vec3<T>& computed, const oracles::Vec3<T>& exact, double error) {
  using namespace oracles;
  if (!(error * std::ldexp(1.0, 1 - std::numeric_limits<S>::digits) > 0.1)) return false;  // the usual case
  if constexpr (BallNumber<T>) {
    throw Undecided();
  } else {
    if (norm(computed - exact) < 1) return false;
    const ExpResult a = exp_so3(computed), b = exp_so3(exact);
    return a.resolved && b.resolved && rotation_distance(a.Q, b.Q) < Real(1) / 1000;
  }
}

}  // namespace liecheck::properties
