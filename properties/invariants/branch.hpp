#pragma once
// A rotation vector of the right rotation, but not the shortest one: theta - 2 pi k about the same axis.

#include <oracles/error.hpp>
#include <oracles/exp.hpp>

namespace liecheck::properties {

/// Is the computed rotation vector, `error` eps away from the exact one, that of the same rotation on another
/// branch? Its error is then 2 pi |k| by the choice of the branch and not by rounding. Same: within 1e-3 rad,
/// half the digits of a float; another: the vectors differ by more than 1 rad. In balls it is left undecided
/// where the vectors differ at all.
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
