#pragma once
// The second formula of the oracles: the power series of the matrix with scaling and squaring. It uses no
// angles, axes, sines or quaternions.
//
//   phi1(A) = sum_j A^j / (j+1)!,   exp(A) = I + A phi1(A).
// A is scaled by 2^-k to ||A|| < 2^-6. The series is evaluated in blocks of five powers (Paterson, Stockmeyer
// 1973). Doublings undo the scaling (Higham 2008, sections 10.3 and 10.7.4):
//   E = exp(A) - I:   E(2A) = 2 E + E^2,            so that E keeps relative accuracy for tiny A;
//   phi1(2A) = phi1(A) (I + E/2).
//
// The affine 4x4 matrix [[phi], rho; 0, 0] gives E and p = phi1 rho, with p(2A) = 2 p + E p. The adjoint 6x6
// matrix [[phi], [rho]; 0, [phi]] is the 3x3 matrix [phi] + e [rho] of dual numbers, with cheaper products.
//
// Error: k + 4 bits of the working precision, relative to the largest operand, with k = log2 theta + 7.

#include <algorithm>
#include <oracles/linear_algebra.hpp>

namespace liecheck::oracles {

/// The 6x6 matrix [[a, b], [0, a]], that is a + e b with e^2 = 0.
template <class T>
struct Dual3 {
  Mat3<T> a, b;
};
template <class T>
Dual3<T> operator*(const Dual3<T>& x, const Dual3<T>& y) {
  return {x.a * y.a, x.a * y.b + x.b * y.a};
}
template <class T>
Dual3<T> operator+(const Dual3<T>& x, const Dual3<T>& y) {
  return {x.a + y.a, x.b + y.b};
}
template <class T>
Dual3<T> operator*(const T& s, const Dual3<T>& x) {
  return {s * x.a, s * x.b};
}

namespace series {

/// sum += s x
template <class T>
void accumulate(Mat3<T>& sum, const T& s, const Mat3<T>& x) {
  T t;
  for (std::size_t i = 0; i < 9; ++i) {
    set_product(t, s, x.x[i]);
    sum.x[i] += t;
  }
}
template <class T>
void accumulate(Dual3<T>& sum, const T& s, const Dual3<T>& x) {
  accumulate(sum.a, s, x.a);
  accumulate(sum.b, s, x.b);
}
template <class T>
void add_to_diagonal(Mat3<T>& m, const T& s) {
  for (int i = 0; i < 3; ++i) m(i, i) += s;
}
template <class T>
void add_to_diagonal(Dual3<T>& m, const T& s) {
  add_to_diagonal(m.a, s);
}
template <int R, int C, class T>
void scale(Mat<R, C, T>& m, int power) {
  for (T& x : m.x) x = ldexp(x, power);
}
template <class T>
void scale(Dual3<T>& m, int power) {
  scale(m.a, power);
  scale(m.b, power);
}

inline constexpr int block_size = 5;
/// The series has degree blocks * block_size - 1; its truncation error at 2^-6 is below 2^-(bits + 10).
template <class T>
inline constexpr int blocks = bits<T> > 200 ? 8 : 5;

/// 1 / (j+1)!
template <class T>
const std::array<T, 40>& coefficients() {
  static const std::array<T, 40> all = [] {
    std::array<T, 40> c;
    c[0] = 1;
    for (int j = 1; j < 40; ++j)
      c[static_cast<std::size_t>(j)] = c[static_cast<std::size_t>(j - 1)] / (j + 1);
    return c;
  }();
  return all;
}

/// phi1 of a matrix of norm below 2^-6.
template <class T, class Matrix>
Matrix phi1(const Matrix& A) {
  const auto& c = coefficients<T>();
  std::array<Matrix, block_size + 1> power;
  power[1] = A;
  for (std::size_t i = 2; i <= block_size; ++i) power[i] = power[i - 1] * A;
  Matrix sum;
  for (std::size_t b = blocks<T>; b-- > 0;) {
    const std::size_t first = b * block_size;
    if (b + 1 == blocks<T>) {
      sum = c[first + 1] * power[1];
    } else {
      sum = sum * power[block_size];
      accumulate(sum, c[first + 1], power[1]);
    }
    add_to_diagonal(sum, c[first]);
    for (std::size_t i = 2; i < block_size; ++i) accumulate(sum, c[first + i], power[i]);
  }
  return sum;
}

/// k such that || [phi] || 2^-k < 2^-6.
template <class T>
int halvings(const Vec3<T>& phi) {
  const int e = std::max({exponent_of(phi[0]), exponent_of(phi[1]), exponent_of(phi[2])});
  return std::max(0, e + 7);
}

}  // namespace series

/// exp of [[phi], rho; 0, 0] minus the identity.
template <class T>
struct AffineExponential {
  Mat3<T> E;  ///< R - I
  Vec3<T> p;
};

template <class T>
AffineExponential<T> affine_exponential(const Vec6<T>& xi) {
  Vec3<T> phi = tail3(xi);
  AffineExponential<T> r{{}, head3(xi)};
  const int k = series::halvings(phi);
  series::scale(phi, -k);
  series::scale(r.p, -k);
  const Mat3<T> A = hat(phi), V = series::phi1<T>(A);
  r.E = A * V;
  r.p = V * r.p;
  for (int i = 0; i < k; ++i) {
    r.p = r.p + (r.p + r.E * r.p);
    r.E = r.E + (r.E + r.E * r.E);
  }
  return r;
}

/// phi1 of a matrix, 3x3 or dual, whose norm is below 2^-6 after k halvings.
template <class T, class Matrix>
Matrix phi1_by_doublings(Matrix A, int k) {
  series::scale(A, -k);
  Matrix V = series::phi1<T>(A);
  if (k == 0) return V;
  Matrix E = A * V;
  const T half = T(1) / 2;
  for (int i = 0; i < k; ++i) {
    V = V + half * (V * E);
    if (i + 1 < k) E = E + (E + E * E);
  }
  return V;
}
/// phi1 of ad(xi) = [[phi], [rho]; 0, [phi]]: the left Jacobian of SE(3).
template <class T>
Dual3<T> phi1_adjoint(const Vec6<T>& xi) {
  const Vec3<T> phi = tail3(xi);
  return phi1_by_doublings<T>(Dual3<T>{hat(phi), hat(head3(xi))}, series::halvings(phi));
}
/// phi1 of [phi]: the left Jacobian of SO(3).
template <class T>
Mat3<T> phi1_so3(const Vec3<T>& phi) {
  return phi1_by_doublings<T>(hat(phi), series::halvings(phi));
}

}  // namespace liecheck::oracles
