// Known bugs in operations on points, motions, forces and inertias.

#include <bugs/planted_bugs.hpp>

#include <cmath>

namespace liecheck::properties {

template <class S>
auto Bugs<S>::points_motions_and_forces() -> Entries {
  return {
      {"rotate_unnormalized", "Q x Q* without 1 / |Q|^2", "Mayitzin/ahrs issue 96", op::rotate_point,
       [](const V4& Q, const V3& x) -> V3 {
         return Q.squaredNorm() * Q.squaredNorm() * good()[op::rotate_point](Q, x);
       }},
      {"rotate_conjugate", "the inverse rotation is applied", "Guo-ziwei/fusion pull 2", op::rotate_point,
       [](const V4& Q, const V3& x) -> V3 { return good()[op::rotate_point](conjugate(Q), x); }},
      {"force_as_motion", "forces are transformed as motions", "bdaiinstitute/spatialmath-python pull 207",
       op::act_force, [](const P& X, const V6& F) -> V6 { return good()[op::act_motion](X, F); }},
      {"force_transposed", "forces are transformed by Ad^T instead of Ad^-T",
       "bdaiinstitute/spatialmath-python pull 207",
       [](O& o) { o[op::act_force] = o[op::act_inverse_force]; }},
      {"adjoint_block", "the coupling block of Ad is at the lower left, as for angular-first twists",
       "rail-berkeley/hil-serl issue 36", op::act_motion,
       [](const P& X, const V6& V) -> V6 {
         const V3 u = X.R * top(V);
         return stack(u, X.R * low(V) + X.p.cross(u));
       }},
      {"cross_dual_sign", "the force cross product has the wrong sign",
       "UMich-CURLY-teaching/UMich-ROB-530-public issue 2", op::cross_force,
       [](const V6& V, const V6& F) -> V6 { return -good()[op::cross_force](V, F); }},
      {"cross_half", "u x w_W is missing in the motion cross product", "pvangoor/pylie pull 1",
       op::cross_motion,
       [](const V6& V, const V6& W) -> V6 { return stack(low(V).cross(top(W)), low(V).cross(low(W))); }},
  };
}

template <class S>
auto Bugs<S>::inertias() -> Entries {
  return {
      {"inertia_not_rotated", "the inertia of a moved body is not rotated",
       "erwincoumans/tiny-differentiable-simulator pull 102", op::act_inertia,
       [](const P& X, const B& I) -> B {
         return {I.mass, X.R * I.c + X.p, I.I_C};
       }},
      {"inertia_rotated_back", "R^T I R instead of R I R^T", "Rhoban/onshape-to-robot issue 85",
       op::act_inertia,
       [](const P& X, const B& I) -> B {
         return {I.mass, X.R * I.c + X.p, X.R.transpose() * I.I_C * X.R};
       }},
      {"inertia_shift_com", "the shift is applied before the centre of mass is rotated",
       "simbody/simbody issue 334",
       changed<op::act_inertia>([](B& b, const P& X, const B& I) { b.c = X.R * (I.c + X.p); })},
      {"parallel_axis_sign", "the parallel-axis term has the wrong sign", "dimforge/parry pull 334",
       changed<op::inertia_matrix>([](M6& M, const B& I) {
         const M3 C = hat(I.c);
         M.template bottomRightCorner<3, 3>() = I.I_C + I.mass * (C * C);
       })},
      {"parallel_axis_doubled", "the parallel-axis term is added twice",
       "ros/solidworks_urdf_exporter issue 117", changed<op::inertia_matrix>([](M6& M, const B& I) {
         const M3 C = hat(I.c);
         M.template bottomRightCorner<3, 3>() -= I.mass * (C * C);
       })},
      {"momentum_diagonal", "only the diagonal of the inertia is used", "avianphysics/avian pull 745",
       op::momentum,
       [](const B& I, const V6& V) -> V6 {
         B diagonal = I;
         diagonal.I_C = I.I_C.diagonal().asDiagonal();
         return good()[op::momentum](diagonal, V);
       }},
      {"energy_origin", "the inertia about the centre of mass is used with the velocity of the origin",
       "utiasSTARS/pyb-sim-models pull 4", op::kinetic_energy,
       [](const B& I, const V6& V) -> S {
         return (I.mass * top(V).squaredNorm() + low(V).dot(I.I_C * low(V))) / S(2);
       }},
  };
}

template struct Bugs<float>;
template struct Bugs<double>;

}  // namespace liecheck::properties
