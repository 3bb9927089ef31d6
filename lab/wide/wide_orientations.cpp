// The operations between rotations and directions, Euler angles, rates and poses in the plane at 100 digits.

#include <oracles/orientations.hpp>
#include <wide/wide_case.hpp>

namespace liecheck::properties {

using namespace wide_case;

namespace {

using V1 = oracles::Vec<1, Wide>;
using V2 = oracles::Vec<2, Wide>;

// Between rotations and directions.
void compare_relative_angle(Case& c) {
  const V4 a = c.x.read<V4>(), b = c.x.read<V4>(), Q = conjugate_product(a, b);
  const auto size = [&](int i, int j) { return Wide(abs(a[i] * b[j]) + abs(a[j] * b[i])); };
  const V3 terms{{size(3, 0) + size(1, 2), size(3, 1) + size(2, 0), size(3, 2) + size(0, 1)}};
  const Wide exact = 2 * atan2(norm(head3(Q)), Wide(abs(Q[3])));
  c.relative(block::angle, V1{{c.y.read<Wide>()}}, V1{{exact}}, Wide(2 * norm(terms) / norm(Q)));
}
void compare_twist(Case& c) {
  V4 Q = c.x.read<V4>();
  const V3 axis = c.x.read<V3>();
  if (Q[3] < 0) Q = -Q;
  const Wide n = norm(axis), s = dot(head3(Q), axis) / n, w = Q[3], exact = 2 * atan2(s, w);
  Wide terms(0);
  for (int i = 0; i < 3; ++i) terms += abs(Q[i] * axis[i]) / n;
  c.relative(block::angle, V1{{c.y.read<Wide>()}}, V1{{exact}},
             Wide(2 * w * (abs(s) + terms) / (s * s + w * w)));
}
void compare_slerp(Case& c) {
  const V4 a = oracles::normalized(c.x.read<V4>()), b = oracles::normalized(c.x.read<V4>());
  const Wide t = c.x.read<Wide>();
  const V4 computed = c.y.read<V4>();
  c.rotation(computed,
             quaternion_product(
                 a, closed_exp(stack(zero(), t * tail3(closed_log(conjugate_product(a, b), zero())))).Q));
  c.distance(block::norm_defect, abs(squared_norm(computed) - 1));
}
void compare_between(Case& c) {
  V3 a = c.x.read<V3>(), b = c.x.read<V3>();
  a = Wide(1 / norm(a)) * a, b = Wide(1 / norm(b)) * b;
  const V4 Q = c.y.read<V4>();
  c.distance(block::direction, norm(rotate(Q, a) - b));
  c.distance(block::twist, 2 * abs(dot(head3(Q), a)) / norm(Q));
  c.distance(block::norm_defect, abs(squared_norm(Q) - 1));
}
V4 euler(const Wide& number, const V3& angles) {
  const oracles::Order order(static_cast<int>(number));
  V4 Q{{Wide(0), Wide(0), Wide(0), Wide(1)}};
  for (int n = 0; n < 3; ++n) {
    V3 turn = zero();
    turn[order.axes[static_cast<std::size_t>(n)]] = angles[n];
    const V4 step = exp3(turn);
    Q = order.rotating ? quaternion_product(Q, step) : quaternion_product(step, Q);
  }
  return Q;
}
template <class Rotation>
void compare_angles(Case& c, Rotation rotation_of) {
  const Wide order = c.x.read<Wide>();
  const V4 exact = rotation_of();
  c.rotation(euler(order, c.y.read<V3>()), exact);
}
void compare_rate(Case& c) {
  const V4 Q = quaternion_of(c.x.read<V7>());
  const V6 V = c.x.read<V6>();
  const V7 rate = c.y.read<V7>();
  const V3 u = head3(V), omega = tail3(V);
  c.relative(block::translation, head3(rate), rotate(Q, u), norm(u));
  c.relative(block::rotation_rate, quaternion_of(rate),
             Wide(0.5) * quaternion_product(Q, V4{{omega[0], omega[1], omega[2], Wide(0)}}));
}
void compare_velocity(Case& c) {
  const V4 Q = quaternion_of(c.x.read<V7>());
  const V7 rate = c.x.read<V7>();
  const V6 V = c.y.read<V6>();
  const V4 Q_dot = quaternion_of(rate);
  c.relative(block::linear, head3(V), rotate(Q, head3(rate), true), norm(head3(rate)));
  c.relative(block::angular, tail3(V), Wide(2 / squared_norm(Q)) * head3(conjugate_product(Q, Q_dot)),
             Wide(2 * norm(Q_dot) / norm(Q)));
}

// Poses in the plane, as poses in space that move in this plane.
V7 in_space(const V4& q) {  // (x, y, 0) and the quaternion of (cos, sin)
  const Wide n = sqrt(q[2] * q[2] + q[3] * q[3]);
  const bool acute = q[2] >= 0;
  return {
      {q[0], q[1], Wide(0), Wide(0), Wide(0), acute ? q[3] : Wide(n - q[2]), acute ? Wide(n + q[2]) : q[3]}};
}
V6 in_space(const V3& delta) {
  return {{delta[0], delta[1], Wide(0), Wide(0), Wide(0), delta[2]}};
}
void planar_pose(Case& c, const oracles::UnitPose<Wide>& exact, const Wide& scale) {
  const V4 q = c.y.read<V4>();
  const Wide square = q[2] * q[2] + q[3] * q[3], n = sqrt(square), z = exact.Q[2], w = exact.Q[3];
  c.distance(block::rotation, norm(V2{{q[2] / n - (w * w - z * z), q[3] / n - 2 * w * z}}));
  c.relative(block::translation, V2{{q[0], q[1]}}, V2{{exact.p[0], exact.p[1]}}, scale);
  c.distance(block::norm_defect, abs(square - 1));
}
void planar_log(Case& c, const V6& exact, const Wide& scale) {
  const V3 delta = c.y.read<V3>();
  c.relative(block::angle, delta[2], exact[5]);
  c.relative(block::linear, V2{{delta[0], delta[1]}}, V2{{exact[0], exact[1]}}, scale);
}
void compare_planar_step(Case& c) {
  const V7 q0 = in_space(c.x.read<V4>());
  const auto exact = closed_integrate(q0, in_space(c.x.read<V3>()));
  planar_pose(c, exact, std::max(Wide(norm(head3(q0))), Wide(norm(exact.p - head3(q0)))));
}
void compare_planar_product(Case& c) {
  const V7 q0 = in_space(c.x.read<V4>()), q1 = in_space(c.x.read<V4>());
  const V4 Q0 = oracles::normalized(quaternion_of(q0)), Q1 = oracles::normalized(quaternion_of(q1));
  planar_pose(c, {quaternion_product(Q0, Q1), head3(q0) + rotate(Q0, head3(q1))},
              std::max(Wide(norm(head3(q0))), Wide(norm(head3(q1)))));
}
void compare_planar_difference(Case& c) {
  const V7 q0 = in_space(c.x.read<V4>()), q1 = in_space(c.x.read<V4>());
  planar_log(c, closed_difference(q0, q1), norm(head3(q1) - head3(q0)));
}

}  // namespace

std::vector<Comparison> comparisons_of_orientations() {
  return {// between rotations and directions
          {&op::relative_angle, compare_relative_angle},
          {&op::twist_angle, compare_twist},
          {&op::slerp, compare_slerp},
          {&op::rotation_between, compare_between},
          {&op::euler_to_quaternion, against(&Case::quaternion, euler)},
          {&op::euler_to_matrix, against(&Case::matrix, euler)},
          {&op::euler_from_quaternion,
           [](Case& c) { compare_angles(c, [&] { return oracles::normalized(c.x.read<V4>()); }); }},
          {&op::euler_from_matrix,
           [](Case& c) { compare_angles(c, [&] { return nearest_quaternion(c.x.read<M3>()).Q; }); }},
          {&op::velocity_to_rate, compare_rate},
          {&op::rate_to_velocity, compare_velocity},
          // poses in the plane
          {&op::se2_exp, [](Case& c) { planar_pose(c, closed_exp(in_space(c.x.read<V3>())), Wide(0)); }},
          {&op::se2_log,
           [](Case& c) {
             const V7 q = in_space(c.x.read<V4>());
             planar_log(c, closed_log(quaternion_of(q), head3(q)), Wide(0));
           }},
          {&op::se2_compose, compare_planar_product},
          {&op::se2_integrate, compare_planar_step},
          {&op::se2_difference, compare_planar_difference}};
}

}  // namespace liecheck::properties
