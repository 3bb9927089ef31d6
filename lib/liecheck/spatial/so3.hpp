#pragma once
// SO(3): a rotation R_AB as a unit quaternion Q = (v, w), stored x y z w.
//
//   x_A = R_AB x_B,   R(Q) = I + 2 (w [v] + [v]^2) / |Q|^2
//
// Every function below is exact in intent for the stored quaternion: the rotation meant is that of Q/|Q|, so a
// quaternion that is off unit by rounding costs no accuracy. Q and -Q are one rotation.

#include <liecheck/scalar/compensated.hpp>
#include <liecheck/scalar/stumpff.hpp>
#include <liecheck/spatial/types.hpp>

namespace liecheck {

template <Scalar S>
class SO3 {
 public:
  /// Uninitialised: NaN in debug.
  SO3() { mark_uninitialised(q_); }
  /// From x y z w; not normalised. Precondition: norm not zero.
  explicit SO3(const Vector4<S>& xyzw) : q_(xyzw) {}
  SO3(const Vector3<S>& v, const S& w) : q_(v[0], v[1], v[2], w) {}

  static SO3 Identity() { return SO3(Vector4<S>(S(0), S(0), S(0), S(1))); }

  /// x y z w.
  const Vector4<S>& to_vector() const { return q_; }
  Vector3<S> vec() const { return q_.template head<3>(); }
  const S& w() const { return q_[3]; }
  S squaredNorm() const { return q_.squaredNorm(); }
  /// |Q|^2 - 1, to eps/16 while |Q| is near 1.
  template <Precision P = Precision::standard>
  [[gnu::always_inline]] S normExcess() const {
    return CutSum<S, 1, P>{S(-1)}
        .add_square(q_[0])
        .add_square(q_[1])
        .add_square(q_[2])
        .add_square(q_[3])
        .value();
  }

  SO3 inverse() const { return SO3(Vector4<S>(-q_[0], -q_[1], -q_[2], q_[3])); }
  SO3 operator-() const { return SO3(Vector4<S>(-q_)); }

  /// Quaternion product, R_AC = R_AB R_BC. Error 1.5 eps in each component, times |Q_AB||Q_BC|.
  SO3 operator*(const SO3& o) const {
    const S &x1 = q_[0], &y1 = q_[1], &z1 = q_[2], &w1 = q_[3];
    const S &x2 = o.q_[0], &y2 = o.q_[1], &z2 = o.q_[2], &w2 = o.q_[3];
    return SO3(
        Vector4<S>((w1 * x2 + x1 * w2) + (y1 * z2 - z1 * y2), (w1 * y2 + y1 * w2) + (z1 * x2 - x1 * z2),
                   (w1 * z2 + z1 * w2) + (x1 * y2 - y1 * x2), (w1 * w2 - x1 * x2) - (y1 * y2 + z1 * z2)));
  }

  /// R p, the vector part of (Q p) Q* / |Q|^2: neither product is longer than p. Shape 3, unit of p. Error 1 eps |p|.
  template <Precision P = Precision::standard>
  [[gnu::always_inline]] Vector3<S> act(const Vector3<S>& p) const {
    using C = Cut<S, 1, P>;
    using std::ldexp;
    const S &x = q_[0], &y = q_[1], &z = q_[2], &w = q_[3];
    const C cx(x), cy(y), cz(z), cw(w);
    const S place = (absolute<S>(p[0]) + absolute<S>(p[1]) + absolute<S>(p[2])) *
                    S(ldexp(S(1), std::numeric_limits<S>::digits / 2 + 1));
    if constexpr (P != Precision::fast && !side_by_side<S>)
      if (!finite<S>(place)) return act<Precision::fast>(p);  // a few binades before the result overflows
    const C px(p[0], place), py(p[1], place), pz(p[2], place);
    const auto sum = [&place](const C& a, const C& b, const C& c, const C& d, const C& e, const C& f)
        __attribute__((always_inline)) {
      const auto s = CutSum<S, 1, P>().add_product(a, b).add_product(c, d).add_product(e, f);
      const S rounded = s.value();
      return C(rounded, place).with(s.rest(rounded));
    };
    const C ca = sum(cx, px, cy, py, cz, pz);
    const C cgx = sum(cw, px, cy, pz, -cz, py), cgy = sum(cw, py, cz, px, -cx, pz),
            cgz = sum(cw, pz, cx, py, -cy, px);
    const S excess = normExcess<P>(), correction = -excess / (S(1) + excess);
    const auto entry = [&](const C& w_g, const C& v, const C& b, const C& c, const C& d, const C& e)
        __attribute__((always_inline)) {
      const auto r =
          CutSum<S, 1, P>().add_product(cw, w_g).add_product(v, ca).add_product(b, c).add_product(d, e);
      return r.high + mul_add(correction, r.high, r.low);
    };
    return Vector3<S>(entry(cgx, cx, cy, cgz, -cz, cgy), entry(cgy, cy, cz, cgx, -cx, cgz),
                      entry(cgz, cz, cx, cgy, -cy, cgx));
  }
  /// R^T p.
  template <Precision P = Precision::standard>
  [[gnu::always_inline]] Vector3<S> actInv(const Vector3<S>& p) const {
    return inverse().template act<P>(p);
  }

  /// R, 3 x 3. Error 2 eps in each entry; exact function of Q/|Q|.
  Matrix3<S> matrix() const {
    const S s = scale();
    const S &x = q_[0], &y = q_[1], &z = q_[2], &w = q_[3];
    const S xs = x * s, ys = y * s, zs = z * s;
    const S xx = x * xs, yy = y * ys, zz = z * zs, xy = x * ys, yz = y * zs, zx = x * zs;
    const S wx = w * xs, wy = w * ys, wz = w * zs;
    return rows<S>(S(1) - (yy + zz), xy - wz, zx + wy, xy + wz, S(1) - (xx + zz), yz - wx, zx - wy, yz + wx,
                   S(1) - (xx + yy));
  }

  /// Q/|Q|. Precondition: Q is not zero and finite. Safe from overflow and underflow of |Q|^2.
  SO3 normalized() const {
    const S scale = q_.cwiseAbs().maxCoeff();
    const Vector4<S> scaled = q_ / scale;
    using std::sqrt;
    return SO3(Vector4<S>(scaled / S(sqrt(scaled.squaredNorm()))));
  }

  /// The rotation nearest to R in the Frobenius norm, to first order in R^T R - I (one Newton step of the polar
  /// factor, error O(|R^T R - I|^2)), by the largest of the four pivots (Shepperd 1978). The result is scaled
  /// arbitrarily (|Q| in [1/2, 1]): its rotation is what counts. For |R^T R - I| <= 8 eps the error is 2 eps,
  /// and 2 eps relative to |v| when the angle is small. Fast precision takes R as it is: another |R^T R - I|.
  template <Precision P = Precision::standard>
  static SO3 fromMatrix(const Matrix3<S>& R) {
    if constexpr (P == Precision::fast)
      return largestPivot(R, Vector3<S>(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1)));
    // Polar factor R (I - E/2), E = R^T R - I; C = -R E / 2 is the correction. Its antisymmetric part is
    // formed from differences R_ii - R_jj so that it vanishes with the angle, as the exact one does.
    using C = Cut<S, 1, P>;
    const C column[3][3] = {
        {R(0, 0), R(1, 0), R(2, 0)}, {R(0, 1), R(1, 1), R(2, 1)}, {R(0, 2), R(1, 2), R(2, 2)}};
    const auto gram = [&column](int i, int j) __attribute__((always_inline)) {
      const C* const a = column[i];
      const C* const b = column[j];
      return CutSum<S, 1, P>{S(i == j ? -1 : 0)}
          .add_product(a[0], b[0])
          .add_product(a[1], b[1])
          .add_product(a[2], b[2])
          .value();
    };
    const S xx = gram(0, 0), yy = gram(1, 1), zz = gram(2, 2), xy = gram(0, 1), yz = gram(1, 2),
            zx = gram(0, 2);
    const Matrix3<S> E = rows<S>(xx, xy, zx, xy, yy, yz, zx, yz, zz);
    const S half = S(1) / S(2);
    auto antisymmetric = [&](int i, int j, int k) {  // entry (k, j) minus entry (j, k) of R + C, i j k cyclic
      const S correction = R(k, i) * E(i, j) - R(j, i) * E(i, k) + E(j, k) * (R(k, k) - R(j, j)) +
                           R(k, j) * E(j, j) - R(j, k) * E(k, k);
      return S((R(k, j) - R(j, k)) - half * correction);
    };
    const Vector3<S> a(antisymmetric(0, 1, 2), antisymmetric(1, 2, 0), antisymmetric(2, 0, 1));
    return largestPivot(Matrix3<S>(R - half * (R * E)), a);
  }

 private:
  /// Of a rotation N with antisymmetric part a: N_32 - N_23 and so on.
  static SO3 largestPivot(const Matrix3<S>& N, const Vector3<S>& a) {
    const S trace = N.trace();
    Vector4<S> q;
    if (trace > S(0)) {
      q << a, S(1) + trace;
    } else {
      int i = 0;
      if (N(1, 1) > N(0, 0)) i = 1;
      if (N(2, 2) > N(i, i)) i = 2;
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      q[i] = S(1) + (N(i, i) - N(j, j) - N(k, k));
      q[j] = N(i, j) + N(j, i);
      q[k] = N(i, k) + N(k, i);
      q[3] = a[i];
    }
    return SO3(Vector4<S>(q / S(4)));
  }
  /// 2 / |Q|^2, rounded twice: an error here is common to all entries, so it would stretch what it rotates.
  S scale() const { return S(2) / (S(1) + normExcess<>()); }

  Vector4<S> q_;
};

}  // namespace liecheck
