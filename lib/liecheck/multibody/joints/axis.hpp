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
  }
  static Axis X() { return Axis(Vector3<S>::UnitX()); }
  static Axis Y() { return Axis(Vector3<S>::UnitY()); }
  static Axis Z() { return Axis(Vector3<S>::UnitZ()); }

  const Vector3<S>& to_vector() const { return unit_; }

  /// "X", "Y" or "Z" for those unit vectors exactly, else empty. -X is not aligned: a joint along it turns
  /// the other way.
  std::string aligned() const {
    for (int i = 0; i < 3; ++i)
      if (unit_ == Vector3<S>::Unit(i)) return std::string(1, "XYZ"[i]);
    return {};
  }
  /// Pinocchio's type name: prefix + axis letter, or the unaligned name.
  std::string shortname(const std::string& prefix, const std::string& unaligned) const {
    const std::string letter = aligned();
    return letter.empty() ? unaligned : prefix + letter;
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
  Axis(const Unit& unit) : unit_(unit.vector) {}

 private:
  Vector3<S> unit_;
};

}  // namespace liecheck
