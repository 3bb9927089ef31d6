#pragma once
// Jacobians J of joints and frames, and dJ, the time derivative of J's entries.
//
// J v is the velocity in J's reference frame, and J a + dJ v is its rate. In LOCAL and WORLD this rate is the
// spatial acceleration, in LOCAL_WORLD_ALIGNED the classical one, since the reference point moves.

#include <liecheck/algorithms/frames.hpp>

namespace liecheck {

namespace algorithms_detail {

/// Calls f(place, k, s_k, d) for every column k of every joint between the universe and the frame F. s_k is
/// in world axes at the joint's origin. d [m] is the vector from that origin to F's, summed along the tree.
template <Scalar S, class Function>
void forEachSupportingColumn(const Model<S>& model, const Data<S>& data, const Placed<S>& F, Function f) {
  const auto& oMi = data.oMi();
  Vector3<S> d = oMi[F.joint].rotation() * F.X_JF.translation();
  for (std::size_t i = F.joint; i > 0; i = std::size_t(model.parents[i])) {
    multibody_detail::visitJoint(model, i, [&]<class Joint>(const Joint& place) {
      S columns[6 * Joint::columns];
      place.subspaceIn(oMi[i].rotation(), columns);
      for (int k = 0; k < Joint::columns; ++k) f(place, k, column(columns, k), d);
    });
    d += product<S>(oMi[std::size_t(model.parents[i])].rotation(), data.liMi[i].translation());
  }
}

/// Sets data.work.jacobian to the Jacobian [6 x nv] of F. Needs J.
template <Scalar S>
const Matrix6X<S>& jacobianOf(const Model<S>& model, Data<S>& data, const Placed<S>& F,
                              ReferenceFrame reference) {
  data.J();
  const Matrix3<S> R_WF = data.oMi[F.joint].rotation() * F.X_JF.rotation();
  auto& J = data.work.jacobian;
  J.setZero();
  forEachSupportingColumn(model, data, F, [&](const auto& place, int k, const Motion<S>& s_k, Vector3<S> d) {
    if (reference == ReferenceFrame::WORLD) d = -data.oMi[std::size_t(place.index)].translation();
    const Motion<S> s = shifted(s_k, d);
    auto Jk = J.col(place.idx_v + k);
    if (reference == ReferenceFrame::LOCAL) {
      Jk.template head<3>() += R_WF.transpose() * s.linear();
      Jk.template tail<3>() += R_WF.transpose() * s.angular();
    } else {
      Jk += s.to_vector();
    }
  });
  return J;
}

/// Sets data.work.jacobian to the time derivative of the Jacobian [6 x nv] of F. s' = v_i x s is the rate of
/// column s at a point fixed in space. The column's derivative is s' in WORLD, s' + (omega_s x p_dot, 0) in
/// LOCAL_WORLD_ALIGNED and X^-1 (s' - V x s) in LOCAL. Needs dJ.
template <Scalar S>
const Matrix6X<S>& jacobianRateOf(const Model<S>& model, Data<S>& data, const Placed<S>& F,
                                  ReferenceFrame reference) {
  data.dJ();
  const Matrix3<S>& R = data.oMi[F.joint].rotation();
  const Matrix3<S> R_WF = R * F.X_JF.rotation();
  const Motion<S> V = shifted(data.work.velocity[F.joint], Vector3<S>(R * F.X_JF.translation()));
  auto& dJ = data.work.jacobian;
  dJ.setZero();
  forEachSupportingColumn(model, data, F, [&](const auto& place, int k, const Motion<S>& s_k, Vector3<S> d) {
    if (reference == ReferenceFrame::WORLD) d = -data.oMi[std::size_t(place.index)].translation();
    const Motion<S> s = shifted(s_k, d);
    Motion<S> rate = shifted(column(data.work.dS, place.column + k), d);
    if (reference == ReferenceFrame::LOCAL_WORLD_ALIGNED)
      rate = {Vector3<S>(rate.linear() + cross<S>(s.angular(), V.linear())), rate.angular()};
    if (reference == ReferenceFrame::LOCAL) {
      rate = rate - V.cross(s);
      rate = {Vector3<S>(R_WF.transpose() * rate.linear()), Vector3<S>(R_WF.transpose() * rate.angular())};
    }
    dJ.col(place.idx_v + k) += rate.to_vector();
  });
  return dJ;
}

}  // namespace algorithms_detail

/// J [6 x nv], the columns of every joint in WORLD, for the getters below. Updates liMi, oMi, J. q [nq].
template <Scalar S>
const Matrix6X<S>& computeJointJacobians(const Model<S>& model, Data<S>& data, In<S> q) {
  data.begin(model, q);
  auto& liMi = data.liMi.write(Level::Position);
  auto& oMi = data.oMi.write(Level::Position);
  auto& J = data.J.write(Level::Position);
  if (model.has_mimics) J.setZero();
  multibody_detail::forEachJoint(model, [&]<class Joint>(const Joint& joint) {
    const std::size_t i = std::size_t(joint.index), p = std::size_t(model.parents[i]);
    algorithms_detail::placeJoint(joint, q, p, liMi[i], oMi);
    const Matrix3<S>& R = oMi[i].rotation();
    const Vector3<S>& o = oMi[i].translation();
    if constexpr (Joint::rotates) {
      const Vector3<S> w = joint.joint.axis.in(R);
      auto J_i = J.col(joint.idx_v);
      J_i.template head<3>() = cross<S>(o, w);
      J_i.template tail<3>() = w;
    } else if constexpr (Joint::columns == 6) {  // [R, [o] R; 0, R]
      S* to = J.data() + 6 * joint.idx_v;
      for (int k = 0; k < 3; ++k, to += 6) {
        const Vector3<S> w(R(0, k), R(1, k), R(2, k)), u = cross<S>(w, Vector3<S>(-o[0], -o[1], -o[2]));
        to[0] = to[21] = w[0], to[1] = to[22] = w[1], to[2] = to[23] = w[2];
        to[3] = to[4] = to[5] = S(0);
        to[18] = u[0], to[19] = u[1], to[20] = u[2];
      }
    } else {
      S columns[6 * Joint::columns];
      joint.subspaceIn(R, columns);
      for (int k = 0; k < Joint::columns; ++k) {
        using namespace algorithms_detail;
        const Motion<S> s = shifted(column<S>(columns, k), Vector3<S>(-o));
        if constexpr (Joint::mimics)
          J.col(joint.idx_v + k) += s.to_vector();
        else
          J.col(joint.idx_v + k) = s.to_vector();
      }
    }
  });
  return J;
}

/// J and its time derivative dJ [6 x nv]; returns dJ. Updates liMi, oMi, J, dJ. q [nq], v [nv].
template <Scalar S>
const Matrix6X<S>& computeJointJacobiansTimeVariation(const Model<S>& model, Data<S>& data, In<S> q,
                                                      In<S> v) {
  computeJointJacobians(model, data, q);
  algorithms_detail::columnsInWorldAxes(model, data, q);
  data.begin(model, q, v);
  auto& V = data.work.velocity;
  auto& dJ = data.dJ.write(Level::Velocity);
  dJ.setZero();
  for (std::size_t i = 1; i < model.joints.size(); ++i) {
    V[i] = algorithms_detail::shifted(V[std::size_t(model.parents[i])], data.work.r[i]);
    const int begin = model.idx_columns[i], end = begin + model.column_counts[i];
    for (int k = begin; k < end; ++k)
      V[i] = V[i] + algorithms_detail::column(data.work.S_columns, k) * v[model.column_to_v[std::size_t(k)]];
    for (int k = begin; k < end; ++k) {
      const Motion<S> rate = V[i].cross(algorithms_detail::column(data.work.S_columns, k));
      data.work.dS.col(k) = rate.to_vector();
      const Vector3<S> to_world = -data.oMi[i].translation();
      dJ.col(model.column_to_v[std::size_t(k)]) += algorithms_detail::shifted(rate, to_world).to_vector();
    }
  }
  return dJ;
}

/// Jacobian [6 x nv] of a joint, or of a frame. The next getter overwrites the result. Needs J.
template <Scalar S>
const Matrix6X<S>& getJointJacobian(const Model<S>& model, Data<S>& data, int joint,
                                    ReferenceFrame reference) {
  return jacobianOf(model, data, algorithms_detail::placedJoint(model, data, joint), reference);
}
template <Scalar S>
const Matrix6X<S>& getFrameJacobian(const Model<S>& model, Data<S>& data, int frame,
                                    ReferenceFrame reference) {
  return jacobianOf(model, data, algorithms_detail::placedFrame(model, data, frame), reference);
}
/// Time derivative of the Jacobian [6 x nv] of a joint or a frame. The next getter overwrites it. Needs dJ.
template <Scalar S>
const Matrix6X<S>& getJointJacobianTimeVariation(const Model<S>& model, Data<S>& data, int joint,
                                                 ReferenceFrame reference) {
  return jacobianRateOf(model, data, algorithms_detail::placedJoint(model, data, joint), reference);
}
template <Scalar S>
const Matrix6X<S>& getFrameJacobianTimeVariation(const Model<S>& model, Data<S>& data, int frame,
                                                 ReferenceFrame reference) {
  return jacobianRateOf(model, data, algorithms_detail::placedFrame(model, data, frame), reference);
}

// instantiations_*.cpp instantiates these for float and double.
extern template decltype(computeJointJacobians<float>) computeJointJacobians<float>;
extern template decltype(computeJointJacobiansTimeVariation<float>) computeJointJacobiansTimeVariation<float>;
extern template decltype(computeJointJacobians<double>) computeJointJacobians<double>;
extern template decltype(computeJointJacobiansTimeVariation<double>)
    computeJointJacobiansTimeVariation<double>;

}  // namespace liecheck
