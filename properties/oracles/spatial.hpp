#pragma once
// Spatial algebra on stored numbers: motions, forces and inertias in another frame, the two cross products,
// momentum and kinetic energy.
//
// A pose (R, p) is used as stored: the results are polynomials in its twelve numbers, with R^T for R^-1.
//   X   = [[R, [p]R], [0, R]]          V_A = X V_B         X^-1 = [[R^T, -R^T [p]], [0, R^T]]
//   X*  = [[R, 0], [[p]R, R]]          F_A = X* F_B        X*^-1 = [[R^T, 0], [-R^T [p], R^T]]
//   inertia  (m, c, I_C) -> (m, R c + p, R I_C R^T);   I_O = I_C + m (||c||^2 I - c c^T)
//   M = [[m I, -m [c]], [m [c], I_O]],  h = M V,  E = V^T M V / 2 = m ||u + w x c||^2 / 2 + w^T I_C w / 2.
//
// Value: component by component at 100 digits. Second formula: the 6x6 matrices at 50 digits, or at 100 if
// terms cancel. A transformed inertia is confirmed by the congruence X* M X^-1 at the rotation nearest to R,
// because the congruence is an identity only for rotations.
//
// Domain: all finite numbers; inertias also need an R near a rotation.
//
// Error: below 1e-41 relative to the norm of each 3-vector or block. If terms cancel to less than 1e-50 of
// their size, the error is below 1e-91 of the terms.
//
// Source: Featherstone 2008, sections 2.8, 2.9, 2.13 and table 2.2, here with the linear part first.

#include <oracles/agreement.hpp>
#include <oracles/spatial_formulas.hpp>

namespace liecheck::oracles {

/// The result of an oracle: its value, and whether its two formulas agree.
template <class V>
struct Resolved {
  V value;
  bool resolved = false;
};
using ScalarResult = Resolved<Real>;
using PointResult = Resolved<Vec3<>>;
using SpatialResult = Resolved<Vec6<>>;
using BodyResult = Resolved<Body>;
using Matrix6Result = Resolved<Mat6<>>;

/// The pose of Q / ||Q|| and p, to 50 digits.
Pose pose_of(const Quaternion<>& Q, const Vec3<>& p);

PointResult rotate_point(const Quaternion<>& Q, const Vec3<>& x);  ///< x rotated by Q / ||Q||
PointResult act_point(const Pose& X, const Vec3<>& x);             ///< R x + p
PointResult act_inverse_point(const Pose& X, const Vec3<>& x);     ///< R^T (x - p)

SpatialResult act_motion(const Pose& X, const Vec6<>& V);
SpatialResult act_inverse_motion(const Pose& X, const Vec6<>& V);
SpatialResult act_force(const Pose& X, const Vec6<>& F);
SpatialResult act_inverse_force(const Pose& X, const Vec6<>& F);
SpatialResult cross_motion(const Vec6<>& V, const Vec6<>& W);  ///< (w x u_W + u x w_W, w x w_W)
SpatialResult cross_force(const Vec6<>& V, const Vec6<>& F);   ///< (w x f, w x n + u x f)

BodyResult act_inertia(const Pose& X, const Body& I);
BodyResult act_inverse_inertia(const Pose& X, const Body& I);
Matrix6Result inertia_matrix(const Body& I);
SpatialResult momentum(const Body& I, const Vec6<>& V);
ScalarResult kinetic_energy(const Body& I, const Vec6<>& V);
ScalarResult power(const Vec6<>& F, const Vec6<>& V);

}  // namespace liecheck::oracles
