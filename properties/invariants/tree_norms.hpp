#pragma once
// Norms of vectors that mix units.
//
// M_kk is the inertia of coordinate k. So all sqrt(M_kk) v_k have the same unit, and so have all
// tau_k / sqrt(M_kk). Norms of vectors use these weighted entries. The norm of M uses M_kl / sqrt(M_kk M_ll),
// because the error of a Cholesky factor is a few eps times this norm (Demmel 1989). The weights come from
// the oracle. kappa also uses norms (oracles/tree_sizes.hpp), because a rotation rounds each entry of a
// vector relative to the norm of the vector, even an entry that is zero.

#include <invariants/common.hpp>
#include <oracles/tree_sizes.hpp>

namespace liecheck::properties {

template <class T>
double approximate(const T& x) {
  if constexpr (oracles::BallNumber<T>)
    return x.head();
  else
    return static_cast<double>(x);
}
/// The square roots of the diagonal of M [nv x nv]; 0 for an entry that is not positive.
template <class T>
std::vector<double> mass_roots(const std::vector<T>& M, std::size_t nv) {
  std::vector<double> roots(nv);
  for (std::size_t k = 0; k < nv; ++k) {
    const double value = approximate(M[k * nv + k]);
    roots[k] = value > 0 ? std::sqrt(value) : 0;
  }
  return roots;
}
/// 1 / root, the weights of forces: those of the coordinates that have an inertia, and 0 for the others.
inline std::vector<double> moving_inverses(std::vector<double> roots) {
  for (double& x : roots) x = x > 0 ? 1 / x : 0;
  return roots;
}
/// The same, but a coordinate without an inertia has the largest weight of the others (1 if none has any), so
/// that the force on it is judged too.
inline std::vector<double> inverses(const std::vector<double>& roots) {
  std::vector<double> w = moving_inverses(roots);
  double largest = 0;
  for (double x : w) largest = std::max(largest, x);
  for (double& x : w)
    if (x == 0) x = largest > 0 ? largest : 1;
  return w;
}

/// The norm of the vector with entries w_k x_k.
template <class T>
T weighted_norm(const std::vector<T>& x, const std::vector<double>& w) {
  T sum(0);
  for (std::size_t k = 0; k < x.size(); ++k) {
    const T y = T(w[k]) * x[k];
    sum += y * y;
  }
  return sqrt(sum);
}
/// The same norm in double. For Tangents, it is the norm of their derivatives.
inline double weighted_size(const std::vector<double>& x, const std::vector<double>& w) {
  return weighted_norm(x, w);
}
inline double weighted_size(const std::vector<oracles::Tangent>& x, const std::vector<double>& w) {
  double sum = 0;
  for (std::size_t k = 0; k < x.size(); ++k) sum += w[k] * x[k].d * (w[k] * x[k].d);
  return std::sqrt(sum);
}
/// The products w_k w_l of all pairs of entries, row by row.
inline std::vector<double> products(const std::vector<double>& w) {
  std::vector<double> all;
  all.reserve(w.size() * w.size());
  for (double a : w)
    for (double b : w) all.push_back(a * b);
  return all;
}

/// ||w (computed - exact)|| / max(scale, min_normal / eps), in eps of the scalar.
template <class T>
double weighted_error(const oracles::Scalar& scalar, const std::vector<T>& computed,
                      const std::vector<T>& exact, const std::vector<double>& w, const T& scale) {
  std::vector<T> difference;
  difference.reserve(exact.size());
  for (std::size_t k = 0; k < exact.size(); ++k) difference.push_back(computed[k] - exact[k]);
  const T size = oracles::larger(scale, T(scalar.least_denominator()));
  return oracles::in_eps(scalar, T(weighted_norm(difference, w) / size));
}

}  // namespace liecheck::properties
