#pragma once
// Kinematics and dynamics of one robot in many states at once, by SIMD instructions. Each column is one
// state.
//
// Each function has a counterpart for one state in the room algorithms, which states its axes and whose
// errors it has. There are kernels for revolute, continuous, prismatic and free-flyer joints. The counterpart
// itself computes the states of models with other joints, states with quaternions or (cos, sin) off unit, and
// those in which an articulated inertia is near its rounding errors; it throws for the same input.
//
// `result` may be moved in, to use its memory again.

#include <liecheck/batch/instructions.hpp>
#include <liecheck/multibody/model.hpp>

namespace liecheck::batch {

/// One row for each coordinate, one column for each state.
template <class S>
using States = Eigen::Array<S, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Poses of the joints in the world, q [nq x m]. Result [12 njoints x m]: rows 12 i ... 12 i + 11 are the
/// nine entries of R of joint i, row by row, and its position [m].
template <std::floating_point S>
States<S> forwardKinematics(const Model<S>& model, const States<S>& q, const Options& options = {},
                            States<S> result = {});

/// tau [nv x m; N, N m] of q [nq x m], v and a [nv x m]. fext [6 njoints x m; N, N m], unless it is empty:
/// the external forces, where rows 6 i ... 6 i + 5 act on the body of joint i, in its axes at its origin.
template <std::floating_point S>
States<S> rnea(const Model<S>& model, const States<S>& q, const States<S>& v, const States<S>& a,
               const Options& options = {}, const States<S>& fext = {}, States<S> result = {});

/// qdd [nv x m; m/s^2, rad/s^2] of q [nq x m], v and tau [nv x m], fext as for rnea.
template <std::floating_point S>
States<S> aba(const Model<S>& model, const States<S>& q, const States<S>& v, const States<S>& tau,
              const Options& options = {}, const States<S>& fext = {}, States<S> result = {});

}  // namespace liecheck::batch
