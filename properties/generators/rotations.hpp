#pragma once
// Random angles, axes, rotation vectors, unit quaternions and rotation matrices. They are valid by
// construction and prefer values at which code breaks.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <generators/random_floats.hpp>
#include <vector>

namespace liecheck::properties {

enum class AngleRange { to_pi, unbounded };

/// Angles [rad] at which implementations are known to change their formula: powers of ten, roots of the
/// machine epsilon, and the square roots of such numbers (for cutoffs on theta^2).
template <class S>
const std::vector<S>& common_cutoffs() {
  static const std::vector<S> all = [] {
    using std::ldexp, std::sqrt;
    std::vector<S> c;
    const S eps = std::numeric_limits<S>::epsilon();
    for (S t(1); t > eps / S(100); t = t / S(10)) c.push_back(t);
    const S e2 = sqrt(eps), e4 = sqrt(e2), e8 = sqrt(e4);
    for (const S& t : {eps, e2, e4, e8, S(S(2) * e2), S(S(2) * e4)}) c.push_back(t);
    for (const S& t : {S(S(1) / S(2)), S(S(1) / S(4)), S(S(1) / S(100) / S(20)), S(sqrt(S(1) / S(10))),
                       S(sqrt(std::numeric_limits<S>::min()))})
      c.push_back(t);
    // Only AngleRange::unbounded uses the last four. The series of liecheck end at the first of these four.
    const S pi = boost::math::constants::pi<S>();
    for (const S& t : {S(pi * (S(1) + S(4) * eps)), pi, S(pi / S(2)), S(S(2) * pi)}) c.push_back(t);
    return c;
  }();
  return all;
}

/// An angle >= 0 [rad].
template <class S>
S angle(Source& source, AngleRange range) {
  using std::ldexp, std::sqrt;
  constexpr int digits = std::numeric_limits<S>::digits;
  static const S pi = boost::math::constants::pi<S>();
  // Of 100 angles up to pi, 46 are uniform: 1 % of (0, pi) then has 4 of 1000 cases.
  const int kind = source.between(0, range == AngleRange::to_pi ? 99 : 123);
  if (kind <= 2) return S(0);
  if (kind <= 5) return source.chance(1, 2) ? subnormal<S>(source) : std::numeric_limits<S>::min();
  if (kind <= 8) {
    const int lowest = std::numeric_limits<S>::min_exponent;
    return binade_uniform<S>(source, lowest, -digits - 16);
  }
  if (kind <= 26) return binade_uniform<S>(source, -digits - 16, 1);
  if (kind <= 35) {
    const auto& cutoffs = common_cutoffs<S>();
    const int steps = source.between(-3, 3);
    return step_ulps(cutoffs[source.below(cutoffs.size() - (range == AngleRange::to_pi ? 4 : 0))], steps);
  }
  if (kind <= 53) {
    S t = pi - binade_uniform<S>(source, -digits - 1, 1);
    if (source.chance(1, 4)) t = step_ulps(pi, source.between(-3, 0));
    return t > S(0) ? t : -t;
  }
  if (kind <= 99) return pi * source.unit<S>();
  if (kind <= 108) return pi + binade_uniform<S>(source, -digits + 1, 1);
  if (kind <= 115) return pi * (S(1) + source.unit<S>());
  if (kind <= 120) {
    const S t = S(2 * source.between(1, 4)) * pi;
    const S d = binade_uniform<S>(source, -digits, 0);
    return source.chance(1, 2) ? S(t + d) : S(t - d);
  }
  return binade_uniform<S>(source, 3, 27);  // up to 1e8
}

/// A unit vector up to rounding: along or near an axis, in a coordinate plane, on a cube's diagonal, or any.
template <class S>
Eigen::Matrix<S, 3, 1> direction(Source& source) {
  using V = Eigen::Matrix<S, 3, 1>;
  using std::sqrt;
  V v = V::Zero();
  const auto sign = [&] { return source.chance(1, 2) ? S(1) : S(-1); };
  const int i = static_cast<int>(source.below(3));
  switch (source.below(8)) {
    case 0:
      v[i] = sign();
      return v;
    case 1:
      v[i] = source.symmetric<S>();
      v[(i + 1) % 3] = sign();
      break;
    case 2:
      v[i] = sign();
      v[(i + 1) % 3] = sign() * binade_uniform<S>(source, -std::numeric_limits<S>::digits - 8, 0);
      v[(i + 2) % 3] = sign() * binade_uniform<S>(source, -std::numeric_limits<S>::digits - 8, 0);
      break;
    case 3:
      v << sign(), sign(), sign();
      break;
    default:
      for (int attempt = 0; attempt < 32; ++attempt) {
        v << source.symmetric<S>(), source.symmetric<S>(), source.symmetric<S>();
        const S n = v.squaredNorm();
        if (n <= S(1) && n > S(1) / S(64)) break;
      }
      if (v.squaredNorm() == S(0)) v[0] = S(1);
  }
  return v / S(sqrt(v.squaredNorm()));
}

/// A rotation vector phi [rad].
template <class S>
Eigen::Matrix<S, 3, 1> rotation_vector(Source& source, AngleRange range) {
  const S t = angle<S>(source, range);
  return t * direction<S>(source);
}

/// 2^widest is 3e150 in double. Other scalars use the same share of their exponents. Its square is finite.
template <class S>
inline constexpr int widest = std::numeric_limits<S>::max_exponent / 256 * 125;
template <>
inline constexpr int widest<float> = 62;

/// The exponent of the smallest subnormal numbers.
template <class S>
inline constexpr int least_exponent =
    std::numeric_limits<S>::min_exponent - std::numeric_limits<S>::digits + 1;
/// The exponent of large sizes, whose squares overflow. They are finite even over the square of the distance
/// between a rounded angle and a pole at 2 pi k, or times the square of 1e8 rad.
template <class S>
inline constexpr int largest_exponent =
    std::numeric_limits<S>::max_exponent - 2 * std::numeric_limits<S>::digits - 10;

/// Zero, three magnitudes, or a direction times one scale. Without a limit of the exponents, this scale is
/// sometimes subnormal, or so large that squares overflow.
template <class S>
Eigen::Matrix<S, 3, 1> vector3(Source& source, int binades = widest<S>) {
  const std::uint64_t kind = source.below(100);
  if (kind <= 2) return Eigen::Matrix<S, 3, 1>::Zero();
  if (kind <= 27) {  // one scale for all, often the smallest or the largest
    using std::ldexp;
    const int beyond = binades + binades / 8;
    int exponent = std::clamp(source.between(-beyond, beyond), -binades, binades);
    // Seldom, because processors are slow with subnormal numbers.
    if (kind <= 4 && binades == widest<S>)
      exponent = kind == 3 ? source.between(least_exponent<S>, -binades)
                           : source.between(binades, largest_exponent<S>);
    const S scale = S(ldexp(S(1) + source.unit<S>(), exponent));
    return scale * direction<S>(source);
  }
  return {magnitude<S>(source, binades), magnitude<S>(source, binades), magnitude<S>(source, binades)};
}

/// A quaternion x y z w of either sign with | |Q|^2 - 1 | <= 8 eps. Small angles have a log-uniform vector
/// part, angles near pi a log-uniform scalar part.
template <class S>
Eigen::Matrix<S, 4, 1> unit_quaternion(Source& source) {
  using std::sqrt;
  constexpr int digits = std::numeric_limits<S>::digits;
  Eigen::Matrix<S, 4, 1> q;
  const auto n = direction<S>(source);
  switch (source.below(16)) {
    case 0:
      q << S(0), S(0), S(0), S(1);
      break;
    case 1:
    case 2:
    case 3: {  // near the identity
      const S s = binade_uniform<S>(
          source, source.chance(1, 4) ? std::numeric_limits<S>::min_exponent - digits / 2 : -digits - 16, 0);
      q << s * n, S(sqrt((S(1) - s) * (S(1) + s)));
      break;
    }
    case 4:
    case 5:
    case 6: {  // near theta = pi
      const S w = source.chance(1, 6) ? S(0) : binade_uniform<S>(source, -digits - 8, 0);
      q << S(sqrt((S(1) - w) * (S(1) + w))) * n, w;
      break;
    }
    default: {
      S c = source.symmetric<S>();
      q << S(sqrt((S(1) - c) * (S(1) + c))) * n, c;
    }
  }
  q /= S(sqrt(q.squaredNorm()));
  if (source.chance(1, 4)) {  // a norm that is not 1, within the documented bound
    q *= S(1) + S(source.between(-5, 5)) * std::numeric_limits<S>::epsilon() / S(2);
  }
  if (source.chance(1, 2)) q = -q;
  return q;
}

/// A norm of 1 up to 1e-6, one near 1, moderate ones, 1e-9, 1e9, or one near underflow or overflow.
template <class S>
S quaternion_norm(Source& source) {
  using std::ldexp;
  constexpr int least = std::numeric_limits<S>::min_exponent, most = std::numeric_limits<S>::max_exponent;
  switch (source.below(8)) {
    case 0:
      return S(1) + source.symmetric<S>() / S(1000000);
    case 1:
      return S(1) + source.symmetric<S>() / S(10);
    case 2:
      return S(3) + S(27) * source.unit<S>();
    case 3:
      return source.chance(1, 2) ? S(1) / S(1000000000) : S(1000000000);
    case 4:
      return binade_uniform<S>(source, least - std::numeric_limits<S>::digits / 2, least + 4);
    case 5:
      return binade_uniform<S>(source, most - 8, most - 2);
    case 6:
      return S(ldexp(S(1), source.between(-40, 40)));
    default:
      return S(1);
  }
}

/// The rotation matrix of a unit quaternion, rounded: || R^T R - I || is a few eps.
template <class S>
Eigen::Matrix<S, 3, 3> rotation_matrix(const Eigen::Matrix<S, 4, 1>& q) {
  const S s = S(2) / q.squaredNorm();
  const S x = q[0], y = q[1], z = q[2], w = q[3];
  Eigen::Matrix<S, 3, 3> R;
  R << S(1) - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w),  //
      s * (x * y + z * w), S(1) - s * (x * x + z * z), s * (y * z - x * w),   //
      s * (x * z - y * w), s * (y * z + x * w), S(1) - s * (x * x + y * y);
  return R;
}

/// The quaternion product a b, unit to a few eps.
template <class S>
Eigen::Matrix<S, 4, 1> quaternion_product(const Eigen::Matrix<S, 4, 1>& a, const Eigen::Matrix<S, 4, 1>& b) {
  return {S(S(a[3] * b[0] + a[0] * b[3]) + S(a[1] * b[2] - a[2] * b[1])),
          S(S(a[3] * b[1] + a[1] * b[3]) + S(a[2] * b[0] - a[0] * b[2])),
          S(S(a[3] * b[2] + a[2] * b[3]) + S(a[0] * b[1] - a[1] * b[0])),
          S(S(a[3] * b[3] - a[0] * b[0]) - S(a[1] * b[1] + a[2] * b[2]))};
}

/// A quaternion equal to Q0 or -Q0, a few ulps from it, near it, at an angle near pi or any angle from it, or
/// one that does not depend on Q0.
template <class S>
Eigen::Matrix<S, 4, 1> quaternion_near(Source& source, const Eigen::Matrix<S, 4, 1>& Q0) {
  using std::sqrt;
  Eigen::Matrix<S, 4, 1> q = Q0;
  const std::uint64_t kind = source.below(32);
  if (kind <= 5) {
    if (kind > 2)
      for (int i = 0; i < 4; ++i) q[i] = step_ulps(q[i], source.between(-2, 2));
  } else if (kind <= 24) {
    // A relative angle near 0 or near pi has a log-uniform sine or cosine. Any other has a uniform cosine.
    const bool near = kind <= 15;
    const S s =
        near ? binade_uniform<S>(source, -std::numeric_limits<S>::digits - 4, 0) : source.symmetric<S>();
    const S c = S(sqrt((S(1) - s) * (S(1) + s)));
    Eigen::Matrix<S, 4, 1> d;
    if (near && source.chance(2, 3))
      d << s * direction<S>(source), c;
    else
      d << c * direction<S>(source), s;
    q = quaternion_product<S>(Q0, d);
    q /= S(sqrt(q.squaredNorm()));
  } else {
    q = unit_quaternion<S>(source);
  }
  if (source.chance(1, 4)) q = -q;
  return q;
}

/// Equal or opposite to a, a few ulps from that, near it, at a right angle to a, or any.
template <class S>
Eigen::Matrix<S, 3, 1> direction_beside(Source& source, const Eigen::Matrix<S, 3, 1>& a) {
  using std::sqrt;
  const S sign = source.chance(1, 2) ? S(1) : S(-1);
  Eigen::Matrix<S, 3, 1> b = sign * a;
  switch (source.below(8)) {
    case 0:
      return b;
    case 1:
      for (int i = 0; i < 3; ++i) b[i] = step_ulps(b[i], source.between(-2, 2));
      break;
    case 2:
    case 3: {
      const Eigen::Matrix<S, 3, 1> n = direction<S>(source);
      b += binade_uniform<S>(source, -std::numeric_limits<S>::digits - 20, -4) * n;
      break;
    }
    case 4: {
      const Eigen::Matrix<S, 3, 1> n = direction<S>(source);
      b = Eigen::Matrix<S, 3, 1>(a[1] * n[2] - a[2] * n[1], a[2] * n[0] - a[0] * n[2],
                                 a[0] * n[1] - a[1] * n[0]);
      if (!(b.squaredNorm() > S(1) / S(1000))) b = direction<S>(source);
      break;
    }
    default:
      return direction<S>(source);
  }
  return b / S(sqrt(b.squaredNorm()));
}

/// 0, 1, 1/2, near both ends, or any.
template <class S>
S fraction_up_to_1(Source& source) {
  const S small = binade_uniform<S>(source, -std::numeric_limits<S>::digits, 0);
  switch (source.below(10)) {
    case 0:
      return S(0);
    case 1:
      return S(1);
    case 2:
      return S(1) / S(2);
    case 3:
    case 4:
      return small;
    case 5:
    case 6:
      return S(1) - small;
    default:
      return source.unit<S>();
  }
}

/// A point equal to p0, a few ulps from it, near it, or any other.
template <class S>
Eigen::Matrix<S, 3, 1> point_near(Source& source, const Eigen::Matrix<S, 3, 1>& p0) {
  Eigen::Matrix<S, 3, 1> p = p0;
  switch (source.below(4)) {
    case 0:
      break;
    case 1:
      for (int i = 0; i < 3; ++i) p[i] = step_ulps(p[i], source.between(-2, 2));
      break;
    case 2: {
      const S scale = binade_uniform<S>(source, -std::numeric_limits<S>::digits - 4, 0);
      p += scale * direction<S>(source);
      break;
    }
    default:
      p = vector3<S>(source);
  }
  return p;
}

}  // namespace liecheck::properties
