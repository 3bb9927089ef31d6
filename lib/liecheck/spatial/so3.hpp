#pragma once
// SO(3): a rotation R_AB as a unit quaternion Q = (v, w), stored x y z w.
//
//   x_A = R_AB x_B,   R(Q) = I + 2 (w [v] + [v]^2) / |Q|^2
//
// Q represents the rotation of Q/|Q|; Q and -Q are the same rotation. act, actInv, matrix, normalized and the
// logarithms take every finite Q != 0 and throw std::invalid_argument for Q = 0. In float and double one error
// bound holds for all norms; in other scalars, errors are up to 3 eps larger if ||Q|^2 - 1| > sqrt(eps)/2.
// Products are those of the stored numbers and do not normalise. firstOrderNormalized takes a quaternion whose
// norm is near 1. checkedQuaternion (checked_rotation.hpp) refuses one that is off unit by more than 8 eps.

#include <liecheck/scalar/compensated.hpp>
#include <liecheck/scalar/stumpff.hpp>
#include <liecheck/spatial/quaternion_product.hpp>
#include <liecheck/spatial/types.hpp>
#include <liecheck/spatial/unit_scale.hpp>

namespace liecheck {

/// u (3 - |u|^2) / 2: one Newton step of 1/|u| at 1, for a vector that has left the unit sphere by rounding errors
/// only, as after a product. Its norm is 1 up to 3/8 (|u|^2 - 1)^2. u is (cos, sin) [2] or a quaternion [4].
template <Scalar S, int N>
Eigen::Matrix<S, N, 1> firstOrderNormalized(const Eigen::Matrix<S, N, 1>& u) {
  return u * ((S(3) - u.squaredNorm()) / S(2));
}

template <Scalar S>
class SO3 {
 public:
  /// Uninitialised: NaN in debug.
  SO3() { mark_uninitialised(q_); }
  /// Stores x y z w without normalising it. Precondition: not zero.
  explicit SO3(const Vector4<S>& xyzw) : q_(xyzw) {}
  SO3(const Vector3<S>& v, const S& w) : q_(v[0], v[1], v[2], w) {}

  static SO3 Identity() { return SO3(Vector4<S>(S(0), S(0), S(0), S(1))); }

  /// x y z w.
  const Vector4<S>& to_vector() const { return q_; }
  Vector3<S> vec() const { return q_.template head<3>(); }
  const S& w() const { return q_[3]; }
  S squaredNorm() const { return q_.squaredNorm(); }
  /// |Q|^2 - 1. Error eps/16 of |Q|^2 for |Q|^2 < 2.
  template <Precision P = Precision::standard>
  [[gnu::always_inline]] S normExcess() const {
    const auto excess = normExcessDoubleWord<P>();
    return excess.high + excess.low;
  }
  /// |Q|^2 - 1 as a double word. Error eps/16 of |Q|^2 for |Q|^2 < 2.
  template <Precision P = Precision::standard>
  [[gnu::always_inline]] DoubleWord<S> normExcessDoubleWord() const {
    return norm_excess(SplitFactor<Quad<S>, 1, P>(numbers()));
  }

  SO3 inverse() const { return SO3(Vector4<S>(-q_[0], -q_[1], -q_[2], q_[3])); }
  SO3 operator-() const { return SO3(Vector4<S>(-q_)); }

  /// Quaternion product, R_AC = R_AB R_BC. Error 1.5 eps |Q_AB||Q_BC| in each component.
  [[gnu::always_inline]] SO3 operator*(const SO3& o) const {
    if constexpr (Quad<S>::in_halves) {
      using V = Simd<S, 2>;
      const V xy = V::load(o.q_.data()), zw = V::load(o.q_.data() + 2), x(q_[0]), y(q_[1]), z(q_[2]),
              w(q_[3]);
      const V sign(S(-1), S(1)), a = z * xy - x * zw, b = x * xy + z * zw;
      const V first = (w * xy + y * zw) + sign * V(__builtin_shufflevector(a.v, a.v, 1, 0)),
              last = (w * zw - y * xy) - sign * V(__builtin_shufflevector(b.v, b.v, 1, 0));
      SO3 r;
      first.store(r.q_.data()), last.store(r.q_.data() + 2);
      return r;
    }
    const S &x1 = q_[0], &y1 = q_[1], &z1 = q_[2], &w1 = q_[3];
    const S &x2 = o.q_[0], &y2 = o.q_[1], &z2 = o.q_[2], &w2 = o.q_[3];
    return SO3(
        Vector4<S>((w1 * x2 + y1 * z2) + (x1 * w2 - z1 * y2), (w1 * y2 + y1 * w2) + (z1 * x2 - x1 * z2),
                   (w1 * z2 - y1 * x2) + (x1 * y2 + z1 * w2), (w1 * w2 - y1 * y2) - (x1 * x2 + z1 * z2)));
  }

  /// R p [3, unit of p], p + 2 (w t + v x t) / |Q|^2 with t = v x p. Error 1 eps |p|.
  template <Precision P = Precision::standard>
  [[gnu::always_inline]] Vector3<S> act(const Vector3<S>& p) const {
    return rotate<P, 1>(p);
  }
  /// R^T p.
  template <Precision P = Precision::standard>
  [[gnu::always_inline]] Vector3<S> actInv(const Vector3<S>& p) const {
    return rotate<P, -1>(p);
  }

  /// True if numbers up to `bound` can be split without overflow. If not, scale them by scale_down() first.
  [[gnu::always_inline]] static bool splittable(const S& bound) {
    return finite<S>(S(bound * split_factor()));
  }
  static S scale_down() { return eps<S>(); }
  [[gnu::always_inline]] Quad<S> numbers() const { return Quad<S>(q_[0], q_[1], q_[2], q_[3]); }
  /// 2^(n + 1) for numbers whose high parts are to have all but n digits (SplitFactor).
  [[gnu::always_inline]] static S split_factor() {
    using std::ldexp;
    return S(ldexp(S(1), std::numeric_limits<S>::digits / 2 + 1));
  }

  /// R [3 x 3] of Q/|Q|. Error of each entry 2.5 eps, absolute.
  [[gnu::always_inline]] Matrix3<S> matrix() const {
    const S excess = normExcess<>();
    if constexpr (!side_by_side<S>)
      if (!unit_vector_detail::firstOrderSuffices<S>(excess)) [[unlikely]]
        return matrixFar();
    return matrixWithin(excess);
  }
  [[gnu::always_inline]] Matrix3<S> matrixWithin(const S& excess) const {
    // R = I + 2 T / |Q|^2. The division by |Q|^2 is added as a small correction, since a factor that is rounded
    // would change the length of every rotated vector.
    const S minus = mul_add(excess, excess, S(-excess)), plus = -minus;  // 1 / |Q|^2 - 1 and its opposite
    const S &x = q_[0], &y = q_[1], &z = q_[2], &w = q_[3];
    const S xx = x * x, yy = y * y, zz = z * z, xy = x * y, yz = y * z, zx = z * x, wx = w * x, wy = w * y,
            wz = w * z;
    const auto twice = [&minus](const S& t) __attribute__((always_inline)) {
      return mul_add(minus, S(t + t), S(t + t));
    };
    const auto one_minus_twice = [&plus](const S& t) __attribute__((always_inline)) {
      return mul_add(plus, S(t + t), S(S(1) - (t + t)));
    };
    return rows<S>(one_minus_twice(yy + zz), twice(xy - wz), twice(zx + wy), twice(xy + wz),
                   one_minus_twice(xx + zz), twice(yz - wx), twice(zx - wy), twice(yz + wx),
                   one_minus_twice(xx + yy));
  }

  /// Q times a power of two such that |Q|^2 is in [1/2, 2), without a rounding error. Throws
  /// std::invalid_argument if Q = 0.
  [[gnu::noinline, gnu::cold]] SO3 atUnitScale() const {
    return SO3(unit_vector_detail::scaledByPowerOfTwo<S, 4>(q_));
  }
  /// Q/|Q| of any finite Q != 0, without overflow or underflow of |Q|^2. Error 2 eps. Throws std::invalid_argument
  /// if Q = 0.
  SO3 normalized() const {
    const S scale = q_.cwiseAbs().maxCoeff();
    if (scale == S(0)) throw std::invalid_argument(unit_vector_detail::zero_is_refused<4>);
    const Vector4<S> scaled = q_ / scale;
    using std::sqrt;
    return SO3(Vector4<S>(scaled / S(sqrt(scaled.squaredNorm()))));
  }

  /// The function of that name above, for a quaternion. With e = |Q|^2 - 1, the norm of the result is 1 - c e^2
  /// with 0 <= c <= 3/8 (1 + |e|), up to 3 eps; its rotation is that of Q, up to 1 eps.
  /// Domain: |e| <= 1/2. Normalise other numbers, such as input of users, by normalized() or refuse them by
  /// checkedQuaternion. The formula is that of Pinocchio's firstOrderNormalize, whose domain is
  /// |e| <= eps^(1/4).
  SO3 firstOrderNormalized() const { return SO3(liecheck::firstOrderNormalized<S, 4>(q_)); }

  /// A quaternion x y z w of double words: high + low.
  struct DoubleWords {
    SO3 high;
    Vector4<S> low;
  };

  /// The rotation nearest to R in the Frobenius norm, to first order in R^T R - I. One Newton step of the
  /// polar factor computes it with an error O(|R^T R - I|^2); for scalars wider than double, steps are repeated
  /// until that is below eps. The quaternion follows from the largest of the four pivots (Shepperd 1978). Its
  /// norm is in [1/2, 1]. Error for |R^T R - I| <= 8 eps, or <= 1/2 for wider scalars: 2 eps of the rotation, and
  /// 2 eps relative of its vector part if the angle is small. Fast precision omits the Newton steps, which adds
  /// |R^T R - I| to the error.
  template <Precision P = Precision::standard>
  static SO3 fromMatrix(const Matrix3<S>& R) {
    return doubleWordsFromMatrix<P>(R).high;
  }
  /// The result of fromMatrix before its last rounding.
  template <Precision P = Precision::standard>
  static DoubleWords doubleWordsFromMatrix(const Matrix3<S>& stored) {
    const Matrix3<S>& R = unit_vector_detail::firstOrderOrthogonal<S, P>(stored);
    if constexpr (P == Precision::fast)
      return largestPivot<P>(R, Matrix3<S>(Matrix3<S>::Zero()), Vector3<S>(Vector3<S>::Zero()));
    // The polar factor is R (I - E/2) = R + C with E = R^T R - I and C = -R E / 2. The antisymmetric part of
    // C is formed from differences R_ii - R_jj, so that it vanishes with the angle as the exact one does.
    using Factor = SplitFactor<S, 1, P>;
    const Factor column[3][3] = {
        {R(0, 0), R(1, 0), R(2, 0)}, {R(0, 1), R(1, 1), R(2, 1)}, {R(0, 2), R(1, 2), R(2, 2)}};
    const auto gram = [&column](int i, int j) __attribute__((always_inline)) {
      const Factor* const a = column[i];
      const Factor* const b = column[j];
      return SplitDot<S, 1, P>{S(i == j ? -1 : 0)}
          .add_product(a[0], b[0])
          .add_product(a[1], b[1])
          .add_product(a[2], b[2])
          .value();
    };
    const S xx = gram(0, 0), yy = gram(1, 1), zz = gram(2, 2), xy = gram(0, 1), yz = gram(1, 2),
            zx = gram(0, 2);
    const Matrix3<S> E = rows<S>(xx, xy, zx, xy, yy, yz, zx, yz, zz);
    const S half = S(1) / S(2);
    const auto antisymmetric = [&](int i, int j, int k) {  // C_kj - C_jk, i j k cyclic
      return S(-half * (R(k, i) * E(i, j) - R(j, i) * E(i, k) + E(j, k) * (R(k, k) - R(j, j)) +
                        R(k, j) * E(j, j) - R(j, k) * E(k, k)));
    };
    const Vector3<S> a(antisymmetric(0, 1, 2), antisymmetric(1, 2, 0), antisymmetric(2, 0, 1));
    return largestPivot<P>(R, Matrix3<S>(-half * (R * E)), a);
  }

 private:
  template <Scalar>
  friend class SO3;

  [[gnu::noinline, gnu::cold]] Matrix3<S> matrixFar() const {
    const auto Q = unitInDoubleWords();
    return Q.matrixWithin(Q.normExcess()).template cast<S>();
  }
  /// Q/|Q|; of float and double in double words.
  auto unitInDoubleWords() const {
    using T = std::conditional_t<std::is_floating_point_v<S>, DoubleWord<S>, S>;
    return SO3<T>(normalizedUnit<T, 4>(atUnitScale().to_vector().template cast<T>()));
  }
  /// R p for SIGN = 1, R^T p for SIGN = -1.
  template <Precision P, int SIGN>
  [[gnu::always_inline]] Vector3<S> rotate(const Vector3<S>& p) const {
    const S bound = norm1<S>(p), excess = normExcess<P>();
    if constexpr (!side_by_side<S>)
      if (!splittable(bound) || !unit_vector_detail::firstOrderSuffices<S>(excess)) [[unlikely]]
        return rotateFar<P, SIGN>(p);
    return rotateWithin<P, SIGN>(p, bound, excess);
  }
  template <Precision P, int SIGN>
  [[gnu::always_inline]] Vector3<S> rotateWithin(const Vector3<S>& p, const S& bound, const S& excess) const {
    const Quad<S> Q(q_[0], q_[1], q_[2], q_[3]), sigma(S(bound * split_factor()));
    const Quad<S> x =
        rotated<P, SIGN>(SplitFactor<Quad<S>, 1, P>(Q), excess, sigma, Quad<S>(p[0], p[1], p[2], S(0)));
    return Vector3<S>(x.v[0], x.v[1], x.v[2]);
  }
  /// For p or Q of any size.
  template <Precision P, int SIGN>
  [[gnu::noinline, gnu::cold]] Vector3<S> rotateFar(const Vector3<S>& p) const {
    const S scale = splittable(norm1<S>(p)) ? S(1) : scale_down();
    const auto Q = unitInDoubleWords();
    using T = std::remove_cvref_t<decltype(Q.w())>;
    const Vector3<T> x = Vector3<S>(scale * p).template cast<T>();
    const Vector3<T> y = Q.template rotateWithin<Precision::fast, SIGN>(
        x, norm1<T>(x), Q.template normExcess<Precision::fast>());
    return y.template cast<S>() / scale;
  }
  /// The quaternion of R + C by the largest pivot; c = (C_32 - C_23, ...) is the antisymmetric part of C.
  template <Precision P>
  [[gnu::always_inline]] static DoubleWords largestPivot(const Matrix3<S>& R, const Matrix3<S>& C,
                                                         const Vector3<S>& c) {
    if (R(0, 0) + R(1, 1) + R(2, 2) > S(0)) return scalarPivot<P>(R, C, c);
    const bool y = R(1, 1) > R(0, 0);
    if (R(2, 2) > (y ? R(1, 1) : R(0, 0))) return vectorPivot<P, 2>(R, C, c);
    return y ? vectorPivot<P, 1>(R, C, c) : vectorPivot<P, 0>(R, C, c);
  }
  /// a + b + small.
  template <Precision P>
  [[gnu::always_inline]] static DoubleWord<S> entry(const S& a, const S& b, const S& small) {
    if constexpr (P == Precision::fast) return {a + b, S(0)};
    const auto [sum, error] = two_sum<S>(a, b);
    return fast_two_sum<S>(sum, S(error + small));
  }
  /// 1 + x + y + z + small.
  template <Precision P>
  [[gnu::always_inline]] static DoubleWord<S> pivotEntry(const S& x, const S& y, const S& z, const S& small) {
    if constexpr (P == Precision::fast) return {S(1) + (x + y + z), S(0)};
    const auto a = two_sum<S>(S(1), x), b = two_sum<S>(y, z);
    return entry<P>(a.high, b.high, S(a.low + (b.low + small)));
  }
  /// Entry I of (R_32 - R_23, ...) + c.
  template <Precision P, int I>
  [[gnu::always_inline]] static DoubleWord<S> antisymmetricEntry(const Matrix3<S>& R, const Vector3<S>& c) {
    constexpr int J = (I + 1) % 3, K = (I + 2) % 3;
    return entry<P>(R(K, J), S(-R(J, K)), c[I]);
  }
  /// Uses 4 w^2 = 1 + tr R as the pivot.
  template <Precision P>
  [[gnu::always_inline]] static DoubleWords scalarPivot(const Matrix3<S>& R, const Matrix3<S>& C,
                                                        const Vector3<S>& c) {
    const auto x = antisymmetricEntry<P, 0>(R, c), y = antisymmetricEntry<P, 1>(R, c),
               z = antisymmetricEntry<P, 2>(R, c),
               w = pivotEntry<P>(R(0, 0), R(1, 1), R(2, 2), S(C(0, 0) + C(1, 1) + C(2, 2)));
    return quarter(x, y, z, w);
  }
  /// Uses 4 v_I^2 = 1 + R_II - R_JJ - R_KK as the pivot; the other entries give 4 v_I (v_J, v_K, w).
  template <Precision P, int I>
  [[gnu::always_inline]] static DoubleWords vectorPivot(const Matrix3<S>& R, const Matrix3<S>& C,
                                                        const Vector3<S>& c) {
    constexpr int J = (I + 1) % 3, K = (I + 2) % 3;
    DoubleWord<S> v[3];
    v[I] = pivotEntry<P>(R(I, I), S(-R(J, J)), S(-R(K, K)), S(C(I, I) - C(J, J) - C(K, K)));
    v[J] = entry<P>(R(I, J), R(J, I), S(C(I, J) + C(J, I)));
    v[K] = entry<P>(R(I, K), R(K, I), S(C(I, K) + C(K, I)));
    const auto w = antisymmetricEntry<P, I>(R, c);
    // If |w| < least, w may be nothing but the rounding error of C, or R's distance from a rotation.
    const S least = P == Precision::fast ? S(64) * eps<S>() : S(1024) * eps<S>() * eps<S>();
    if constexpr (!side_by_side<S>)
      if (absolute<S>(w.high) < least) [[unlikely]]
        return {nearPi(R, Vector3<S>(v[0].high, v[1].high, v[2].high)), Vector4<S>(Vector4<S>::Zero())};
    return quarter(v[0], v[1], v[2], w);
  }
  /// (x, y, z, w) / 4.
  [[gnu::always_inline]] static DoubleWords quarter(const DoubleWord<S>& x, const DoubleWord<S>& y,
                                                    const DoubleWord<S>& z, const DoubleWord<S>& w) {
    const S q = S(1) / S(4);
    return {SO3(Vector4<S>(q * x.high, q * y.high, q * z.high, q * w.high)),
            Vector4<S>(q * x.low, q * y.low, q * z.low, q * w.low)};
  }
  /// The rotation nearest to R near theta = pi, given an approximation v of its axis. The quaternion (v, w)
  /// is an eigenvector of Davenport's matrix [R + R^T - tr(R) I, a; a^T, tr R], a = (R_32 - R_23, ...), for
  /// its largest eigenvalue, which is 3 (Davenport 1968; Markley & Mortari 2000). Hence (3 - tr R) w = a . v
  /// with tr R = -1, and w has the sign of a . v, even if it is tiny. The next two eigenvalues are -1, so one
  /// step of the power method, v += (R + R^T - tr(R) I) v, reduces the error of v to eps. With v in double
  /// words, w loses its sign only if a is perpendicular to v up to eps^2.
  [[gnu::noinline, gnu::cold]] static SO3 nearPi(const Matrix3<S>& R, Vector3<S> v) {
    v /= S(2) * S(v.cwiseAbs().maxCoeff());
    Eigen::Matrix<S, 12, 1> entries, factors;  // a . v with v in double words is entries . factors
    Vector3<S> high;
    for (int i = 0; i < 3; ++i) {
      CompensatedSum<S> sum;
      sum.add(v[i]);
      for (int j = 0; j < 3; ++j) {
        sum.add_product(R(i, j), v[j]).add_product(R(j, i), v[j]).add_product(S(-R(j, j)), v[i]);
      }
      const auto [value, low] = sum.double_word();
      high[i] = value;
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      entries.template segment<4>(4 * i) << R(k, j), R(j, k), R(k, j), R(j, k);
      factors.template segment<4>(4 * i) << value, -value, low, -low;
    }
    return SO3(Vector3<S>(high / S(4)), exact_dot<S, 12>(entries, factors) / S(16));
  }

  Vector4<S> q_;
};

}  // namespace liecheck
