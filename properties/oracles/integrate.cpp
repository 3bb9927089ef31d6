#include <oracles/integrate.hpp>

#include <oracles/closed_forms.hpp>
#include <oracles/exp.hpp>
#include <oracles/matrix_exponential.hpp>

namespace liecheck::oracles {
namespace {

/// Second formula: do Q0* (Q1 - s Q0) and `relative` have equal vector parts? s = +-1 makes Q1 - s Q0 small.
bool vector_part_confirmed(const Quaternion<Real100>& Q0, const Quaternion<Real100>& Q1,
                           const Quaternion<Real100>& relative) {
  const Quaternion<Real100> D = relative[3] < 0 ? Q1 + Q0 : Q1 - Q0;
  const Quaternion<Real100> conjugate{{-Q0[0], -Q0[1], -Q0[2], Q0[3]}};
  return agree(head3(quaternion_product(conjugate, D)), head3(relative));
}

}  // namespace

IntegrateResult integrate(const Vec7<>& q0, const Vec6<>& delta) {
  const Vec7<Real100> start = cast<Real100>(q0);
  const ExpResult step = exp_se3(delta);
  const UnitPose<Real100> pose = closed_integrate(start, cast<Real100>(delta));
  IntegrateResult r{cast<Real>(pose.Q), cast<Real>(pose.p), step.theta, norm(step.p), false};

  // the second formula: R0 (R, p) by matrices at 50 digits, with the confirmed R and p of exp
  const Quaternion<Real> Q0 = normalized(quaternion_of(q0));
  const Mat3<Real> R0 = rotation_matrix(Q0);
  const Vec3<Real> p = head3(q0) + R0 * step.p;
  const Real p0_norm = norm(head3(q0));
  const Real scale = p0_norm > r.increment_norm ? p0_norm : r.increment_norm;
  r.resolved = step.resolved && agree(R0 * step.R, rotation_matrix(r.Q)) && agree(p, r.p, agreement, scale);
  return r;
}

DifferenceResult difference(const Vec7<>& q0, const Vec7<>& q1) {
  const Vec7<Real100> from = cast<Real100>(q0), to = cast<Real100>(q1);
  const RelativePose<Real100> relative = relative_pose(from, to);
  DifferenceResult r{log_of(relative.Q, relative.p), Real(norm(relative.p1_minus_p0))};
  const Quaternion<Real> Q0 = normalized(quaternion_of(q0));
  const Vec3<Real> p = transpose(rotation_matrix(Q0)) * cast<Real>(relative.p1_minus_p0);
  r.resolved = r.resolved && agree(p, cast<Real>(relative.p)) &&
               vector_part_confirmed(quaternion_of(from), quaternion_of(to), relative.Q);
  return r;
}

}  // namespace liecheck::oracles
