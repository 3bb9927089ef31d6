#pragma once
// Forward dynamics by the articulated-body algorithm: Featherstone (2008), table 7.1. All quantities are in
// world axes at each joint's origin, so the transform to the parent is a translation by r.
//
//   U = I^A S, D = S^T U + armature, u = tau - S^T p^A
//   I^a = I^A - U D^-1 U^T,  I^A_p += X* I^a X^-1,  p^A_p += X* (p^A + I^a c + U D^-1 u),  c = v x S qd
//   qdd = D^-1 (u - U^T (X a_p + c)),      a = X a_p + c + S qdd

#include <liecheck/algorithms/crba.hpp>
#include <liecheck/algorithms/rnea.hpp>

namespace liecheck {

namespace algorithms_detail {

/// Adds I^A = [A, B; B^T, D] to sum, with its reference point moved by -r: B' = B - A [r],
/// D' = D + [r] B' + ([r] B)^T.
template <Scalar S>
void addShifted(Matrix6<S>& sum, const Matrix6<S>& I, const Vector3<S>& r) {
  const Matrix3<S> A = I.template topLeftCorner<3, 3>(), B = I.template topRightCorner<3, 3>();
  Matrix3<S> moved, r_moved, r_B;
  for (int i = 0; i < 3; ++i) {  // column i of A [r], A symmetric
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    moved.col(i) = B.col(i) - (r[k] * A.col(j) - r[j] * A.col(k));
    r_moved.col(i) = cross<S>(r, moved.col(i));
    r_B.col(i) = cross<S>(r, B.col(i));
  }
  sum.template topLeftCorner<3, 3>() += A;
  sum.template topRightCorner<3, 3>() += moved;
  sum.template bottomLeftCorner<3, 3>() += moved.transpose();
  sum.template bottomRightCorner<3, 3>() += I.template bottomRightCorner<3, 3>() + r_moved + r_B.transpose();
}

/// The Cholesky factor L of D = L L^T [N x N], or 1 / D if N = 1. Throws SingularInertia unless D > 0.
template <int N, Scalar S>
Eigen::Matrix<S, N, N> factorOf(const Model<S>& model, int joint, const Eigen::Matrix<S, N, N>& D,
                                const Eigen::Matrix<S, N, 1>& scale) {
  using std::sqrt;
  Eigen::Matrix<S, N, N> L = D;
  for (int k = 0; k < N; ++k) {
    if (!(L(k, k) > S(64) * eps<S>() * scale[k]))
      throw SingularInertia(model.names[std::size_t(joint)], joint, finite<S>(L(k, k)));
    if constexpr (N == 1) return Eigen::Matrix<S, N, N>(S(1) / D(0, 0));
    L(k, k) = sqrt(L(k, k));
    for (int i = k + 1; i < N; ++i) L(i, k) /= L(k, k);
    for (int i = k + 1; i < N; ++i)
      for (int j = k + 1; j <= i; ++j) L(i, j) -= L(i, k) * L(j, k);
  }
  return L;
}

/// aba of a model with mimic joints. They couple branches, so M qdd = tau - h is solved with the factor of M.
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

/// qdd [nv; m/s^2, rad/s^2] = M(q)^-1 (tau - h(q, v) + sum J^T fext), tau [nv; N, N m]. Throws
/// SingularInertia. Updates liMi, oMi, ddq (with mimics also v, M).
template <Scalar S>
const VectorX<S>& aba(const Model<S>& model, Data<S>& data, In<S> q, In<S> v, In<S> tau,
                      External<S> fext = {}) {
  using namespace algorithms_detail;
  multibody_detail::checkSize(tau.size(), model.nv, "tau", "nv");
  checkForces<S>(model, fext);
  if (model.has_mimics) return denseForwardDynamics(model, data, q, v, tau, fext);
  data.begin(model, q, v);
  auto& w = data.work;
  columnsInWorldAxes(model, data, q, [&]<class Joint>(const Joint& joint) {
    const std::size_t i = std::size_t(joint.index), p = std::size_t(model.parents[i]);
    const Matrix3<S>& R = data.oMi[i].rotation();
    Motion<S> relative = Motion<S>::Zero();
    for (int k = 0; k < Joint::columns; ++k)
      relative = relative + column(w.S_columns, joint.column + k) * v[joint.idx_v + k];
    w.velocity[i] = p == 0 ? relative : shifted(w.velocity[p], w.r[i]) + relative;
    w.bias[i] = joint.velocityProduct(w.velocity[i], relative);
    const Inertia<S> I = rotated(R, model.inertias[i]);
    w.articulated[i] = I.matrix();
    w.force[i] = w.velocity[i].cross(I * w.velocity[i]);
    if (!fext.empty()) w.force[i] = w.force[i] - SE3<S>(R, Vector3<S>::Zero()).act(fext[i]);
  });
  VectorX<S>& ddq = data.ddq.write(Level::Velocity);

  for (std::size_t i = model.joints.size() - 1; i > 0; --i)
    multibody_detail::visitJoint(model, i, [&]<class Joint>(const Joint& joint) {
      constexpr int n = Joint::columns;
      const std::size_t p = std::size_t(model.parents[i]);
      const auto s = w.S_columns.template middleCols<n>(joint.column);
      auto U = w.U.template middleCols<n>(joint.column);
      auto u = w.u.template segment<n>(joint.column);
      Matrix6<S>& I = w.articulated[i];
      constexpr int rows = Joint::rotates ? 3 : 6;  // the rows of s that are not zero
      U.noalias() = I.template rightCols<rows>() * s.template bottomRows<rows>();
      Eigen::Matrix<S, n, n> D = s.template bottomRows<rows>().transpose() * U.template bottomRows<rows>();
      const Eigen::Matrix<S, n, 1> scale = (s.cwiseAbs().transpose() * U.cwiseAbs()).diagonal();
      D.diagonal() += model.armature.template segment<n>(joint.idx_v);
      const Eigen::Matrix<S, n, n> L = factorOf<n, S>(model, joint.index, D, scale);
      w.D_factor[i].template topLeftCorner<n, n>() = L;
      u = tau.template segment<n>(joint.idx_v) - s.transpose() * w.force[i].to_vector();
      Eigen::Matrix<S, 6, n> UD = U;
      if constexpr (n == 1) {
        UD *= L;
      } else {  // U and u become U L^-T and L^-1 u: D^-1 itself is less accurate if D is ill-conditioned
        const auto lower = L.template triangularView<Eigen::Lower>();
        UD = lower.solve(Eigen::Matrix<S, n, 6>(U.transpose())).transpose();
        u = lower.solve(Eigen::Matrix<S, n, 1>(u));
        U = UD;
      }
      if (p == 0) return;
      I.noalias() -= UD * U.transpose();
      const Force<S> f = w.force[i] + Force<S>(Vector6<S>(I * w.bias[i].to_vector() + UD * u));
      addShifted(w.articulated[p], I, w.r[i]);
      w.force[p] = w.force[p] + shifted(f, w.r[i]);
    });

  w.gravitated[0] = Motion<S>(Vector3<S>(-model.gravity), Vector3<S>::Zero());
  multibody_detail::forEachJoint(model, [&]<class Joint>(const Joint& joint) {
    constexpr int n = Joint::columns;
    const std::size_t i = std::size_t(joint.index), p = std::size_t(model.parents[i]);
    const auto s = w.S_columns.template middleCols<n>(joint.column);
    const auto U = w.U.template middleCols<n>(joint.column);
    const Vector6<S> a = (shifted(w.gravitated[p], w.r[i]) + w.bias[i]).to_vector();
    const Eigen::Matrix<S, n, 1> residual = w.u.template segment<n>(joint.column) - U.transpose() * a;
    const Eigen::Matrix<S, n, n> L = w.D_factor[i].template topLeftCorner<n, n>();
    Eigen::Matrix<S, n, 1> qdd;
    if constexpr (n == 1)
      qdd = L * residual;
    else
      qdd = L.transpose().template triangularView<Eigen::Upper>().solve(residual);
    ddq.template segment<n>(joint.idx_v) = qdd;
    w.gravitated[i] = Motion<S>(Vector6<S>(a + s * qdd));
  });
  return ddq;
}

// instantiations_*.cpp instantiates these for float and double.
extern template decltype(aba<float>) aba<float>;
extern template decltype(aba<double>) aba<double>;

}  // namespace liecheck
