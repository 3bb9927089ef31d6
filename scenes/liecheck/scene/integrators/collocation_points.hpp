#pragma once
// Coefficients of implicit Runge-Kutta methods by collocation, from their nodes (Hairer & Wanner 1996, IV.5).

#include <liecheck/scalar/double_word.hpp>
#include <vector>

namespace liecheck::scene {

/// c_i, b_i, a_ij of s nodes on [0, 1]. e_ij extrapolates a polynomial through the points of one step to the points
/// of the next step. All are computed in double words and accurate to half an ulp.
template <Scalar S>
struct CollocationPoints {
  std::vector<S> c, b;
  std::vector<std::vector<S>> a, e;
  /// The Gauss points: the roots of the Legendre polynomial. Order 2 s.
  static CollocationPoints gauss(int s);
  /// The three Radau points, of which the last is 1. Order 5.
  static CollocationPoints radau();

 private:
  using T = DoubleWord<S>;
  /// From nodes x and weights w.
  CollocationPoints(const std::vector<T>& x, const std::vector<T>& w);
};
template <Scalar S>
CollocationPoints<S> CollocationPoints<S>::gauss(int s) {
  std::vector<T> x(static_cast<std::size_t>(s)), w(x);
  for (int i = 0; i < s; ++i) {
    using std::cos;
    T z(S(cos(pi<S>() * (S(i) + S(3) / S(4)) / (S(s) + S(1) / S(2)))));
    T slope(1);
    for (int newton = 0; newton < 8; ++newton) {  // root of the Legendre polynomial; 6 iterations suffice
      T p0(1), p1 = z;
      for (int n = 2; n <= s; ++n) {
        const T p2 = (T(2 * n - 1) * z * p1 - T(n - 1) * p0) / T(n);
        p0 = p1, p1 = p2;
      }
      slope = T(s) * (z * p1 - p0) / (z * z - T(1));
      z -= p1 / slope;
    }
    if (s == 1) z = T(0), slope = T(1);
    x[std::size_t(s - 1 - i)] = (T(1) + z) / T(2);
    w[std::size_t(s - 1 - i)] = T(1) / ((T(1) - z * z) * slope * slope);
  }
  return {x, w};
}
template <Scalar S>
CollocationPoints<S> CollocationPoints<S>::radau() {
  using std::sqrt;
  T root(S(sqrt(S(6))));
  root = (root + T(6) / root) / T(2);
  return {{(T(4) - root) / T(10), (T(4) + root) / T(10), T(1)},
          {(T(16) - root) / T(36), (T(16) + root) / T(36), T(1) / T(9)}};
}
template <Scalar S>
CollocationPoints<S>::CollocationPoints(const std::vector<T>& x, const std::vector<T>& w)
    : c(x.size()), b(c), a(c.size(), c), e(a) {
  const auto lagrange = [&](std::size_t j, const T& at) {
    T product(1);
    for (std::size_t m = 0; m < x.size(); ++m)
      if (m != j) product *= (at - x[m]) / (x[j] - x[m]);
    return product;
  };
  for (std::size_t i = 0; i < x.size(); ++i) {
    c[i] = S(x[i]), b[i] = S(w[i]);
    for (std::size_t j = 0; j < x.size(); ++j) {
      T sum(0);  // mean of Lagrange polynomial j over [0, c_i], for which the quadrature is exact
      for (std::size_t k = 0; k < x.size(); ++k) sum += w[k] * lagrange(j, x[i] * x[k]);
      a[i][j] = S(x[i] * sum);
      e[i][j] = S(lagrange(j, T(1) + x[i]));
    }
  }
}

}  // namespace liecheck::scene
