#pragma once
// Velocities and accelerations of joints and frames, in one of three reference frames.
//
//   LOCAL                axes and origin of the frame itself
//   WORLD                axes and origin of the world: the linear velocity is not that of the frame's origin
//   LOCAL_WORLD_ALIGNED  the world's axes, at the frame's origin: the linear velocity is p_dot
//
// Classical acceleration = spatial + (omega x u, 0). In LOCAL_WORLD_ALIGNED its linear part is p_ddot.

#include <liecheck/algorithms/kinematics.hpp>

namespace liecheck {

/// The names are Pinocchio's.
enum class ReferenceFrame { WORLD, LOCAL, LOCAL_WORLD_ALIGNED };

namespace algorithms_detail {

/// A frame at pose X_JF in a joint's frame. For the joint frame itself X_JF is the identity.
template <Scalar S>
struct Placed {
  std::size_t joint;
  SE3<S> X_JF;
};
template <Scalar S>
Placed<S> placedFrame(const Model<S>& model, const Data<S>& data, int frame) {
  data.check(model);
  if (frame < 0 || frame >= model.nframes)
    throw std::invalid_argument("there is no frame " + std::to_string(frame) + ": nframes is " +
                                std::to_string(model.nframes));
  const Frame<S>& F = model.frames[std::size_t(frame)];
  return {std::size_t(F.parentJoint), F.placement};
}
template <Scalar S>
Placed<S> placedJoint(const Model<S>& model, const Data<S>& data, int joint) {
  data.check(model);
  if (joint < 0 || joint >= model.njoints)
    throw std::invalid_argument("there is no joint " + std::to_string(joint) + ": njoints is " +
                                std::to_string(model.njoints));
  return {std::size_t(joint), SE3<S>::Identity()};
}
/// Converts V, the velocity or acceleration in LOCAL of a frame at X_WF, to another reference frame.
template <Scalar S>
Motion<S> expressed(const Motion<S>& V, const SE3<S>& X_WF, ReferenceFrame reference) {
  if (reference == ReferenceFrame::WORLD) return X_WF.act(V);
  if (reference == ReferenceFrame::LOCAL) return V;
  return {Vector3<S>(X_WF.rotation() * V.linear()), Vector3<S>(X_WF.rotation() * V.angular())};
}
template <Scalar S>
Motion<S> velocityOf(const Data<S>& data, const Placed<S>& F, ReferenceFrame reference) {
  return expressed(F.X_JF.actInv(data.v[F.joint]), data.oMi[F.joint] * F.X_JF, reference);
}
template <Scalar S>
Motion<S> accelerationOf(const Data<S>& data, const Placed<S>& F, ReferenceFrame reference) {
  return expressed(F.X_JF.actInv(data.a[F.joint]), data.oMi[F.joint] * F.X_JF, reference);
}
template <Scalar S>
Motion<S> classicalAccelerationOf(const Data<S>& data, const Placed<S>& F, ReferenceFrame reference) {
  const Motion<S> a = accelerationOf(data, F, reference), V = velocityOf(data, F, reference);
  return {Vector3<S>(a.linear() + cross<S>(V.angular(), V.linear())), a.angular()};
}

}  // namespace algorithms_detail

/// The poses of all frames, from those of the joints. Updates oMf. Needs oMi.
template <Scalar S>
void updateFramePlacements(const Model<S>& model, Data<S>& data) {
  data.check(model);
  const auto& oMi = data.oMi();
  auto& oMf = data.oMf.write(Level::Position);
  for (std::size_t k = 0; k < model.frames.size(); ++k)
    oMf[k] = oMi[std::size_t(model.frames[k].parentJoint)] * model.frames[k].placement;
}
/// The poses of all joints and frames. Updates liMi, oMi, oMf. q [nq].
template <Scalar S>
void framesForwardKinematics(const Model<S>& model, Data<S>& data, In<S> q) {
  forwardKinematics(model, data, q);
  updateFramePlacements(model, data);
}

/// Velocity of a joint's moving side, or of a frame [m/s, rad/s]. Throws std::invalid_argument for an index
/// that does not exist, here and below. Needs oMi, v.
template <Scalar S>
Motion<S> getVelocity(const Model<S>& model, const Data<S>& data, int joint, ReferenceFrame reference) {
  return velocityOf(data, algorithms_detail::placedJoint(model, data, joint), reference);
}
template <Scalar S>
Motion<S> getFrameVelocity(const Model<S>& model, const Data<S>& data, int frame, ReferenceFrame reference) {
  return velocityOf(data, algorithms_detail::placedFrame(model, data, frame), reference);
}
/// Spatial acceleration of a joint's moving side, or of a frame [m/s^2, rad/s^2]. Needs oMi, a.
template <Scalar S>
Motion<S> getAcceleration(const Model<S>& model, const Data<S>& data, int joint, ReferenceFrame reference) {
  return accelerationOf(data, algorithms_detail::placedJoint(model, data, joint), reference);
}
template <Scalar S>
Motion<S> getFrameAcceleration(const Model<S>& model, const Data<S>& data, int frame,
                               ReferenceFrame reference) {
  return accelerationOf(data, algorithms_detail::placedFrame(model, data, frame), reference);
}
/// Classical acceleration of a joint's moving side, or of a frame [m/s^2, rad/s^2]. Needs oMi, v, a.
template <Scalar S>
Motion<S> getClassicalAcceleration(const Model<S>& model, const Data<S>& data, int joint,
                                   ReferenceFrame reference) {
  return classicalAccelerationOf(data, algorithms_detail::placedJoint(model, data, joint), reference);
}
template <Scalar S>
Motion<S> getFrameClassicalAcceleration(const Model<S>& model, const Data<S>& data, int frame,
                                        ReferenceFrame reference) {
  return classicalAccelerationOf(data, algorithms_detail::placedFrame(model, data, frame), reference);
}

template <class S>
struct ImuReading {
  Vector3<S> angular_velocity;  ///< omega, in the frame's axes [rad/s]
  Vector3<S> specific_force;    ///< R^T (p_ddot - g), in the frame's axes [m/s^2]; 9.81 upward at rest
};
/// The reading of an inertial measurement unit at a frame. p_ddot is the acceleration of the frame's origin,
/// so it includes omega_dot x r + omega x (omega x r), where r is the offset from the joint. Needs oMi, v, a.
template <Scalar S>
ImuReading<S> imu(const Model<S>& model, const Data<S>& data, int frame) {
  using namespace algorithms_detail;
  const Placed<S> F = placedFrame(model, data, frame);
  const Motion<S> a = classicalAccelerationOf(data, F, ReferenceFrame::LOCAL);
  const Matrix3<S> R_WF = data.oMi[F.joint].rotation() * F.X_JF.rotation();
  return {velocityOf(data, F, ReferenceFrame::LOCAL).angular(),
          Vector3<S>(a.linear() - R_WF.transpose() * model.gravity)};
}

}  // namespace liecheck
