#pragma once
// The axis of a one-degree-of-freedom joint: a unit vector in the joint's frame.

#include <liecheck/spatial/types.hpp>
#include <stdexcept>
#include <string>

namespace liecheck {

template <Scalar S>
class Axis {
 public:
  /// direction [3], any length but zero; a unit coordinate axis is kept to the last bit.
  explicit Axis(const Vector3<S>& direction) : unit_(direction) {
    if (!direction.allFinite() || direction.isZero(S(0)))
      throw std::invalid_argument("the axis of a joint must be finite and not zero");
    const Vector3<S> scaled = direction / direction.cwiseAbs().maxCoeff();
    using std::sqrt;
    unit_ = scaled / S(sqrt(scaled.squaredNorm()));
    coordinate_ = coordinateOf(unit_);
  }
  static Axis X() { return Axis(Vector3<S>::UnitX()); }
  static Axis Y() { return Axis(Vector3<S>::UnitY()); }
  static Axis Z() { return Axis(Vector3<S>::UnitZ()); }

  const Vector3<S>& to_vector() const { return unit_; }

  /// "X", "Y" or "Z" for those unit vectors exactly, else empty. -X is not aligned: a joint along it turns
  /// the other way.
  std::string aligned() const { return coordinate_ < 0 ? std::string() : std::string(1, "XYZ"[coordinate_]); }
  /// Pinocchio's type name: prefix + axis letter, or the unaligned name.
  std::string shortname(const std::string& prefix, const std::string& unaligned) const {
    const std::string letter = aligned();
    return letter.empty() ? unaligned : prefix + letter;
  }

  /// R_PJ R(a, theta) of cos theta and sin theta, R(a, theta) = c I + s [a] + (1 - c) a a^T (Rodrigues 1840).
  /// About a coordinate axis two columns turn and the third is kept to the last bit. Error 3 eps.
  Matrix3<S> turned(const Matrix3<S>& R_PJ, const S& c, const S& s) const {
    if (coordinate_ < 0) return R_PJ * rotation(c, s);
    const int j = (coordinate_ + 1) % 3, k = (coordinate_ + 2) % 3;
    Matrix3<S> R = R_PJ;
    R.col(j) = c * R_PJ.col(j) + s * R_PJ.col(k);
    R.col(k) = c * R_PJ.col(k) - s * R_PJ.col(j);
    return R;
  }

  /// R a.
  Vector3<S> in(const Matrix3<S>& R) const {
    if (coordinate_ >= 0) return R.col(coordinate_);
    return R * unit_;
  }

  /// The same numbers as T; narrowing rounds each, widening is not made unit again.
  template <Scalar T>
  Axis<T> cast() const {
    return typename Axis<T>::Unit{Vector3<T>(unit_.template cast<T>())};
  }

  /// A vector that is unit already.
  struct Unit {
    Vector3<S> vector;
  };
  Axis(const Unit& unit) : unit_(unit.vector), coordinate_(coordinateOf(unit.vector)) {}

 private:
  static int coordinateOf(const Vector3<S>& unit) {
    for (int i = 0; i < 3; ++i)
      if (unit == Vector3<S>::Unit(i)) return i;
    return -1;
  }
  Matrix3<S> rotation(const S& c, const S& s) const {
    const Vector3<S> sa = s * unit_;
    Matrix3<S> R = unit_ * (S(S(1) - c) * unit_).transpose() + skew<S>(sa);
    R.diagonal().array() += c;
    return R;
  }

  Vector3<S> unit_;
  int coordinate_ = -1;
};

}  // namespace liecheck
