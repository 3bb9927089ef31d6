#pragma once
// Relative rotations, twists, slerp, Euler angles and planar poses at 100 digits, each confirmed by a second formula at
// 50 digits (or by the two formulas of log.hpp and exp.hpp). Quaternions and directions stand for their normalised
// values.
//
//   value                                                second formula
//   angle   |log(Q0* Q1)| by oracles/log.hpp             4 asin(|Q0 - s Q1|/2) of normalised Q
//   twist   2 atan2(v . axis, w)                         4 atan(v . axis / (|(v . axis, w)| + w)), w >= 0
//   slerp   (sin((1-t)h) Q0 + sin(t h) s Q1) / sin h     Q0 exp(t log(Q0* Q1)) by oracles/log.hpp and exp.hpp
//   Euler   the product of three quaternions             the product of three matrices
//
// Error: below 1e-41. Sources: Shoemake 1985; Diebel 2006; Dobrowolski 2015.

#include <array>
#include <oracles/agreement.hpp>
#include <oracles/log.hpp>
#include <oracles/quaternion.hpp>
#include <oracles/spatial.hpp>
#include <string>

namespace liecheck::oracles {

struct RelativeAngle {
  Real theta;           ///< [rad] in [0, pi]
  Real pi_minus_theta;  ///< with relative accuracy
  Real terms;           ///< 2 |t|, t_i the sum of the sizes of the terms of v_i
  bool resolved = false;
};
RelativeAngle relative_angle(const Quaternion<>& Q0, const Quaternion<>& Q1);

struct TwistAngle {
  Real angle;           ///< [rad] in [-pi, pi]
  Real pi_minus_angle;  ///< pi - |angle|, with relative accuracy
  Real scale;           ///< max(|angle|, its sensitivity): the denominator of the error
  bool determined = false, resolved = false;
};
TwistAngle twist_angle(const Quaternion<>& Q, const Vec3<>& axis);

struct Slerp {
  Quaternion<> Q, other;  ///< `other` is that of the other arc, as long if the relative angle is pi
  Real theta, pi_minus_theta;
  bool resolved = false;
};
Slerp slerp(const Quaternion<>& Q0, const Quaternion<>& Q1, const Real& t);

/// Axes i, j, k of order 0 ... 23: docs/conventions.md.
struct Order {
  std::array<int, 3> axes;
  bool rotating;
  explicit Order(int number);
  std::string name() const;  ///< of the axes: "XYZ"
};
/// The quaternion of Euler angles [rad] of any size.
Resolved<Quaternion<>> euler(const Order& order, const Vec3<>& angles);

/// A pose in the plane, (p, r) with r = (cos, sin) of any norm.
using PlanarPose = Vec<4, Real>;
/// exp of (rho, omega), with |r| = 1.
Resolved<PlanarPose> planar_exp(const Vec3<>& delta);
Resolved<PlanarPose> planar_compose(const PlanarPose& q0, const PlanarPose& q1);
/// log of q0^-1 q1 as a pose in space: phi = (0, 0, omega).
LogResult planar_difference(const PlanarPose& q0, const PlanarPose& q1);

}  // namespace liecheck::oracles
