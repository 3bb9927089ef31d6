#include <oracles/error.hpp>

namespace liecheck::oracles {

namespace {
Real largest_rotation_distance() {
  return 2 * sqrt(Real(2));
}
}  // namespace

Real rotation_distance(const Quaternion<>& computed, const Quaternion<>& exact) {
  if (squared_norm(computed) == 0) return largest_rotation_distance();
  const Quaternion<> Q = normalized(computed);
  Real along(0);
  for (int i = 0; i < 4; ++i) along += Q[i] * exact[i];
  return 2 * norm(along < 0 ? Q + exact : Q - exact);
}

Real rotation_distance(const Mat3<>& computed, const Quaternion<>& exact) {
  const NearestQuaternion nearest = nearest_quaternion(cast<Real100>(computed));
  if (!isfinite(norm(computed))) return std::numeric_limits<Real>::infinity();
  if (!nearest.resolved) return largest_rotation_distance();
  return rotation_distance(cast<Real>(nearest.Q), exact);
}

Real norm_distance(const Quaternion<>& computed) {
  return abs(squared_norm(computed) - 1);
}

Real orthogonality_distance(const Mat3<>& computed) {
  return norm(transpose(computed) * computed - identity<3, Real>());
}

}  // namespace liecheck::oracles
