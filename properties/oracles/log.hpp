#pragma once
// log of a pose (Q, p) or (R, p): (rho, phi) with exp(rho, phi) = (R, p) and ||phi|| <= pi.
// A stored quaternion Q stands for Q / ||Q||, a stored matrix R for the nearest rotation, its polar factor.
//
// Value: theta = 2 atan2(||v||, |w|) and the closed form of V^-1, at 100 digits. Second formula: inverse
// scaling and squaring of the unit dual quaternion q + e p q / 2 at 50 digits. It takes ten square roots
// sqrt(q) = (q + 1) / ||q + 1||, the arcsine series near the identity, and doublings, but no atan2 and no
// V^-1. Newton's iteration X <- (X + X^-T) / 2 gives the polar factor X. Its definition confirms it:
// X^T X = I, X^T R symmetric.
//
// Domain: every finite Q != 0 and p; R with ||R^T R - I|| < 1/2 and det R > 0. Other R are unresolved.
//
// Error: below 1e-41 for phi and rho, relative to their norms. pi - theta has relative accuracy down to
// 1e-60. At theta = pi both axes are right: `other` is the log with the opposite axis.
//
// Sources: Higham 2008, sections 8.3 (polar) and 11.5 (logarithm); Daniilidis 1999 (dual quaternions).

#include <oracles/agreement.hpp>
#include <oracles/quaternion.hpp>

namespace liecheck::oracles {

template <class T>
struct LogValue {
  Vec3<T> rho, phi;
  T theta;             ///< ||phi||
  T pi_minus_theta;    ///< with relative accuracy
  bool at_pi = false;  ///< |cos(theta/2)| < 1e-60: `other` is right too
  Vec6<T> other;       ///< (rho, phi) of the opposite axis if at_pi, otherwise (rho, phi)
  bool resolved = false;

  Vec6<T> value() const { return stack(rho, phi); }
};
using LogResult = LogValue<Real>;

LogResult log_se3(const Quaternion<>& Q, const Vec3<>& p);
LogResult log_so3(const Quaternion<>& Q);
LogResult log_se3_matrix(const Mat3<>& R, const Vec3<>& p);

/// The quaternion of the polar factor of a stored matrix, at 100 digits.
struct NearestQuaternion {
  Quaternion<Real100> Q;  ///< unit, w >= 0
  bool resolved = false;
};
NearestQuaternion nearest_quaternion(const Mat3<Real100>& R);

/// log of a pose at 100 digits, for difference; Q need not be unit.
LogResult log_of(const Quaternion<Real100>& Q, const Vec3<Real100>& p);

}  // namespace liecheck::oracles
