#pragma once
// Articulated bodies: the motion that forces make. Featherstone (2008), table 7.1, in world axes at each joint's
// own origin, where a transform to the parent is a shift by r and nothing turns.
//
//   U = I^A S, D = S^T U + armature, u = tau - S^T p^A
//   I^A_p += X* (I^A - U D^-1 U^T) X^-1,   p^A_p += X* (p^A + I^a c + U D^-1 u),   c = v x S qd
//   qdd = D^-1 (u - U^T (X a_p + c)),      a = X a_p + c + S qdd

#include <liecheck/algorithms/crba.hpp>
#include <liecheck/algorithms/rnea.hpp>

namespace liecheck {

namespace algorithms_detail {

/// I^A seen from a point from which its reference point is r away: [A, B - A[r]; ., D + [r]B' - B^T [r]].
template <Scalar S>
void addShifted(Matrix6<S>& sum, const Matrix6<S>& I, const Vector3<S>& r) {
  const Matrix3<S> A = I.template topLeftCorner<3, 3>(), B = I.template topRightCorner<3, 3>();
  Matrix3<S> B_r, D = I.template bottomRightCorner<3, 3>();
  for (int i = 0; i < 3; ++i)  // (A [r]) row by row: a [r] = (a x r)^T
    B_r.row(i) = B.row(i) - cross<S>(A.row(i).transpose(), r).transpose();
  for (int i = 0; i < 3; ++i) {
    D.col(i) += cross<S>(r, B_r.col(i));
    D.row(i) -= cross<S>(B.col(i), r).transpose();
  }
  sum.template topLeftCorner<3, 3>() += A;
  sum.template topRightCorner<3, 3>() += B_r;
  sum.template bottomLeftCorner<3, 3>() += B_r.transpose();
  sum.template bottomRightCorner<3, 3>() += D;
}

/// D^-1 of n x n D > 0. Throws SingularInertia where the joint moves nothing.
template <int N, Scalar S>
Eigen::Matrix<S, N, N> inverseOf(const Model<S>& model, int joint, const Eigen::Matrix<S, N, N>& D,
                                 const Eigen::Matrix<S, N, 1>& scale) {
  Eigen::Matrix<S, N, N> L = D, inverse;
  for (int k = 0; k < N; ++k) {
    if (!(L(k, k) > S(64) * eps<S>() * scale[k]))
      throw SingularInertia(model.names[std::size_t(joint)], joint);
    if constexpr (N == 1) return Eigen::Matrix<S, N, N>(S(1) / D(0, 0));
    for (int i = k + 1; i < N; ++i)
      for (int j = k + 1; j <= i; ++j) L(i, j) -= L(i, k) * L(j, k) / L(k, k);
  }
  inverse = D.template selfadjointView<Eigen::Lower>().llt().solve(Eigen::Matrix<S, N, N>::Identity());
  return inverse;
}

/// With mimics, whose torques tie branches together, no tree of articulated bodies: M qdd = tau - h by factors.
template <Scalar S>
const VectorX<S>& denseForwardDynamics(const Model<S>& model, Data<S>& data, In<S> q, In<S> v, In<S> tau,
                                       External<S> fext) {
  data.require(Dense::Mass, "aba of a model with mimics");
  data.begin(model, q, v);
  VectorX<S>& ddq = data.ddq.write(Level::Velocity);
  inverseDynamics<S>(model, data, q, v, nullptr, fext, ddq);
  ddq = tau - ddq;
  crba(model, data, q);
  factorize(model, data);
  solve(model, data.work.factor, ddq);
  return ddq;
}

}  // namespace algorithms_detail

/// qdd [nv; m/s^2, rad/s^2] = M(q)^-1 (tau - h(q, v) + sum J^T fext). Throws SingularInertia. Updates liMi, oMi, ddq
/// (with mimics also v, M).
template <Scalar S>
const VectorX<S>& aba(const Model<S>& model, Data<S>& data, In<S> q, In<S> v, In<S> tau,
                      External<S> fext = {}) {
  using namespace algorithms_detail;
  multibody_detail::checkSize(tau.size(), model.nv, "tau", "nv");
  checkForces<S>(model, fext);
  if (model.has_mimics) return denseForwardDynamics(model, data, q, v, tau, fext);
  columnsInWorldAxes(model, data, q);
  data.begin(model, q, v);
  auto& w = data.work;
  const auto& oMi = data.oMi();
  VectorX<S>& ddq = data.ddq.write(Level::Velocity);

  multibody_detail::forEachJoint(model, [&]<class Joint>(const Joint& joint) {
    const std::size_t i = std::size_t(joint.index), p = std::size_t(model.parents[i]);
    const auto s = w.S_columns.template middleCols<Joint::columns>(joint.column);
    const Motion<S> relative(Vector6<S>(s * v.template segment<Joint::columns>(joint.idx_v)));
    w.velocity[i] = p == 0 ? relative : shifted(w.velocity[p], w.r[i]) + relative;
    w.bias[i] = w.velocity[i].cross(relative);
    const Inertia<S> I = turned(oMi[i].rotation(), model.inertias[i]);
    w.articulated[i] = I.matrix();
    w.force[i] = w.velocity[i].cross(I * w.velocity[i]);
    if (!fext.empty()) w.force[i] = w.force[i] - SE3<S>(oMi[i].rotation(), Vector3<S>::Zero()).act(fext[i]);
  });

  for (std::size_t i = model.joints.size() - 1; i > 0; --i)
    multibody_detail::visitJoint(model, i, [&]<class Joint>(const Joint& joint) {
      constexpr int n = Joint::columns;
      const std::size_t p = std::size_t(model.parents[i]);
      const auto s = w.S_columns.template middleCols<n>(joint.column);
      auto U = w.U.template middleCols<n>(joint.column);
      auto u = w.u.template segment<n>(joint.column);
      Matrix6<S>& I = w.articulated[i];
      if constexpr (n > 0) {
        U.noalias() = I * s;
        Eigen::Matrix<S, n, n> D = s.transpose() * U;
        const Eigen::Matrix<S, n, 1> scale = (s.cwiseAbs().transpose() * U.cwiseAbs()).diagonal();
        D.diagonal() += model.armature.template segment<n>(joint.idx_v);
        const Eigen::Matrix<S, n, n> D_inverse = inverseOf<n, S>(model, joint.index, D, scale);
        w.D_inverse[i].template topLeftCorner<n, n>() = D_inverse;
        u = tau.template segment<n>(joint.idx_v) - s.transpose() * w.force[i].to_vector();
        if (p == 0) return;
        const Eigen::Matrix<S, 6, n> UD = U * D_inverse;
        I.noalias() -= UD * U.transpose();
        const Force<S> f = w.force[i] + Force<S>(Vector6<S>(I * w.bias[i].to_vector() + UD * u));
        addShifted(w.articulated[p], I, w.r[i]);
        w.force[p] = w.force[p] + shifted(f, w.r[i]);
      }
    });

  w.gravitated[0] = Motion<S>(Vector3<S>(-model.gravity), Vector3<S>::Zero());
  multibody_detail::forEachJoint(model, [&]<class Joint>(const Joint& joint) {
    constexpr int n = Joint::columns;
    const std::size_t i = std::size_t(joint.index), p = std::size_t(model.parents[i]);
    const auto s = w.S_columns.template middleCols<n>(joint.column);
    const auto U = w.U.template middleCols<n>(joint.column);
    const Vector6<S> a = (shifted(w.gravitated[p], w.r[i]) + w.bias[i]).to_vector();
    const Eigen::Matrix<S, n, 1> rest = w.u.template segment<n>(joint.column) - U.transpose() * a;
    const Eigen::Matrix<S, n, 1> qdd = w.D_inverse[i].template topLeftCorner<n, n>() * rest;
    ddq.template segment<n>(joint.idx_v) = qdd;
    w.gravitated[i] = Motion<S>(Vector6<S>(a + s * qdd));
  });
  return ddq;
}

// float and double are compiled once, in instantiations.cpp; other scalars where they are used.
extern template const VectorX<float>& aba<float>(const Model<float>&, Data<float>&, In<float>, In<float>,
                                                 In<float>, External<float>);
extern template const VectorX<double>& aba<double>(const Model<double>&, Data<double>&, In<double>,
                                                   In<double>, In<double>, External<double>);

}  // namespace liecheck
