#pragma once
// Frames and joints seen from three sides.
//
//   LOCAL                reference point and axes of the frame itself
//   WORLD                the world's axes, at the world's origin: its linear part is not the velocity of the frame
//   LOCAL_WORLD_ALIGNED  the world's axes, at the frame's origin: its linear part is p_dot
//
// Classical acceleration = spatial + omega x u; only that one, in LOCAL_WORLD_ALIGNED, has p_ddot as linear part.

#include <liecheck/algorithms/kinematics.hpp>

namespace liecheck {

/// Pinocchio's names.
enum class ReferenceFrame { WORLD, LOCAL, LOCAL_WORLD_ALIGNED };

namespace algorithms_detail {

template <Scalar S>
const Frame<S>& frameAt(const Model<S>& model, int frame) {
  if (frame < 0 || frame >= model.nframes)
    throw std::invalid_argument("there is no frame " + std::to_string(frame) + ": nframes is " +
                                std::to_string(model.nframes));
  return model.frames[std::size_t(frame)];
}
template <Scalar S>
std::size_t jointAt(const Model<S>& model, int joint) {
  if (joint < 0 || joint >= model.njoints)
    throw std::invalid_argument("there is no joint " + std::to_string(joint) + ": njoints is " +
                                std::to_string(model.njoints));
  return std::size_t(joint);
}
/// A motion known in LOCAL of a frame at X_WF.
template <Scalar S>
Motion<S> expressed(const Motion<S>& V, const SE3<S>& X_WF, ReferenceFrame reference) {
  if (reference == ReferenceFrame::WORLD) return X_WF.act(V);
  if (reference == ReferenceFrame::LOCAL) return V;
  return {Vector3<S>(X_WF.rotation() * V.linear()), Vector3<S>(X_WF.rotation() * V.angular())};
}
/// The spatial acceleration a of what moves at V, both in the same reference.
template <Scalar S>
Motion<S> classical(const Motion<S>& a, const Motion<S>& V) {
  return {Vector3<S>(a.linear() + cross<S>(V.angular(), V.linear())), a.angular()};
}

}  // namespace algorithms_detail

/// Poses of all frames from those of the joints. Updates oMf, and no velocity. Needs oMi.
template <Scalar S>
void updateFramePlacements(const Model<S>& model, Data<S>& data) {
  data.check(model);
  const auto& oMi = data.oMi();
  auto& oMf = data.oMf.write(Level::Position);
  for (std::size_t k = 0; k < model.frames.size(); ++k)
    oMf[k] = oMi[std::size_t(model.frames[k].parentJoint)] * model.frames[k].placement;
}
/// Updates liMi, oMi, oMf. q [nq].
template <Scalar S>
void framesForwardKinematics(const Model<S>& model, Data<S>& data, In<S> q) {
  forwardKinematics(model, data, q);
  updateFramePlacements(model, data);
}

/// Velocity of a joint's moving side [m/s, rad/s]. Needs oMi, v.
template <Scalar S>
Motion<S> getVelocity(const Model<S>& model, const Data<S>& data, int joint, ReferenceFrame reference) {
  data.check(model);
  const std::size_t i = algorithms_detail::jointAt(model, joint);
  return algorithms_detail::expressed(data.v[i], data.oMi[i], reference);
}
/// Its spatial acceleration [m/s^2, rad/s^2]. Needs oMi, a.
template <Scalar S>
Motion<S> getAcceleration(const Model<S>& model, const Data<S>& data, int joint, ReferenceFrame reference) {
  data.check(model);
  const std::size_t i = algorithms_detail::jointAt(model, joint);
  return algorithms_detail::expressed(data.a[i], data.oMi[i], reference);
}
/// Its classical acceleration. Needs oMi, v, a.
template <Scalar S>
Motion<S> getClassicalAcceleration(const Model<S>& model, const Data<S>& data, int joint,
                                   ReferenceFrame reference) {
  return algorithms_detail::classical(getAcceleration(model, data, joint, reference),
                                      getVelocity(model, data, joint, reference));
}

/// Velocity of a frame [m/s, rad/s]. Needs oMi, v.
template <Scalar S>
Motion<S> getFrameVelocity(const Model<S>& model, const Data<S>& data, int frame, ReferenceFrame reference) {
  data.check(model);
  const Frame<S>& F = algorithms_detail::frameAt(model, frame);
  const std::size_t i = std::size_t(F.parentJoint);
  return algorithms_detail::expressed(F.placement.actInv(data.v[i]), data.oMi[i] * F.placement, reference);
}
/// Its spatial acceleration [m/s^2, rad/s^2]. Needs oMi, a.
template <Scalar S>
Motion<S> getFrameAcceleration(const Model<S>& model, const Data<S>& data, int frame,
                               ReferenceFrame reference) {
  data.check(model);
  const Frame<S>& F = algorithms_detail::frameAt(model, frame);
  const std::size_t i = std::size_t(F.parentJoint);
  return algorithms_detail::expressed(F.placement.actInv(data.a[i]), data.oMi[i] * F.placement, reference);
}
/// Its classical acceleration. Needs oMi, v, a.
template <Scalar S>
Motion<S> getFrameClassicalAcceleration(const Model<S>& model, const Data<S>& data, int frame,
                                        ReferenceFrame reference) {
  return algorithms_detail::classical(getFrameAcceleration(model, data, frame, reference),
                                      getFrameVelocity(model, data, frame, reference));
}

/// What an inertial measurement unit reads.
template <class S>
struct ImuReading {
  Vector3<S> angular_velocity;  ///< omega, in the frame's axes [rad/s]
  Vector3<S> specific_force;    ///< R^T (p_ddot - g), in the frame's axes [m/s^2]: at rest 9.81 upward
};
/// The reading of one mounted at a frame: p_ddot is that of the frame's own origin, so the lever terms
/// omega_dot x r + omega x (omega x r) of the mounting pose are in it. Needs oMi, v, a.
template <Scalar S>
ImuReading<S> imu(const Model<S>& model, const Data<S>& data, int frame) {
  const Frame<S>& F = algorithms_detail::frameAt(model, frame);
  const Motion<S> a = getFrameClassicalAcceleration(model, data, frame, ReferenceFrame::LOCAL);
  const Matrix3<S> R_WF = data.oMi[std::size_t(F.parentJoint)].rotation() * F.placement.rotation();
  return {getFrameVelocity(model, data, frame, ReferenceFrame::LOCAL).angular(),
          Vector3<S>(a.linear() - R_WF.transpose() * model.gravity)};
}

// float and double are compiled once, in instantiations_*.cpp; other scalars where they are used.
extern template void updateFramePlacements<float>(const Model<float>&, Data<float>&);
extern template void updateFramePlacements<double>(const Model<double>&, Data<double>&);

}  // namespace liecheck
