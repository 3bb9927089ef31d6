#pragma once
// A mimic joint has no numbers in q and v. Its position x follows the position y of its primary joint:
//
//   x = multiplier y + offset [rad or m],  so  S_mimic = multiplier S(x)
//
// The mimic's generalised force, times the multiplier, is added to the primary's. For a continuous primary,
// y = atan2(sin, cos). Unless the multiplier is an integer, the mimic jumps when the primary passes pi.

#include <liecheck/multibody/joints/helical.hpp>
#include <liecheck/multibody/joints/prismatic.hpp>
#include <variant>

namespace liecheck {

template <Scalar S>
struct Mimic : LinearCoordinates<S, 0> {
  using Moved = std::variant<Revolute<S>, Prismatic<S>, Helical<S>>;
  static constexpr int columns = 1;
  using Subspace = Vector6<S>;

  Moved moved;
  int primary;  ///< index of the joint that the mimic follows
  S multiplier, offset;

  Mimic(const Moved& joint, int primary_index, const S& factor, const S& constant = S(0))
      : moved(joint), primary(primary_index), multiplier(factor), offset(constant) {
    using checked_rotation_detail::refuse;
    if (!finite<S>(multiplier)) refuse<S>("the multiplier of a mimic joint", multiplier, "not finite");
    if (!finite<S>(offset)) refuse<S>("the offset of a mimic joint", offset, "not finite");
  }

  /// X_PJ times the pose at x = multiplier y + offset.
  SE3<S> transform(const SE3<S>& X_PJ, const Vector1<S>& y) const {
    const Vector1<S> x(S(multiplier * y[0] + offset));
    return std::visit([&](const auto& joint) { return joint.transform(X_PJ, x); }, moved);
  }
  Subspace subspace() const {
    return multiplier * std::visit([](const auto& joint) { return joint.subspace(); }, moved);
  }

  std::string shortname() const { return "JointModelMimic"; }
  template <Scalar T>
  Mimic<T> cast() const {
    return std::visit(
        [&](const auto& joint) {
          return Mimic<T>(typename Mimic<T>::Moved(joint.template cast<T>()), primary, T(multiplier),
                          T(offset));
        },
        moved);
  }
};

}  // namespace liecheck
