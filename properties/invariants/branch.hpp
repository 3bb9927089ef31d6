#pragma once
// The errors of a logarithm. If a rotation vector is on another branch, its rotation is right but its angle
// is theta - 2 pi k.

#include <invariants/common.hpp>
#include <oracles/closed_forms.hpp>
#include <oracles/error.hpp>
#include <oracles/exp.hpp>
#include <oracles/integrate.hpp>

namespace liecheck::properties {

/// Whether the computed rotation vector, with an error of `error` eps, is the same rotation on another
/// branch. Then its error comes from the choice of the branch and not from rounding. Two rotations are the
/// same if they differ by less than 1e-3 rad, about sqrt(eps) of a float. Two branches differ if the vectors
/// differ by at least 1 rad. In ball arithmetic, a relative error above 0.1 throws Undecided.
template <class T>
bool on_other_branch(const oracles::Scalar& scalar, const oracles::Vec3<T>& computed,
                     const oracles::Vec3<T>& exact, double error) {
  using namespace oracles;
  if (!(error * scalar.epsilon > 0.1)) return false;  // the usual case
  if constexpr (BallNumber<T>) {
    throw Undecided();
  } else {
    if (norm(computed - exact) < 1) return false;
    const ExpResult a = exp_so3(computed), b = exp_so3(exact);
    return a.resolved && b.resolved && rotation_distance(a.Q, b.Q) < Real(1) / 1000;
  }
}

/// Where a logarithm changes its axis to the opposite one: at theta = pi exactly, for a stored quaternion,
/// whose w decides; or within 4 eps of the scalar of pi, for a matrix or a composed pose. There the rounding
/// of the entries, or of the product, may carry the rotation across pi. Of a subject that may err by more
/// than 4 eps, the sign of w is not asked either: so near pi, the rotation about the opposite axis by the
/// angle pi, rounded, is as good as the one on the side of w.
enum class Side { decided, either };
inline Side side_of(const Recorder& r, const Output& rotation_vector, std::size_t band) {
  return r.limit(rotation_vector, band) > 4 ? Side::either : Side::decided;
}

/// Whether a logarithm on the other side of pi is right, too.
template <class T>
bool at_either_side(const oracles::Scalar& scalar, const oracles::LogValue<T>& exact) {
  return exact.pi_minus_theta <= T(4 * scalar.epsilon);
}
/// (rho, phi) of the same pose with the opposite axis and the angle 2 pi - theta.
template <class T>
oracles::Vec6<T> opposite(const oracles::LogValue<T>& exact) {
  using namespace oracles;
  const Vec3<T> p = closed_left_jacobian(exact.value()).J * exact.rho,
                phi = T(-(exact.theta + twice(exact.pi_minus_theta)) / exact.theta) * exact.phi;
  return stack(closed_left_jacobian_inverse(stack(zero_vector<3, T>(), phi)).J * p, phi);
}
/// The exact logarithm on that side of pi where the computed axis is.
template <class T>
oracles::LogValue<T> at_side_of(const oracles::Scalar& scalar, const oracles::Vec3<T>& axis,
                                const oracles::LogValue<T>& exact) {
  if (!at_either_side(scalar, exact) || !(dot(axis, exact.phi) < T(0))) return exact;
  oracles::LogValue<T> other = exact;
  const oracles::Vec6<T> xi = opposite(exact);
  other.rho = head3(xi), other.phi = tail3(xi);
  return other;
}

/// The least denominators of the blocks of a logarithm.
template <class T>
struct LogScales {
  T linear = T(0), angular = T(0);
};
/// Those of the difference of two poses. Ordinary code takes the logarithm of the product T0^-1 T1, which costs eps of
/// the stored numbers: Q0* Q1 errs by eps, and R0^T p1 - R0^T p0 by eps max(||p0||, ||p1||).
template <class T>
LogScales<T> difference_scales(const Recorder& r, const Output& output, const T& separation, const T& p0,
                               const T& p1) {
  if (!r.ordinary(output)) return {separation, T(0)};
  return {oracles::larger(separation, oracles::larger(p0, p1)), T(1)};
}

/// Records the errors of a computed (rho, phi). The first of `outputs` is the rotation vector; the second, if
/// there is one, is rho. If `branches` is false, a vector on another branch is an ordinary error.
template <class T>
void record_log(Recorder& r, std::initializer_list<Output> outputs, std::size_t band,
                const Vec<double, 6>& computed, const oracles::LogValue<T>& value, Side side,
                const LogScales<T>& scales = {}, bool branches = true) {
  judged_value(r, outputs, band, computed, value.resolved, [&] {
    const auto xi = oracles::exact_vector<6, T>(computed);
    const auto exact = side == Side::either ? at_side_of(r.scalar(), tail3(xi), value) : value;
    const auto error = oracles::log_error(r.scalar(), xi, exact, scales.linear, scales.angular);
    const bool other = branches && on_other_branch(r.scalar(), tail3(xi), exact.phi, error.angular);
    for (const Output& o : outputs) {
      if (other)
        r.outcome(o, band, Outcome::wrong_branch);
      else
        r.record(o, band, &o == outputs.begin() ? error.angular : error.linear);
    }
  });
}

/// Records the errors of a computed difference of two configurations.
template <class T>
void record_difference(Recorder& r, std::initializer_list<Output> outputs, std::size_t band,
                       const Vec<double, 6>& computed, const oracles::DifferenceValue<T>& value,
                       const oracles::Vec7<T>& q0, const oracles::Vec7<T>& q1, bool branches = true) {
  using namespace oracles;
  record_log(r, outputs, band, computed, value, Side::either,
             difference_scales(r, *outputs.begin(), value.separation, norm(head3(q0)), norm(head3(q1))),
             branches);
}
/// Records the blocks of a computed derivative of difference.
template <class T>
void record_by_difference(Recorder& r, const TwoOutputs& outputs, std::size_t band, const Mat<double, 6>& J,
                          const oracles::Jacobian6Value<T>& exact, const oracles::Vec7<T>& q0,
                          const oracles::Vec7<T>& q1) {
  using namespace oracles;
  record_jacobian6(r, outputs, band, J, exact, larger(norm(head3(q0)), norm(head3(q1))),
                   r.ordinary(outputs[1]));
}

}  // namespace liecheck::properties
