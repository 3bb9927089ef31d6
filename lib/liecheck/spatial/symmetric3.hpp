#pragma once
// Symmetric3: a symmetric 3 x 3 matrix as six numbers.

#include <liecheck/scalar/simd.hpp>
#include <liecheck/spatial/types.hpp>

namespace liecheck {

/// A symmetric 3 x 3 matrix.
template <Scalar S>
struct Symmetric3 {
  S xx = S(0), xy = S(0), xz = S(0), yy = S(0), yz = S(0), zz = S(0);

  /// R I R^T of a symmetric I [3 x 3]. Error 2.4 eps |I| if R is a rotation.
  [[gnu::always_inline]] static Symmetric3 rotated(const Matrix3<S>& R, const Matrix3<S>& I) {
    // The numbers of rows 0 and 1, of R I and of the result, are computed as pairs.
    using Pair = Simd<S, 2>;
    const auto sum = []<class T>(const T& a, const S& x, const T& b, const S& y, const T& c, const S& z)
        __attribute__((always_inline)) {
      return T(mul_add(a, T(x), mul_add(b, T(y), T(c * T(z)))));
    };
    const Pair r0(R(0, 0), R(1, 0)), r1(R(0, 1), R(1, 1)), r2(R(0, 2), R(1, 2));
    const auto upper = [&](int j) __attribute__((always_inline)) {
      return sum(r0, I(0, j), r1, I(1, j), r2, I(2, j));
    };
    const auto last = [&](int j) __attribute__((always_inline)) {
      return sum(R(2, 0), I(0, j), R(2, 1), I(1, j), R(2, 2), I(2, j));
    };
    const auto column =
        [&R, &sum ](int j, const auto& a, const auto& b, const auto& c) __attribute__((always_inline)) {
      return sum(a, R(j, 0), b, R(j, 1), c, R(j, 2));
    };
    const Pair a = upper(0), b = upper(1), c = upper(2), y = column(1, a, b, c), z = column(2, a, b, c);
    return {column(0, S(a.v[0]), S(b.v[0]), S(c.v[0])), S(y.v[0]), S(z.v[0]), S(y.v[1]), S(z.v[1]),
            column(2, last(0), last(1), last(2))};
  }
  [[gnu::always_inline]] Matrix3<S> matrix() const { return rows<S>(xx, xy, xz, xy, yy, yz, xz, yz, zz); }

  [[gnu::always_inline]] Vector3<S> operator*(const Vector3<S>& v) const {
    return {mul_add(xx, v[0], mul_add(xy, v[1], S(xz * v[2]))),
            mul_add(xy, v[0], mul_add(yy, v[1], S(yz * v[2]))),
            mul_add(xz, v[0], mul_add(yz, v[1], S(zz * v[2])))};
  }
  [[gnu::always_inline]] void operator+=(const Symmetric3& o) {
    xx += o.xx, xy += o.xy, xz += o.xz, yy += o.yy, yz += o.yz, zz += o.zz;
  }
  /// Adds factor (2 (a . b) 1 - a b^T - b a^T).
  [[gnu::always_inline]] void addPair(const Vector3<S>& a, const Vector3<S>& b, const S& factor) {
    const S x = S(2) * factor * a[0] * b[0], y = S(2) * factor * a[1] * b[1], z = S(2) * factor * a[2] * b[2];
    xx += y + z, yy += x + z, zz += x + y;
    xy -= factor * (a[0] * b[1] + a[1] * b[0]), xz -= factor * (a[0] * b[2] + a[2] * b[0]);
    yz -= factor * (a[1] * b[2] + a[2] * b[1]);
  }
  /// [w] A + ([w] A)^T: the rate of A [3 x 3] that turns with the angular velocity w.
  [[gnu::always_inline]] static Symmetric3 turning(const Symmetric3& A, const Vector3<S>& w) {
    const S &x = w[0], &y = w[1], &z = w[2];
    return {S(2) * (y * A.xz - z * A.xy),
            y * A.yz - z * A.yy + z * A.xx - x * A.xz,
            y * A.zz - z * A.yz + x * A.xy - y * A.xx,
            S(2) * (z * A.xy - x * A.yz),
            z * A.xz - x * A.zz + x * A.yy - y * A.xy,
            S(2) * (x * A.yz - y * A.xz)};
  }
};

}  // namespace liecheck
