#pragma once
// Checks of the values of q and v, and the exception that they throw.

#include <liecheck/multibody/model.hpp>
#include <locale>
#include <sstream>

namespace liecheck {

/// Thrown for an invalid q or v. It names the joint and its index, the index in the vector, and the value.
class InvalidConfiguration : public std::invalid_argument {
 public:
  /// `at` is the index in q or v. `number` is the number there, or |Q|^2 if the norm is wrong.
  InvalidConfiguration(const std::string& what, const std::string& name, int joint, int at, double number)
      : std::invalid_argument(what), joint_name(name), joint_index(joint), index(at), value(number) {}

  std::string joint_name;
  int joint_index;
  int index;
  double value;
};

namespace invalid_configuration_detail {

template <Scalar S>
[[noreturn]] void refuse(const Model<S>& model, int joint, const char* vector, int index, const S& value,
                         const std::string& why) {
  const std::string& name = model.names[std::size_t(joint)];
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(std::numeric_limits<double>::max_digits10);
  text << "joint '" << name << "' (joint " << joint << "), " << vector << "[" << index << "]: " << why << " ("
       << double(value) << ")";
  throw InvalidConfiguration(text.str(), name, joint, index, double(value));
}

template <Scalar S, class Place>
void refuseNonFinite(const Model<S>& model, const Place& place, const VectorX<S>& v) {
  const auto tangent = place.tangent(v);
  for (int i = 0; i < tangent.size(); ++i)
    if (!finite<S>(tangent[i])) refuse<S>(model, place.index, "v", place.idx_v + i, tangent[i], "not finite");
}

/// Refuses what normalisation cannot repair: numbers that are not finite, and unit vectors that are zero.
template <Scalar S, class Place>
void refuseUnrepairable(const Model<S>& model, const Place& place, const VectorX<S>& q) {
  using J = std::remove_cvref_t<decltype(place.joint)>;
  const typename J::Configuration segment = place.configuration(q);
  for (int i = 0; i < segment.size(); ++i)
    if (!finite<S>(segment[i])) refuse<S>(model, place.index, "q", place.idx_q + i, segment[i], "not finite");
  if constexpr (J::nq > J::nv) {
    constexpr int length = J::nq - J::unit_begin;
    if (segment.template tail<length>().isZero(S(0)))
      refuse<S>(model, place.index, "q", place.idx_q + J::unit_begin, S(0),
                length == 4 ? "a zero quaternion is not a rotation" : "(cos, sin) = (0, 0) is not an angle");
  }
}

template <Scalar S, class Place>
void refuseOffUnit(const Model<S>& model, const Place& place, const VectorX<S>& q, const S& budget) {
  using J = std::remove_cvref_t<decltype(place.joint)>;
  if constexpr (J::nq > J::nv) {
    const S defect = place.joint.normDefect(place.configuration(q));
    if (!(absolute<S>(defect) <= budget))
      refuse<S>(model, place.index, "q", place.idx_q + J::unit_begin, S(defect + S(1)),
                "the squared norm is not 1 up to 8 eps: normalize first");
  }
}

}  // namespace invalid_configuration_detail
}  // namespace liecheck
