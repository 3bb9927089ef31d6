#pragma once
// Random inputs on which time and error are measured, each from one band of angles.

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <generators/rotations.hpp>
#include <invariants/property.hpp>
#include <timing/bands.hpp>

namespace liecheck::properties {

namespace timing_detail {

template <class S>
Vec<S, 3> unit_vector(Source& source) {
  for (;;) {
    const S z = source.symmetric<S>(), y = source.symmetric<S>(), x = source.symmetric<S>();
    const Vec<S, 3> v(x, y, z);
    const S n = v.squaredNorm();
    if (n <= S(1) && n > S(1) / S(64)) return v / std::sqrt(n);
  }
}

template <class S>
S angle_in(const CostBand& band, Source& source) {
  const S low(static_cast<S>(band.low)), high(static_cast<S>(band.high));
  const S x = band.uniform ? low + (high - low) * source.unit<S>() : log_uniform<S>(source, low, high);
  return band.from_pi ? boost::math::constants::pi<S>() - x : x;
}

/// (sin(theta/2) n, cos(theta/2))
template <class S>
Vec<S, 4> quaternion_in(const CostBand& band, Source& source) {
  const S half = angle_in<S>(band, source) / S(2);
  Vec<S, 4> Q;
  Q << std::sin(half) * unit_vector<S>(source), std::cos(half);
  return Q.normalized();
}

}  // namespace timing_detail

/// One input of a law. Vectors are uniform in a cube with edges of 2 m. Rotations have an angle in the band.
/// In a pair of quaternions, the first has an angle in 0.1..pi-0.1; the angle between both is in the band. Euler angles are in
/// the order of this number.
template <class S>
std::vector<S> cost_input(const std::vector<Field>& fields, const CostBand& band, Source source,
                          int order = 0) {
  using namespace timing_detail;
  std::vector<S> x;
  Vec<S, 4> before = Vec<S, 4>::Zero();
  const bool pairs = std::any_of(fields.begin(), fields.end(), [](const Field& f) {
    return (f.kind == Kind::quaternion || f.kind == Kind::any_quaternion) && f.reach == Reach::beside;
  });
  for (const Field& f : fields) switch (f.kind) {
      case Kind::vector:
        for (int k = 0; k < f.size; ++k) x.push_back(source.symmetric<S>());
        break;
      case Kind::rotation_vector:
        append(x, Vec<S, 3>(angle_in<S>(band, source) * unit_vector<S>(source)));
        break;
      case Kind::rotation_matrix:
      case Kind::near_rotation:
        append(x, rotation_matrix<S>(quaternion_in<S>(band, source)));
        break;
      case Kind::quaternion:
      case Kind::any_quaternion: {
        Eigen::Quaternion<S> Q(quaternion_in<S>(pairs && before.isZero() ? cost_bands[3] : band, source));
        if (pairs && !before.isZero()) Q = (Eigen::Quaternion<S>(before) * Q).normalized();
        before = Q.coeffs();
        append(x, before);
        break;
      }
      case Kind::direction: {  // in space at an angle in the band from the one before
        if (f.size == 2) {
          const S angle = angle_in<S>(band, source);
          x.push_back(std::cos(angle)), x.push_back(std::sin(angle));
          break;
        }
        const Vec<S, 3> n = unit_vector<S>(source), other = unit_vector<S>(source);
        const S theta = angle_in<S>(band, source);
        const bool second = f.reach == Reach::beside;
        const Vec<S, 3> from = second ? Vec<S, 3>(x[x.size() - 3], x[x.size() - 2], x[x.size() - 1]) : n;
        append(x, second
                      ? Vec<S, 3>(std::cos(theta) * from + std::sin(theta) * from.cross(other).normalized())
                      : from);
        break;
      }
      case Kind::fraction:
        x.push_back(source.unit<S>());
        break;
      case Kind::angle:
        for (int k = 0; k < f.size; ++k) x.push_back(angle_in<S>(band, source));
        break;
      case Kind::choice:
        for (int k = 0; k < f.size; ++k) x.push_back(S(f.name == "order" ? order : 0));
        break;
      case Kind::positive:
        for (int k = 0; k < f.size; ++k) x.push_back(S(1) + source.unit<S>());
        break;
      case Kind::covariance:
        for (int k = 0; k < f.size; ++k) x.push_back(k % 7 ? S(1) / S(8) : S(1) + source.unit<S>());
        break;
      case Kind::inertia: {  // three unit masses in a cube with edges of 2 m
        Mat<S, 3> I = Mat<S, 3>::Zero();
        for (int k = 0; k < 3; ++k) {
          const S z = source.symmetric<S>(), y = source.symmetric<S>(), rx = source.symmetric<S>();
          const Vec<S, 3> r(rx, y, z);
          I += r.squaredNorm() * Mat<S, 3>::Identity() - r * r.transpose();
        }
        for (const S& v : {I(0, 0), I(0, 1), I(1, 1), I(0, 2), I(1, 2), I(2, 2)}) x.push_back(v);
        break;
      }
      default:
        throw std::logic_error("no cost input for field " + f.name);
    }
  return x;
}

}  // namespace liecheck::properties
