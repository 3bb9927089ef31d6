#pragma once
// Compares the oracles' numbers with enclosures, and records the largest errors.

#include <gtest/gtest.h>
#include <iostream>
#include <map>
#include <oracles/linear_algebra.hpp>
#include <string>

#include "enclosure.hpp"

namespace liecheck::enclosures {

/// x without rounding; an interval with infinite ends if T has too few bits.
template <class T, unsigned Digits>
T point(const oracles::Decimal<Digits>& x) {
  T r;
  mpfi_set_fr(r.backend().data(), x.backend().data());
  return r;
}
template <class T, int N, class S>
Eigen::Matrix<T, N, 1> point(const oracles::Vec<N, S>& v) {
  Eigen::Matrix<T, N, 1> r;
  for (int i = 0; i < N; ++i) r[i] = point<T>(v[i]);
  return r;
}
template <class T, int R, int C, class S>
Eigen::Matrix<T, R, C> point(const oracles::Mat<R, C, S>& m) {
  Eigen::Matrix<T, R, C> r;
  for (int i = 0; i < R; ++i)
    for (int j = 0; j < C; ++j) r(i, j) = point<T>(m(i, j));
  return r;
}

/// Bounds of the error of one block, ||value - exact|| / max(||exact||, scale).
struct Excess {
  double least, most;
};

template <class T, int R, int C>
Excess excess(const Eigen::Matrix<T, R, C>& exact, const Eigen::Matrix<T, R, C>& value, const T& scale) {
  T distance(0), size(0);
  for (int i = 0; i < R * C; ++i) {
    T d = value(i) - exact(i), square;
    mpfi_sqr(square.backend().data(), d.backend().data());
    distance += square;
    mpfi_sqr(square.backend().data(), exact(i).backend().data());
    size += square;
  }
  if (is_zero(distance)) return {0, 0};
  size = sqrt(size);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (is_zero(size) && is_zero(scale)) return {infinity, infinity};
  if (lower(scale) > lower(size)) size = scale;
  const T ratio = sqrt(distance) / size;
  return {mpfr_get_d(lower(ratio).backend().data(), MPFR_RNDD),
          mpfr_get_d(upper(ratio).backend().data(), MPFR_RNDU)};
}

class Ledger {
 public:
  /// Fails unless the oracle's `value` is within `claim` of the enclosure, and the value plus an error of
  /// `wrong` is not.
  template <class T, int R, int C>
  void check(const std::string& what, const Eigen::Matrix<T, R, C>& exact,
             const Eigen::Matrix<T, R, C>& value, double claim, double wrong, const T& scale = T(0)) {
    Worst& w = worst_[what];
    ++w.checks;
    const Excess e = excess<T, R, C>(exact, value, scale);
    if (!(e.most <= w.most)) w.most = e.most;
    if (!(e.most <= claim) && ++w.outside <= 3)
      ADD_FAILURE() << what << ": the oracle errs by " << e.least << " to " << e.most << ", claims " << claim
                    << "\n"
                    << input;
    // The error is planted in the largest number of `value`.
    Eigen::Matrix<T, R, C> planted = value;
    int k = 0;
    for (int i = 1; i < R * C; ++i)
      if (largest(value(i)) > largest(value(k))) k = i;
    const T size = upper(scale) > largest(value(k)) ? scale : is_zero(value(k)) ? T(1) : value(k);
    planted(k) += 2 * sqrt(T(R * C)) * wrong * size;
    if (excess<T, R, C>(exact, planted, scale).least <= claim && ++w.missed <= 3)
      ADD_FAILURE() << what << ": a planted error of " << wrong << " passes\n" << input;
  }
  void unresolved(const std::string& what) {
    if (++worst_[what].unresolved <= 3) ADD_FAILURE() << what << ": the oracle has no value\n" << input;
  }
  void print() const {
    for (const auto& [what, w] : worst_)
      std::cout << what << ": " << w.checks << " values enclosed, largest error " << w.most << "\n";
  }

  std::string input;  ///< the input of the next check, for messages

 private:
  struct Worst {
    int checks = 0, outside = 0, missed = 0, unresolved = 0;
    double most = 0;
  };
  std::map<std::string, Worst> worst_;
};

}  // namespace liecheck::enclosures
