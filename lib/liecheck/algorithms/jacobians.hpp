#pragma once
// Jacobians J of joints and frames, and dJ, the time derivative of J's entries.
//
// J v is the velocity in J's reference frame, and J a + dJ v is its rate. In LOCAL and WORLD this rate is the
// spatial acceleration, in LOCAL_WORLD_ALIGNED the classical one, since the reference point moves.

#include <liecheck/algorithms/frames.hpp>

namespace liecheck {

/// The result of a Jacobian getter that allocates nothing: a matrix of the caller, 6 x nv.
template <class S>
using JacobianOut = Eigen::Ref<MatrixX<std::type_identity_t<S>>>;

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

/// J [6 x nv], set to 0. Throws std::invalid_argument if it has another size.
template <Scalar S>
Eigen::Ref<Matrix6X<S>> cleared(const Model<S>& model, JacobianOut<S> J) {
  if (J.rows() != 6 || J.cols() != model.nv)
    throw std::invalid_argument("J is " + std::to_string(J.rows()) + " x " + std::to_string(J.cols()) +
                                ", the Jacobian of this model is 6 x " + std::to_string(model.nv));
  J.setZero();
  return J;
}

/// Sets J [6 x nv] to the Jacobian of F. Needs data.J.
template <Scalar S>
void jacobianOf(const Model<S>& model, const Data<S>& data, const Placed<S>& F, ReferenceFrame reference,
                JacobianOut<S> out) {
  data.J();
  const Matrix3<S> R_WF = data.oMi[F.joint].rotation() * F.X_JF.rotation();
  Eigen::Ref<Matrix6X<S>> J = cleared(model, out);
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
}

/// Sets dJ [6 x nv] to the time derivative of the Jacobian of F. s' = v_i x s is the rate of column s at a
/// point fixed in space. The column's derivative is s' in WORLD, s' + (omega_s x p_dot, 0) in
/// LOCAL_WORLD_ALIGNED and X^-1 (s' - V x s) in LOCAL. Needs data.dJ.
template <Scalar S>
void jacobianRateOf(const Model<S>& model, const Data<S>& data, const Placed<S>& F, ReferenceFrame reference,
                    JacobianOut<S> out) {
  data.dJ();
  const Matrix3<S>& R = data.oMi[F.joint].rotation();
  const Matrix3<S> R_WF = R * F.X_JF.rotation();
  const Motion<S> V = shifted(data.work.velocity[F.joint], Vector3<S>(R * F.X_JF.translation()));
  Eigen::Ref<Matrix6X<S>> dJ = cleared(model, out);
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
}

}  // namespace algorithms_detail

/// J [6 x nv], the columns of every joint in WORLD, for the getters below. Updates liMi, oMi, J. q [nq].
template <Scalar S>
const Matrix6X<S>& computeJointJacobians(const Model<S>& model, Data<S>& data, In<S> q) {
  data.begin(model, q);
  auto& liMi = data.liMi.scratch();
  auto& oMi = data.oMi.scratch();
  auto& J = data.J.scratch();
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
  data.liMi.write(Level::Position), data.oMi.write(Level::Position);
  return data.J.write(Level::Position);
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

/// Jacobian [6 x nv] of a joint, or of a frame. The last argument of the second form of each getter receives the
/// result, and nothing is allocated; std::invalid_argument is thrown if it is not 6 x nv. Needs J.
template <Scalar S>
void getJointJacobian(const Model<S>& model, const Data<S>& data, int joint, ReferenceFrame reference,
                      JacobianOut<S> J) {
  jacobianOf(model, data, algorithms_detail::placedJoint(model, data, joint), reference, J);
}
template <Scalar S>
Matrix6X<S> getJointJacobian(const Model<S>& model, const Data<S>& data, int joint,
                             ReferenceFrame reference) {
  Matrix6X<S> J(6, model.nv);
  getJointJacobian(model, data, joint, reference, J);
  return J;
}
template <Scalar S>
void getFrameJacobian(const Model<S>& model, const Data<S>& data, int frame, ReferenceFrame reference,
                      JacobianOut<S> J) {
  jacobianOf(model, data, algorithms_detail::placedFrame(model, data, frame), reference, J);
}
template <Scalar S>
Matrix6X<S> getFrameJacobian(const Model<S>& model, const Data<S>& data, int frame,
                             ReferenceFrame reference) {
  Matrix6X<S> J(6, model.nv);
  getFrameJacobian(model, data, frame, reference, J);
  return J;
}
/// Time derivative of the Jacobian [6 x nv] of a joint or a frame; two forms, as above. Needs dJ.
template <Scalar S>
void getJointJacobianTimeVariation(const Model<S>& model, const Data<S>& data, int joint,
                                   ReferenceFrame reference, JacobianOut<S> dJ) {
  jacobianRateOf(model, data, algorithms_detail::placedJoint(model, data, joint), reference, dJ);
}
template <Scalar S>
Matrix6X<S> getJointJacobianTimeVariation(const Model<S>& model, const Data<S>& data, int joint,
                                          ReferenceFrame reference) {
  Matrix6X<S> dJ(6, model.nv);
  getJointJacobianTimeVariation(model, data, joint, reference, dJ);
  return dJ;
}
template <Scalar S>
void getFrameJacobianTimeVariation(const Model<S>& model, const Data<S>& data, int frame,
                                   ReferenceFrame reference, JacobianOut<S> dJ) {
  jacobianRateOf(model, data, algorithms_detail::placedFrame(model, data, frame), reference, dJ);
}
template <Scalar S>
Matrix6X<S> getFrameJacobianTimeVariation(const Model<S>& model, const Data<S>& data, int frame,
                                          ReferenceFrame reference) {
  Matrix6X<S> dJ(6, model.nv);
  getFrameJacobianTimeVariation(model, data, frame, reference, dJ);
  return dJ;
}

// instantiations_*.cpp instantiates these for float and double.
extern template decltype(computeJointJacobians<float>) computeJointJacobians<float>;
extern template decltype(computeJointJacobiansTimeVariation<float>) computeJointJacobiansTimeVariation<float>;
extern template decltype(computeJointJacobians<double>) computeJointJacobians<double>;
extern template decltype(computeJointJacobiansTimeVariation<double>)
    computeJointJacobiansTimeVariation<double>;

}  // namespace liecheck
