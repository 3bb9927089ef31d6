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

/// What a joint carries at a pose: a frame, or at the identity the joint's own moving side.
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
/// A motion known in LOCAL of a frame at X_WF.
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

/// Velocity of a joint's moving side, and of a frame [m/s, rad/s]. Needs oMi, v.
template <Scalar S>
Motion<S> getVelocity(const Model<S>& model, const Data<S>& data, int joint, ReferenceFrame reference) {
  using namespace algorithms_detail;
  return velocityOf(data, placedJoint(model, data, joint), reference);
}
template <Scalar S>
Motion<S> getFrameVelocity(const Model<S>& model, const Data<S>& data, int frame, ReferenceFrame reference) {
  using namespace algorithms_detail;
  return velocityOf(data, placedFrame(model, data, frame), reference);
}
/// Their spatial acceleration [m/s^2, rad/s^2]. Needs oMi, a.
template <Scalar S>
Motion<S> getAcceleration(const Model<S>& model, const Data<S>& data, int joint, ReferenceFrame reference) {
  using namespace algorithms_detail;
  return accelerationOf(data, placedJoint(model, data, joint), reference);
}
template <Scalar S>
Motion<S> getFrameAcceleration(const Model<S>& model, const Data<S>& data, int frame,
                               ReferenceFrame reference) {
  using namespace algorithms_detail;
  return accelerationOf(data, placedFrame(model, data, frame), reference);
}
/// Their classical acceleration. Needs oMi, v, a.
template <Scalar S>
Motion<S> getClassicalAcceleration(const Model<S>& model, const Data<S>& data, int joint,
                                   ReferenceFrame reference) {
  using namespace algorithms_detail;
  return classicalAccelerationOf(data, placedJoint(model, data, joint), reference);
}
template <Scalar S>
Motion<S> getFrameClassicalAcceleration(const Model<S>& model, const Data<S>& data, int frame,
                                        ReferenceFrame reference) {
  using namespace algorithms_detail;
  return classicalAccelerationOf(data, placedFrame(model, data, frame), reference);
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
  using namespace algorithms_detail;
  const Placed<S> F = placedFrame(model, data, frame);
  const Motion<S> a = classicalAccelerationOf(data, F, ReferenceFrame::LOCAL);
  const Matrix3<S> R_WF = data.oMi[F.joint].rotation() * F.X_JF.rotation();
  return {velocityOf(data, F, ReferenceFrame::LOCAL).angular(),
          Vector3<S>(a.linear() - R_WF.transpose() * model.gravity)};
}

// float and double are compiled once, in instantiations_*.cpp; other scalars where they are used.
extern template void updateFramePlacements<float>(const Model<float>&, Data<float>&);
extern template void updateFramePlacements<double>(const Model<double>&, Data<double>&);

}  // namespace liecheck
