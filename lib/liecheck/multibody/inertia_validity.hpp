#pragma once
// Checks whether any body of density >= 0 can have a given inertia.

#include <liecheck/spatial/inertia.hpp>
#include <sstream>
#include <string>

namespace liecheck {

/// The pseudo-inertia J [4 x 4] = [Sigma, m c; m c^T, m], Sigma = 1/2 tr(I_O) 1 - I_O [kg m^2]: the second
/// moments of the mass in homogeneous coordinates. J >= 0 if and only if a body of density >= 0 can have the
/// inertia. Wensing, Kim & Slotine (2018), eq. 12. To avoid cancellation, Sigma is computed as
/// 1/2 tr(I_C) 1 - I_C + m c c^T.
template <Scalar S>
Eigen::Matrix<S, 4, 4> pseudoInertia(const Inertia<S>& I) {
  const Vector3<S> mc = I.mass() * I.lever();
  Matrix3<S> Sigma = mc * I.lever().transpose() - I.inertia();
  Sigma.diagonal().array() += S(I.inertia().trace() / S(2));
  Eigen::Matrix<S, 4, 4> J;
  J << Sigma, mc, mc.transpose(), I.mass();
  return J;
}

/// The reason why no body can have the inertia, or an empty string if one can. Reasons are a number that is
/// not finite, a negative mass, an I_C that is not symmetric, a negative principal moment, or one larger than
/// the sum of the other two. The checks of I_C tolerate errors of relative_slack times its largest entry. The
/// default covers the rounding errors of the eigenvalues; numbers printed with n digits need about 10^(1-n).
/// A massless point is valid.
template <Scalar S>
std::string whyUnphysical(const Inertia<S>& I, const S& relative_slack = S(16) * eps<S>()) {
  const auto say = [](const char* what, auto... values) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << what;
    ((text << ' ' << double(values)), ...);
    return text.str();
  };
  const Matrix3<S>& I_C = I.inertia();
  if (!finite<S>(I.mass()) || !I.lever().allFinite() || !I_C.allFinite()) return "a number is not finite";
  if (I.mass() < S(0)) return say("the mass is negative:", I.mass());
  const S scale = I_C.cwiseAbs().maxCoeff(), slack = relative_slack * scale;
  if ((I_C - I_C.transpose()).cwiseAbs().maxCoeff() > slack) return "the inertia is not symmetric";
  if (scale == S(0)) return {};
  const Eigen::SelfAdjointEigenSolver<Matrix3<S>> solver(I_C / scale, Eigen::EigenvaluesOnly);
  const Vector3<S> m = solver.eigenvalues() * scale;
  if (m[0] < -slack) return say("a principal moment of inertia is negative:", m[0], m[1], m[2]);
  if (m[2] > m[0] + m[1] + slack)
    return say("a principal moment of inertia is larger than the sum of the other two:", m[0], m[1], m[2]);
  return {};
}

}  // namespace liecheck
