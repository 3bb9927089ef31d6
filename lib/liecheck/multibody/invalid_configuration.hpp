#pragma once
// Checks of the values of q and v, and the exception that they throw.

#include <liecheck/multibody/joint_place.hpp>
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

namespace multibody_detail {

/// Refuses the number at `index` of the vector named `vector`, which belongs to the joint.
template <Scalar S, class J>
[[noreturn, gnu::noinline, gnu::cold]] void refuse(const JointPlace<S, J>& joint, const char* vector,
                                                   int index, const S& value, const char* why) {
  const std::string& name = joint.model.names[std::size_t(joint.index)];
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(std::numeric_limits<double>::max_digits10);
  text << "joint '" << name << "' (joint " << joint.index << "), " << vector << "[" << index << "]: " << why
       << " (" << double(value) << ")";
  throw InvalidConfiguration(text.str(), name, joint.index, index, double(value));
}

/// Refuses a tangent vector v [nv] unless the joint's numbers are finite.
template <Scalar S, class J>
void refuseNonFiniteTangent(const JointPlace<S, J>& joint, const VectorX<S>& v, const char* what) {
  for (int i = joint.idx_v; i < joint.idx_v + J::nv; ++i)
    if (!finite<S>(v[i])) refuse(joint, what, i, v[i], "not finite");
}

/// Refuses a configuration q [nq] unless the joint's numbers are finite.
template <Scalar S, class J>
void refuseNonFiniteConfiguration(const JointPlace<S, J>& joint, const VectorX<S>& q, const char* what) {
  for (int i = joint.idx_q; i < joint.idx_q + J::nq; ++i)
    if (!finite<S>(q[i])) refuse(joint, what, i, q[i], "not finite");
}

/// Refuses q [nq] if the joint's quaternion or (cos, sin) is zero.
template <Scalar S, class J>
void refuseZero(const JointPlace<S, J>& joint, const VectorX<S>& q, const char* what) {
  constexpr int length = J::nq - J::unit_begin;
  if constexpr (length > 0)
    if (joint.configuration(q).template tail<length>().isZero(S(0)))
      refuse(joint, what, joint.idx_q + J::unit_begin, S(0), unit_vector_detail::zero_is_refused<length>);
}

template <Scalar S, class J>
void refuseOffUnit(const JointPlace<S, J>& joint, const VectorX<S>& q, const S& budget) {
  if constexpr (J::unit_begin < J::nq) {
    const S defect = joint.joint.normDefect(joint.configuration(q));
    if (!(absolute<S>(defect) <= budget))
      refuse(joint, "q", joint.idx_q + J::unit_begin, S(defect + S(1)),
             "the squared norm is not 1 up to 8 eps: normalize first");
  }
}

}  // namespace multibody_detail
}  // namespace liecheck
