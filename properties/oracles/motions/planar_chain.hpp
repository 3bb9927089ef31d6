#pragma once
// A planar chain of links that starts at a fixed point, with absolute angles theta_i. It has no closed form.
// `reference` solves
//   sum_j K_ij (cos(theta_i - theta_j) theta_j'' + sin(theta_i - theta_j) theta_j'^2) = -g k_i cos theta_i
//   K_ii = I_i + m_i c_i^2 + l_i^2 M_i,  K_ij = l_i k_j for i < j,  k_i = m_i c_i + l_i M_i
// M_i is the mass beyond link i. The angles of a tree of revolute joints are differences of the theta_i.

#include <oracles/motions/extrapolation.hpp>

namespace liecheck::oracles {

/// Mass [kg], centre of mass and length along the link [m], inertia about the centre of mass [kg m^2].
template <class T = Real>
struct Link {
  T mass, centre, length, inertia;
};

template <int N, class T = Real>
struct PlanarChain {
  std::array<Link<T>, N> links;
  T gravity = T(0);  ///< along -y [m/s^2]; angles are measured from x

  Mat<N, N, T> couplings() const {
    Mat<N, N, T> K = zeros<N, N, T>();
    T beyond(0);
    for (int j = N - 1; j >= 0; --j) {
      const Link<T>& link = links[static_cast<std::size_t>(j)];
      const T first = link.mass * link.centre + link.length * beyond;
      K(j, j) = link.inertia + link.mass * link.centre * link.centre + link.length * link.length * beyond;
      for (int i = 0; i < j; ++i) K(i, j) = K(j, i) = links[static_cast<std::size_t>(i)].length * first;
      beyond += link.mass;
    }
    return K;
  }

  /// The time derivative of y = (theta, theta').
  Vec<2 * N, T> operator()(const Vec<2 * N, T>& y) const {
    const Mat<N, N, T> K = couplings();
    Mat<N, N + 1, T> A;
    for (int i = 0; i < N; ++i) A(i, N) = 0;
    T beyond(0);
    for (int i = N - 1; i >= 0; --i) {
      const Link<T>& link = links[static_cast<std::size_t>(i)];
      if (gravity != 0) A(i, N) = -gravity * (link.mass * link.centre + link.length * beyond) * cos(y[i]);
      beyond += link.mass;
      for (int j = 0; j < N; ++j) {
        T s, c;
        sin_cos(T(y[i] - y[j]), s, c);
        A(i, j) = K(i, j) * c;
        A(i, N) -= K(i, j) * s * y[N + j] * y[N + j];
      }
    }
    for (int p = 0; p < N; ++p)  // positive definite: no pivoting
      for (int i = 0; i < N; ++i) {
        if (i == p) continue;
        const T factor = A(i, p) / A(p, p);
        for (int j = p; j <= N; ++j) A(i, j) -= factor * A(p, j);
      }
    Vec<2 * N, T> rate;
    for (int i = 0; i < N; ++i) rate[i] = y[N + i], rate[N + i] = A(i, N) / A(i, i);
    return rate;
  }
};

}  // namespace liecheck::oracles
