#pragma once
// Eigen's exponential and logarithm of a 4 x 4 matrix. They need much time and memory, so that eigen_functions_float.cpp
// and eigen_functions_double.cpp compile nothing else.

#include <unsupported/Eigen/MatrixFunctions>

/// Eigen's steps for a complex 4 x 4 matrix, with the loop over columns that Eigen runs below 48 rows.
/// Eigen's own function also has a loop over blocks, which would take a third of this file's compile time.
template <class S>
struct Eigen::internal::complex_schur_reduce_to_hessenberg<Eigen::Matrix<std::complex<S>, 4, 4>, true> {
  using M = Eigen::Matrix<std::complex<S>, 4, 4>;
  static void run(ComplexSchur<M>& schur, const M& A, bool with_U) {
    schur.m_hess.compute(A);
    schur.m_matT = schur.m_hess.matrixH();
    if (!with_U) return;
    const auto Q = schur.m_hess.matrixQ();
    const auto h = schur.m_hess.householderCoefficients();
    std::complex<S> workspace[4];
    schur.m_matU.setIdentity();
    for (Index k = 2; k >= 0; --k)
      schur.m_matU.bottomRightCorner(3 - k, 3 - k)
          .applyHouseholderOnTheLeft(Q.essentialVector(k), std::conj(h[k]), workspace);
  }
};

namespace liecheck::properties {

template <class S>
Eigen::Matrix<S, 4, 4> matrix_exp(const Eigen::Matrix<S, 4, 4>& m) {
  return m.exp();
}
template <class S>
Eigen::Matrix<S, 4, 4> matrix_log(const Eigen::Matrix<S, 4, 4>& m) {
  return m.log();
}

}  // namespace liecheck::properties
