#pragma once
// Fixed-size vectors and matrices of the oracles' numbers. They avoid heap allocation and temporaries, which
// at 50 digits cost as much as the arithmetic.

#include <array>
#include <oracles/number.hpp>

namespace liecheck::oracles {

/// A matrix, stored row by row. m[i] is element i in this order.
template <int R, int C, class T = Real>
struct Mat {
  std::array<T, R * C> x;

  T& operator[](int i) { return x[static_cast<std::size_t>(i)]; }
  const T& operator[](int i) const { return x[static_cast<std::size_t>(i)]; }
  T& operator()(int i, int j) { return (*this)[i * C + j]; }
  const T& operator()(int i, int j) const { return (*this)[i * C + j]; }
};
template <int N, class T = Real>
using Vec = Mat<N, 1, T>;

template <class T = Real>
using Vec3 = Vec<3, T>;
template <class T = Real>
using Vec6 = Vec<6, T>;
template <class T = Real>
using Vec7 = Vec<7, T>;
template <class T = Real>
using Mat3 = Mat<3, 3, T>;
template <class T = Real>
using Mat6 = Mat<6, 6, T>;

/// The elements of anything with operator[] (an Eigen vector, an array), converted exactly.
template <int N, class T = Real, class V>
Vec<N, T> exact_vector(const V& v) {
  Vec<N, T> r;
  for (int i = 0; i < N; ++i) r[i] = exact<T>(v[i]);
  return r;
}

/// The elements of anything with operator()(i, j) (an Eigen matrix), converted exactly.
template <int R, int C, class T = Real, class M>
Mat<R, C, T> exact_matrix(const M& m) {
  Mat<R, C, T> r;
  for (int i = 0; i < R; ++i)
    for (int j = 0; j < C; ++j) r(i, j) = exact<T>(m(i, j));
  return r;
}

template <class T, int R, int C, class S>
Mat<R, C, T> cast(const Mat<R, C, S>& m) {
  return exact_matrix<R, C, T>(m);
}

template <class T>
T dot(const Vec3<T>& a, const Vec3<T>& b) {
  T sum, t;
  set_product(sum, a[0], b[0]);
  set_product(t, a[1], b[1]);
  sum += t;
  set_product(t, a[2], b[2]);
  sum += t;
  return sum;
}

/// The sum of the squares of all elements, in their order, and its square root.
template <int R, int C, class T>
T squared_norm(const Mat<R, C, T>& m) {
  T sum(0), t;
  for (const T& x : m.x) {
    set_product(t, x, x);
    sum += t;
  }
  return sum;
}
template <int R, int C, class T>
T norm(const Mat<R, C, T>& v) {
  if constexpr (BallNumber<T>) {  // scaled, because balls have the exponent range of double
    const T* only = nullptr;      // the norm of a vector along an axis is exact
    int others = -1;
    for (const T& x : v.x)
      if (!x.exactly_zero()) only = &x, ++others;
    if (others <= 0) return only ? abs(*only) : T(0);
    double largest = 0;
    for (const T& x : v.x)
      if (x.size() > largest) largest = x.size();
    if ((largest < 0x1p-400 && largest > 0) || largest > 0x1p400) {
      const int e = std::ilogb(largest);
      Mat<R, C, T> scaled = v;
      for (T& x : scaled.x) x = power_scaled(x, -e);
      return power_scaled(sqrt(squared_norm(scaled)), e);
    }
  }
  return sqrt(squared_norm(v));
}

template <class T>
Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  Vec3<T> r;
  T t;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    set_product(r[i], a[j], b[k]);
    set_product(t, a[k], b[j]);
    r[i] -= t;
  }
  return r;
}

template <int R, int C, class T>
Mat<R, C, T> operator+(Mat<R, C, T> a, const Mat<R, C, T>& b) {
  for (std::size_t i = 0; i < a.x.size(); ++i) a.x[i] += b.x[i];
  return a;
}
template <int R, int C, class T>
Mat<R, C, T> operator-(Mat<R, C, T> a, const Mat<R, C, T>& b) {
  for (std::size_t i = 0; i < a.x.size(); ++i) a.x[i] -= b.x[i];
  return a;
}
template <int R, int C, class T>
Mat<R, C, T> operator-(Mat<R, C, T> a) {
  for (T& x : a.x) x = -x;
  return a;
}
template <int R, int C, class T>
Mat<R, C, T> operator*(const T& s, Mat<R, C, T> a) {
  for (T& x : a.x) x *= s;
  return a;
}

template <int R, int K, int C, class T>
Mat<R, C, T> operator*(const Mat<R, K, T>& a, const Mat<K, C, T>& b) {
  Mat<R, C, T> r;
  T t;
  for (int i = 0; i < R; ++i)
    for (int j = 0; j < C; ++j) {
      set_product(r(i, j), a(i, 0), b(0, j));
      for (int k = 1; k < K; ++k) {
        set_product(t, a(i, k), b(k, j));
        r(i, j) += t;
      }
    }
  return r;
}

template <int R, int C, class T>
Mat<C, R, T> transpose(const Mat<R, C, T>& a) {
  Mat<C, R, T> r;
  for (int i = 0; i < R; ++i)
    for (int j = 0; j < C; ++j) r(j, i) = a(i, j);
  return r;
}

template <int R, int C, class T>
Mat<R, C, T> zeros() {
  Mat<R, C, T> r;
  for (T& x : r.x) x = 0;
  return r;
}
template <int N, class T>
Vec<N, T> zero_vector() {
  return zeros<N, 1, T>();
}
template <int N, class T>
Mat<N, N, T> identity() {
  Mat<N, N, T> r = zeros<N, N, T>();
  for (int i = 0; i < N; ++i) r(i, i) = 1;
  return r;
}

/// [v]x, the matrix of w -> v x w.
template <class T>
Mat3<T> hat(const Vec3<T>& v) {
  Mat3<T> m;
  m(0, 0) = m(1, 1) = m(2, 2) = 0;
  m(0, 1) = -v[2];
  m(0, 2) = v[1];
  m(1, 0) = v[2];
  m(1, 2) = -v[0];
  m(2, 0) = -v[1];
  m(2, 1) = v[0];
  return m;
}
/// The vector of the antisymmetric part (m - m^T) / 2.
template <class T>
Vec3<T> vee(const Mat3<T>& m) {
  Vec3<T> v;
  for (int i = 0; i < 3; ++i) v[i] = (m((i + 2) % 3, (i + 1) % 3) - m((i + 1) % 3, (i + 2) % 3)) / 2;
  return v;
}

/// The cofactors: m^-1 = cofactors(m)^T / det m.
template <class T>
Mat3<T> cofactors(const Mat3<T>& m) {
  Mat3<T> c;
  T t;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      set_product(c(i, j), m(i1, j1), m(i2, j2));
      set_product(t, m(i1, j2), m(i2, j1));
      c(i, j) -= t;
    }
  return c;
}
template <class T>
T determinant(const Mat3<T>& m, const Mat3<T>& cofactors_of_m) {
  return m(0, 0) * cofactors_of_m(0, 0) + m(0, 1) * cofactors_of_m(0, 1) + m(0, 2) * cofactors_of_m(0, 2);
}
template <class T>
Mat3<T> inverse(const Mat3<T>& m) {
  const Mat3<T> c = cofactors(m);
  return T(1 / determinant(m, c)) * transpose(c);
}

template <int N, class T>
Vec3<T> head3(const Vec<N, T>& v) {
  return {{v[0], v[1], v[2]}};
}
template <class T>
Vec3<T> tail3(const Vec6<T>& v) {
  return {{v[3], v[4], v[5]}};
}
template <class T>
Vec6<T> stack(const Vec3<T>& a, const Vec3<T>& b) {
  return {{a[0], a[1], a[2], b[0], b[1], b[2]}};
}
/// The 3x3 block (i, j) of a 6x6.
template <class T>
Mat3<T> block(const Mat6<T>& m, int i, int j) {
  Mat3<T> b;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) b(r, c) = m(3 * i + r, 3 * j + c);
  return b;
}
/// [[a, b], [c, d]]
template <class T>
Mat6<T> assemble(const Mat3<T>& a, const Mat3<T>& b, const Mat3<T>& c, const Mat3<T>& d) {
  Mat6<T> m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      m(i, j) = a(i, j), m(i, 3 + j) = b(i, j);
      m(3 + i, j) = c(i, j), m(3 + i, 3 + j) = d(i, j);
    }
  return m;
}

/// A [p]: each row is the cross product of the row of A with p.
template <class T>
Mat3<T> times_hat(const Mat3<T>& A, const Vec3<T>& p) {
  Mat3<T> r;
  for (int i = 0; i < 3; ++i) {
    const Vec3<T> row = cross(Vec3<T>{{A(i, 0), A(i, 1), A(i, 2)}}, p);
    for (int j = 0; j < 3; ++j) r(i, j) = row[j];
  }
  return r;
}

/// 2 x, without rounding.
template <class T>
T twice(const T& x) {
  if constexpr (BallNumber<T>) {
    return doubled(x);
  } else {
    return 2 * x;
  }
}

}  // namespace liecheck::oracles
