#pragma once
// The errors of a logarithm. If a rotation vector is on another branch, its rotation is right but its angle
// is theta - 2 pi k.

#include <invariants/common.hpp>
#include <oracles/error.hpp>
#include <oracles/exp.hpp>

namespace liecheck::properties {

/// Whether the computed rotation vector, with an error of `error` eps, is the same rotation on another
/// branch. Then its error comes from the choice of the branch and not from rounding. Two rotations are the
/// same if they differ by less than 1e-3 rad, about sqrt(eps) of a float. Two branches differ if the vectors
/// differ by at least 1 rad. In ball arithmetic, a relative error above 0.1 throws Undecided.
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

/// Records the errors of a computed (rho, phi). The first of `outputs` is the rotation vector; the second, if
/// there is one, is rho. If `branches` is false, a vector on another branch is an ordinary error.
template <class S, class T>
void record_log(Recorder& r, std::initializer_list<Output> outputs, std::size_t band,
                const Vec<S, 6>& computed, const oracles::LogValue<T>& exact, const T& separation = T(0),
                bool branches = true) {
  judged_value(r, outputs, band, computed, exact.resolved, [&] {
    const auto xi = oracles::exact_vector<6, T>(computed);
    const auto error = oracles::log_error<S>(xi, exact, separation);
    const bool other = branches && on_other_branch<S>(tail3(xi), exact.phi, error.angular);
    for (const Output& o : outputs) {
      if (other)
        r.outcome(o, band, Outcome::wrong_branch);
      else
        r.record(o, band, &o == outputs.begin() ? error.angular : error.linear);
    }
  });
}

}  // namespace liecheck::properties
