#pragma once
// The operational-space inertia of a frame: Lambda = (J M^-1 J^T)^-1 [6 x 6], the inertia that a wrench on the frame feels.
// Source: Khatib 1987, eq. 37.

#include <liecheck/algorithms/crba.hpp>
#include <liecheck/algorithms/jacobians.hpp>

namespace liecheck {
namespace algorithms_detail {

/// Whether the rows of J [6 x nv], each scaled to length 1, are linearly independent up to 64 eps: by modified
/// Gram-Schmidt, the longest rest first. The smallest singular value of such rows is at most an eps of the largest
/// where they are dependent, and 1e-4 of it in all other of 18,000 Jacobians of random trees. K below cannot tell:
/// its errors are those of J times the condition of M.
template <Scalar S>
bool hasFullRank(const Matrix6X<S>& J) {
  using std::sqrt;
  Eigen::Matrix<S, Eigen::Dynamic, 6> rows = J.transpose();
  for (int i = 0; i < 6; ++i) {
    const S l = S(sqrt(S(rows.col(i).squaredNorm())));
    if (!(S(0) < l)) return false;
    rows.col(i) *= S(S(1) / l);
  }
  for (int i = 0; i < 6; ++i) {
    int longest = i;
    S square(0);
    for (int k = i; k < 6; ++k)
      if (const S own = rows.col(k).squaredNorm(); square < own) square = own, longest = k;
    if (longest != i) rows.col(i).swap(rows.col(longest));
    const S l = S(sqrt(square));
    if (!(S(64) * eps<S>() < l)) return false;
    rows.col(i) *= S(S(1) / l);
    for (int k = i + 1; k < 6; ++k) rows.col(k) -= S(rows.col(i).dot(rows.col(k))) * rows.col(i);
  }
  return true;
}

}  // namespace algorithms_detail

/// Lambda [6 x 6; kg, kg m, kg m^2] of a frame in the reference. Throws SingularInertia if M is not positive definite, and
/// std::domain_error if J has not full rank, as for fewer than six coordinates: then a wrench can act without a motion.
/// It throws std::domain_error, too, if J M^-1 J^T is singular to the precision of S.
/// Updates liMi, oMi, J, M. q [nq].
template <Scalar S>
Matrix6<S> computeOperationalSpaceInertia(const Model<S>& model, Data<S>& data, In<S> q, int frame,
                                          ReferenceFrame reference) {
  using namespace algorithms_detail;
  computeJointJacobians(model, data, q);
  Matrix6X<S> Y = getFrameJacobian(model, data, frame, reference);
  if (!hasFullRank<S>(Y)) throw std::domain_error("the frame's Jacobian has not full rank");
  crba(model, data, q);
  factorize(model, data);
  // K = Y Y^T with Y = J L^-1 of M = L^T L, row k of which is on the path of k: columns of zeros, off the frame's path, stay.
  Matrix6<S> K = Matrix6<S>::Zero();
  const int *const path = data.work.path.data(), *const row = data.work.row.data();
  const S* const L_ = data.work.factor.data();
  for (int k = model.nv - 1; k >= 0; --k) {
    if (Y.col(k).isZero(S(0))) continue;
    const int end = row[k] + data.work.depth[std::size_t(k)];
    const Vector6<S> y = Y.col(k) / L_[end];
    for (int t = row[k]; t < end; ++t) Y.col(path[t]) -= L_[t] * y;
    for (int i = 0; i < 6; ++i) K.col(i) += y[i] * y;
  }
  // Scaled to a unit diagonal: forces and moments have other units.
  Vector6<S> scale;
  using std::sqrt;
  for (int i = 0; i < 6; ++i) scale[i] = S(1) / S(sqrt(K(i, i)));
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) K(i, j) *= scale[i] * scale[j];
  Matrix6<S> L = Matrix6<S>::Zero();  // K = L L^T
  for (int j = 0; j < 6; ++j)
    for (int i = j; i < 6; ++i) {
      S sum = K(i, j);
      for (int k = 0; k < j; ++k) sum -= L(i, k) * L(j, k);
      if (i == j) {
        if (!(S(64) * eps<S>() < sum)) throw std::domain_error("J M^-1 J^T is singular to working precision");
        L(i, i) = S(sqrt(sum));
      } else {
        L(i, j) = sum / L(j, j);
      }
    }
  Matrix6<S> Lambda;
  for (int c = 0; c < 6; ++c) {
    Vector6<S> b = Vector6<S>::Unit(c);
    for (int i = 0; i < 6; ++i) {
      for (int k = 0; k < i; ++k) b[i] -= L(i, k) * b[k];
      b[i] /= L(i, i);
    }
    for (int i = 5; i >= 0; --i) {
      for (int k = i + 1; k < 6; ++k) b[i] -= L(k, i) * b[k];
      b[i] /= L(i, i);
    }
    for (int i = 0; i < 6; ++i) Lambda(i, c) = b[i] * scale[i] * scale[c];
  }
  return Lambda;
}

}  // namespace liecheck
