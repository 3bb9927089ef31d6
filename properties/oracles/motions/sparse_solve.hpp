#pragma once
// Linear equations with few entries.

#include <Eigen/Core>
#include <limits>
#include <utility>

namespace liecheck::oracles {

/// Solves A x = b by L D L^T for a positive semidefinite A, of which only the upper triangle is read. Zeros are
/// skipped. A row that depends on those before it, so that rounding errors are left of its pivot, gets x = 0.
template <class T>
Eigen::Matrix<T, Eigen::Dynamic, 1> sparse_solve(Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> A,
                                                 Eigen::Matrix<T, Eigen::Dynamic, 1> b) {
  const Eigen::Index n = b.size();
  const T rounding = T(1024) * std::numeric_limits<T>::epsilon();
  const Eigen::Matrix<T, Eigen::Dynamic, 1> least = rounding * A.diagonal();
  for (Eigen::Index k = 0; k < n; ++k) {
    if (!(A(k, k) > least[k])) {
      A.row(k).setZero(), A(k, k) = T(1), b[k] = T(0);
      continue;
    }
    for (Eigen::Index i = k + 1; i < n; ++i) {
      if (A(k, i) == 0) continue;
      const T factor = A(k, i) / A(k, k);
      for (Eigen::Index j = i; j < n; ++j)
        if (A(k, j) != 0) A(i, j) -= factor * A(k, j);
      b[i] -= factor * b[k];
    }
  }
  for (Eigen::Index k = n - 1; k >= 0; --k) {
    for (Eigen::Index j = k + 1; j < n; ++j)
      if (A(k, j) != 0) b[k] -= A(k, j) * b[j];
    b[k] /= A(k, k);
  }
  return b;
}

}  // namespace liecheck::oracles
