#pragma once
// The axis of a joint with one degree of freedom: a unit vector in the joint's frame.

#include <liecheck/spatial/checked_rotation.hpp>
#include <liecheck/spatial/types.hpp>
#include <stdexcept>
#include <string>

namespace liecheck {

template <Scalar S>
class Axis {
 public:
  /// Normalises direction [3]; coordinate axes stay exact. Throws std::invalid_argument for 0, inf and NaN.
  explicit Axis(const Vector3<S>& direction) : unit_(direction) {
    checked_rotation_detail::refuseNonFinite<S>("the axis of a joint", direction);
    if (direction.isZero(S(0))) throw std::invalid_argument("the axis of a joint is zero");
    const Vector3<S> scaled = direction / direction.cwiseAbs().maxCoeff();
    using std::sqrt;
    unit_ = scaled / S(sqrt(scaled.squaredNorm()));
    align();
  }
  static Axis X() { return Unit{Vector3<S>::UnitX()}; }
  static Axis Y() { return Unit{Vector3<S>::UnitY()}; }
  static Axis Z() { return Unit{Vector3<S>::UnitZ()}; }

  const Vector3<S>& to_vector() const { return unit_; }

  /// "X", "Y" or "Z" for exactly these unit vectors; empty for all others, such as -X.
  std::string aligned() const {
    return coordinate_ < 0 || unit_[coordinate_] < S(0) ? std::string() : std::string(1, "XYZ"[coordinate_]);
  }
  /// Pinocchio's type name: prefix + axis letter, or the unaligned name.
  std::string shortname(const std::string& prefix, const std::string& unaligned) const {
    const std::string letter = aligned();
    return letter.empty() ? unaligned : prefix + letter;
  }

  /// R_PJ R(a, theta), where c = cos theta, s = sin theta and R(a, theta) = c I + s [a] + (1 - c) a a^T
  /// (Rodrigues 1840). A rotation about +-X, +-Y or +-Z leaves one column of R_PJ unchanged. Error 3 eps.
  [[gnu::always_inline]] Matrix3<S> rotated(const Matrix3<S>& R_PJ, const S& c, const S& s) const {
    switch (coordinate_) {
      case 0:
        return rotatedAbout<0>(R_PJ, c, S(unit_[0] * s));
      case 1:
        return rotatedAbout<1>(R_PJ, c, S(unit_[1] * s));
      case 2:
        return rotatedAbout<2>(R_PJ, c, S(unit_[2] * s));
    }
    return product<S>(R_PJ, rotation(c, s));
  }

  /// The axis times a matrix [3 x 3], such as the axis rotated by R.
  template <class Matrix>
  [[gnu::always_inline]] Vector3<S> in(const Matrix& R) const {
    if (coordinate_ >= 0) return each<S>([&](int i) { return S(unit_[coordinate_] * R(i, coordinate_)); });
    return product<S>(Matrix3<S>(R), unit_);
  }

  /// The axis converted to T. It is not normalised again.
  template <Scalar T>
  Axis<T> cast() const {
    return typename Axis<T>::Unit{Vector3<T>(unit_.template cast<T>())};
  }

  /// A vector that is already normalised.
  struct Unit {
    Vector3<S> vector;
  };
  Axis(const Unit& unit) : unit_(unit.vector) { align(); }

 private:
  /// Entry by entry, so that the result stays in registers.
  template <int I>
  [[gnu::always_inline]] static Matrix3<S> rotatedAbout(const Matrix3<S>& R, const S& c, const S& s) {
    const auto entry = [&](int i, int column) __attribute__((always_inline)) {
      constexpr int j = (I + 1) % 3, k = (I + 2) % 3;
      return column == I   ? R(i, I)
             : column == j ? mul_add(c, R(i, j), S(s * R(i, k)))
                           : mul_add(c, R(i, k), S(-(s * R(i, j))));
    };
    return rows<S>(entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 0), entry(1, 1), entry(1, 2), entry(2, 0),
                   entry(2, 1), entry(2, 2));
  }
  void align() {
    for (int i = 0; i < 3; ++i)
      if (unit_.cwiseAbs() == Vector3<S>::Unit(i)) coordinate_ = i;
  }
  [[gnu::always_inline]] Matrix3<S> rotation(const S& c, const S& s) const {
    const S x = unit_[0], y = unit_[1], z = unit_[2], C = S(1) - c, X = C * x, Y = C * y, Z = C * z;
    const S sx = s * x, sy = s * y, sz = s * z;
    return rows<S>(S(x * X) + c, S(x * Y) - sz, S(x * Z) + sy, S(y * X) + sz, S(y * Y) + c, S(y * Z) - sx,
                   S(z * X) - sy, S(z * Y) + sx, S(z * Z) + c);
  }

  Vector3<S> unit_;
  int coordinate_ = -1;  ///< unit_ = +-e_coordinate, or -1 if the axis is along no coordinate axis
};

}  // namespace liecheck
