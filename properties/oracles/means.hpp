#pragma once
// Means of rotations and poses, and what lies between two poses or directions, at 50 and 100 digits.
//
//   value                                              confirmed by
//   chordal mean: Jacobi's method on sum w_i Q_i Q_i^T   M Q = l Q, and l I - M has no negative pivot
//   geodesic mean: Newton's steps, their matrix in double its definition: sum w_i log(T^-1 T_i) is zero
//   interpolation: T0 exp(t log(T0^-1 T1))               the two formulas of log.hpp and of exp.hpp
//   slerp of directions: sines of angles               the rotation of a about a x b by t theta
//   angle: 2 atan2(|a - b|, |a + b|)                     atan2(|a x b|, a . b)
//
// Error: below 1e-41. Sources: Markley et al. 2007; Moakher 2002; Pennec & Arsigny 2013.

#include <oracles/integrate.hpp>
#include <oracles/spatial.hpp>
#include <vector>

namespace liecheck::oracles {

struct MeanRotation {
  Quaternion<> Q;
  Real gap;  ///< (l1 - l2)/l1 of the two largest eigenvalues: how well the mean is determined
  bool resolved = false;
};
MeanRotation chordal_mean(const std::vector<Quaternion<>>& all, const std::vector<Real>& weights);

struct MeanPose {
  Quaternion<> Q;
  Vec3<> p;
  bool resolved = false;
};
/// Newton's steps from the rotation `start`, such as the chordal mean. For a mean of rotations, the translations are zero.
MeanPose geodesic_mean(const std::vector<Vec7<>>& all, const std::vector<Real>& weights,
                       const Quaternion<>& start);

struct Interpolated {
  IntegrateResult pose, other;  ///< `other` is that of the arc on the other side of pi
  Real pi_minus_theta;
  bool resolved = false;
};
Interpolated interpolate(const Vec7<>& q0, const Vec7<>& q1, const Real& t);

struct Between {
  Real theta;    ///< [rad] in [0, pi]
  Real terms;    ///< the norm of the sums of the |terms| of a x b
  Real opposed;  ///< pi - theta
  bool resolved = false;
};
Between angle_between(const Vec3<>& a, const Vec3<>& b);
/// Undetermined, and unresolved, for opposite directions.
Resolved<Vec3<>> slerp_directions(const Vec3<>& a, const Vec3<>& b, const Real& t);

}  // namespace liecheck::oracles
