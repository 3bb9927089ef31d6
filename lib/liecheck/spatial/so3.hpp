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
#include <tuple>

namespace liecheck {

template <Scalar S>
class SO3 {
 public:
  /// Uninitialised: NaN in debug.
  SO3() { mark_uninitialised(q_); }
  /// From x y z w; not normalised. Precondition: norm not zero.
  explicit SO3(const Vector4<S>& xyzw) : q_(xyzw) {}
  SO3(const Vector3<S>& v, const S& w) { q_ << v, w; }

  static SO3 Identity() { return SO3(Vector4<S>(S(0), S(0), S(0), S(1))); }

  /// x y z w.
  const Vector4<S>& to_vector() const { return q_; }
  Vector3<S> vec() const { return q_.template head<3>(); }
  const S& w() const { return q_[3]; }
  S squaredNorm() const { return q_.squaredNorm(); }

  SO3 inverse() const { return SO3(-vec(), w()); }
  SO3 operator-() const { return SO3(Vector4<S>(-q_)); }

  /// Quaternion product, R_AC = R_AB R_BC. Error 1.5 eps in each component, times |Q_AB||Q_BC|.
  SO3 operator*(const SO3& o) const {
    const S &x1 = q_[0], &y1 = q_[1], &z1 = q_[2], &w1 = q_[3];
    const S &x2 = o.q_[0], &y2 = o.q_[1], &z2 = o.q_[2], &w2 = o.q_[3];
    return SO3(
        Vector4<S>((w1 * x2 + x1 * w2) + (y1 * z2 - z1 * y2), (w1 * y2 + y1 * w2) + (z1 * x2 - x1 * z2),
                   (w1 * z2 + z1 * w2) + (x1 * y2 - y1 * x2), (w1 * w2 - x1 * x2) - (y1 * y2 + z1 * z2)));
  }

  /// R p = p + 2 u / |Q|^2, u = w (v x p) + v x (v x p). Shape 3, unit of p. At half a turn 2 u is twice as long
  /// as p, so u is summed in twice the digits and |Q|^2 enters by its distance from 1. Error 1 eps |p|.
  Vector3<S> act(const Vector3<S>& p) const {
    const Vector3<S> v = vec();
    CompensatedSum<S> defect;
    for (int i = 0; i < 4; ++i) defect.add_product(q_[i], q_[i]);
    const S excess = defect.add(S(-1)).value();
    const S correction = S(-2) * excess / (S(1) + excess);
    // c + low = v x p; p + 2 (w c + v x c), rounded once.
    Vector3<S> c, low, result;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      std::tie(c[i], low[i]) = CompensatedSum<S>().add_product(v[j], p[k]).add_product(S(-v[k]), p[j]).pair();
    }
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const auto [u, u_low] = CompensatedSum<S>()
                                  .add_product(w(), c[i])
                                  .add_product(v[j], c[k])
                                  .add_product(S(-v[k]), c[j])
                                  .pair();
      const S rest = u_low + (w() * low[i] + (v[j] * low[k] - v[k] * low[j]));
      const auto [sum, sum_low] = two_sum<S>(p[i], S(2) * u);
      result[i] = sum + (sum_low + (S(2) * rest + correction * u));
    }
    if (!result.allFinite()) {  // the splitting of products overflows a few binades before the result does
      const Vector3<S> t = cross(v, p) * scale();
      result = p + (w() * t + cross(v, t));
    }
    return result;
  }
  /// R^T p.
  Vector3<S> actInv(const Vector3<S>& p) const { return inverse().act(p); }

  /// R, 3 x 3. Error 2 eps in each entry; exact function of Q/|Q|.
  Matrix3<S> matrix() const {
    const S s = scale();
    const S &x = q_[0], &y = q_[1], &z = q_[2], &w = q_[3];
    const S xs = x * s, ys = y * s, zs = z * s;
    Matrix3<S> R;
    R << S(1) - (y * ys + z * zs), x * ys - w * zs, x * zs + w * ys,  //
        x * ys + w * zs, S(1) - (x * xs + z * zs), y * zs - w * xs,   //
        x * zs - w * ys, y * zs + w * xs, S(1) - (x * xs + y * ys);
    return R;
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
  /// and 2 eps relative to |v| when the angle is small.
  static SO3 fromMatrix(const Matrix3<S>& R) {
    // Polar factor R (I - E/2), E = R^T R - I; C = -R E / 2 is the correction. Its antisymmetric part is
    // formed from differences R_ii - R_jj so that it vanishes with the angle, as the exact one does.
    Matrix3<S> E;
    for (int i = 0; i < 3; ++i) {
      for (int j = i; j < 3; ++j) {
        CompensatedSum<S> sum;
        for (int k = 0; k < 3; ++k) sum.add_product(R(k, i), R(k, j));
        if (i == j) sum.add(S(-1));
        E(i, j) = E(j, i) = sum.value();
      }
    }
    const S half = S(1) / S(2);
    auto antisymmetric = [&](int i, int j, int k) {  // entry (k, j) minus entry (j, k) of R + C, i j k cyclic
      const S correction = R(k, i) * E(i, j) - R(j, i) * E(i, k) + E(j, k) * (R(k, k) - R(j, j)) +
                           R(k, j) * E(j, j) - R(j, k) * E(k, k);
      return S((R(k, j) - R(j, k)) - half * correction);
    };
    const Vector3<S> a(antisymmetric(0, 1, 2), antisymmetric(1, 2, 0), antisymmetric(2, 0, 1));
    const Matrix3<S> P = R - half * (R * E);
    const S trace = P.trace();
    Vector4<S> q;
    if (trace > S(0)) {
      q << a, S(1) + trace;
    } else {
      int i = 0;
      if (P(1, 1) > P(0, 0)) i = 1;
      if (P(2, 2) > P(i, i)) i = 2;
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      q[i] = S(1) + (P(i, i) - P(j, j) - P(k, k));
      q[j] = P(i, j) + P(j, i);
      q[k] = P(i, k) + P(k, i);
      q[3] = a[i];
    }
    return SO3(Vector4<S>(q / S(4)));
  }

 private:
  /// 2 / |Q|^2, rounded twice: an error here is common to all entries, so it would stretch what it rotates.
  S scale() const {
    CompensatedSum<S> n;
    for (int i = 0; i < 4; ++i) n.add_product(q_[i], q_[i]);
    return S(2) / n.value();
  }

  Vector4<S> q_;
};

}  // namespace liecheck
