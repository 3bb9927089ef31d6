#pragma once
// Derivatives of the velocity and the spatial acceleration of a frame with respect to q (along integrate), v and a.
//
// In the notation of derivatives.hpp, without gravity, for a supporting column s of joint j with parent p, and with V and A
// of the frame, all at the frame's origin in world axes, d = w and D = z + w x V are the changes that an observer who moves
// with the subtree sees:
//
//   dV/dq   LOCAL  R^T d     WORLD  d + s x V     LOCAL_WORLD_ALIGNED  d + (omega_s x u, omega_s x omega)
//   dA/dq   LOCAL  R^T D     WORLD  D + s x A     LOCAL_WORLD_ALIGNED  D + (omega_s x A_u, omega_s x A_omega)
//   dA/dv   y + s x V, in the axes and at the point of the reference
//   dV/dv = dA/da           the frame's Jacobian
//
// In LOCAL_WORLD_ALIGNED the reference point moves with the frame, so that the linear part of s does not appear.
// Carpentier & Mansard (2018), section III; Pinocchio issue 2702.

#include <liecheck/algorithms/derivatives.hpp>
#include <liecheck/algorithms/jacobians.hpp>

namespace liecheck {

/// The rates of all columns and the motions of all bodies, for the getters below. Updates liMi, oMi, motion_rates.
/// q [nq], v, a [nv].
template <Scalar S>
void computeForwardKinematicsDerivatives(const Model<S>& model, Data<S>& data, In<S> q, In<S> v, In<S> a) {
  using namespace algorithms_detail;
  data.require(Dense::Derivatives, "computeForwardKinematicsDerivatives");
  columnsInWorldAxes(model, data, q);
  data.begin(model, q, v, a);
  const VectorX<S> speed = v, acceleration = a;
  ratesOfColumns(model, data, speed, acceleration, External<S>(), Vector3<S>(Vector3<S>::Zero()));
  MotionRates<S>& rates = data.motion_rates.write(Level::Acceleration);
  rates.columns = data.work.rates;
  rates.velocity = data.work.bias, rates.acceleration = data.work.gravitated, rates.from_root = data.work.r;
}

namespace algorithms_detail {

/// The derivatives of one column: of V and A by q, of A by v, and of V by v.
template <class S>
struct MotionDerivatives {
  Motion<S> velocity_q, acceleration_q, acceleration_v, velocity_v;
};
/// Calls f(index in v, MotionDerivatives) for each supporting column of a frame.
template <Scalar S, class F>
void forEachMotionDerivative(const Model<S>& model, const Data<S>& data, const Placed<S>& frame,
                             ReferenceFrame reference, F f) {
  const MotionRates<S>& rates = data.motion_rates();
  const auto& oMi = data.oMi();
  const Matrix3<S>& R = oMi[frame.joint].rotation();
  const Vector3<S> lever = R * frame.X_JF.translation(), at = rates.from_root[frame.joint] + lever,
                   to_world = -(oMi[frame.joint].translation() + lever);
  const Matrix3<S> R_WF = R * frame.X_JF.rotation();
  const Motion<S> V = shifted(rates.velocity[frame.joint], at),
                  A = shifted(rates.acceleration[frame.joint], at);
  const auto local = [&](const Motion<S>& m) -> Motion<S> {
    return {Vector3<S>(R_WF.transpose() * m.linear()), Vector3<S>(R_WF.transpose() * m.angular())};
  };
  const auto turned = [](const Motion<S>& s, const Motion<S>& m) -> Motion<S> {
    return {Vector3<S>(cross<S>(s.angular(), m.linear())), Vector3<S>(cross<S>(s.angular(), m.angular()))};
  };
  for (std::size_t i = frame.joint; i > 0; i = std::size_t(model.parents[i])) {
    const int begin = model.idx_columns[i], end = begin + model.column_counts[i];
    for (int k = begin; k < end; ++k) {
      const RateColumn<S> column{const_cast<S*>(rates.columns.data()) + 24 * k};
      const auto get = [&](int first) { return shifted(column.get(first), at); };
      const Motion<S> s = get(RateColumn<S>::s), w = get(RateColumn<S>::w), z = get(RateColumn<S>::z), d = w,
                      D = z + crossed(w, V), y = get(RateColumn<S>::y) + crossed(s, V);
      MotionDerivatives<S> all{d, D, y, s};
      if (reference == ReferenceFrame::LOCAL)
        all = {local(d), local(D), local(y), local(s)};
      else if (reference == ReferenceFrame::LOCAL_WORLD_ALIGNED)
        all = {d + turned(s, V), D + turned(s, A), y, s};
      else
        all = {shifted(d + crossed(s, V), to_world), shifted(D + crossed(s, A), to_world),
               shifted(y, to_world), shifted(s, to_world)};
      f(model.column_to_v[std::size_t(k)], all);
    }
  }
}

}  // namespace algorithms_detail

/// dV/dq and dV/dv [6 x nv] of a frame. Throws std::invalid_argument if a matrix has another size or there is no such
/// frame. Needs motion_rates.
template <Scalar S>
void getFrameVelocityDerivatives(const Model<S>& model, const Data<S>& data, int frame,
                                 ReferenceFrame reference, JacobianOut<S> dV_dq, JacobianOut<S> dV_dv) {
  using namespace algorithms_detail;
  Eigen::Ref<Matrix6X<S>> by_q = cleared(model, dV_dq), by_v = cleared(model, dV_dv);
  forEachMotionDerivative(model, data, placedFrame(model, data, frame), reference, [&](int k, const auto& d) {
    by_q.col(k) += d.velocity_q.to_vector(), by_v.col(k) += d.velocity_v.to_vector();
  });
}
/// dA/dq, dA/dv and dA/da [6 x nv] of the spatial acceleration of a frame, as getFrameAcceleration gives it. Throws as above.
/// Needs motion_rates.
template <Scalar S>
void getFrameAccelerationDerivatives(const Model<S>& model, const Data<S>& data, int frame,
                                     ReferenceFrame reference, JacobianOut<S> dA_dq, JacobianOut<S> dA_dv,
                                     JacobianOut<S> dA_da) {
  using namespace algorithms_detail;
  Eigen::Ref<Matrix6X<S>> by_q = cleared(model, dA_dq), by_v = cleared(model, dA_dv),
                          by_a = cleared(model, dA_da);
  forEachMotionDerivative(model, data, placedFrame(model, data, frame), reference, [&](int k, const auto& d) {
    by_q.col(k) += d.acceleration_q.to_vector(), by_v.col(k) += d.acceleration_v.to_vector(),
        by_a.col(k) += d.velocity_v.to_vector();
  });
}

}  // namespace liecheck
