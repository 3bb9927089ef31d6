#include <bugs/cause_forms.hpp>
#include <numbers>

namespace liecheck::properties {
namespace {

using V6 = Vec<double, 6>;

/// V of exp by the plain closed form, and by a series of two terms below the threshold.
M3 closed_jacobian(const V3& phi, double threshold, bool second_order) {
  const double t = phi.norm();
  if (t < threshold)
    return second_order ? M3(M3::Identity() + (0.5 - t * t / 24) * hat(phi) + hat(phi) * hat(phi) / 6)
                        : M3(M3::Identity() + hat(phi) / 2);
  return M3::Identity() + (1 - std::cos(t)) / (t * t) * hat(phi) +
         (t - std::sin(t)) / (t * t * t) * hat(phi) * hat(phi);
}
V4 closed_planar_exp(const V3& delta, double threshold) {
  const double t = delta[2];
  const bool small = std::fabs(t) < threshold;
  const double a = small ? 1 - t * t / 6 : std::sin(t) / t, b = small ? t / 2 : (1 - std::cos(t)) / t;
  return {a * delta[0] - b * delta[1], b * delta[0] + a * delta[1], std::cos(t), std::sin(t)};
}

void add_jacobians(CauseForms& f) {
  const auto moderate = [](const V3& phi) { return phi.norm() < 3; };
  for (const double x : {1e-10, 1e-9, 1e-8, 1.5e-7, 1e-5, 1e-4})
    f.add("closed", cancels, x, op::left_jacobian3, moderate,
          [x](M3, const V3& phi) { return closed_jacobian(phi, x, x > 1e-9); });
  for (const double x : {1e-10, 1.5e-7, 1e-4})
    f.add(
        "closed", cancels, x, op::se2_exp, [](const V3& d) { return std::fabs(d[2]) < 3; },
        [x](V4, const V3& delta) { return closed_planar_exp(delta, x); });
  f.add(
      "closed", cancels, 1.4e-5, op::se2_log, [](const V4& q) { return q[2] > -0.9; },
      [](V3, const V4& q) -> V3 {  // half theta by its tangent, which cos - 1 decides
        const double t = std::atan2(q[3], q[2]), c = q[2] - 1;
        const double h = std::fabs(c) < 1e-10 ? 1 - t * t / 12 : -t / 2 * q[3] / c;
        return {h * q[0] + t / 2 * q[1], h * q[1] - t / 2 * q[0], t};
      });
  f.add(
      "half_turn", sin_pi, 0, op::left_jacobian3_inverse, [](const V3& phi) { return phi.norm() < 4; },
      [](M3 J, const V3& phi) -> M3 {
        const double t = phi.norm();
        return t < 0.1 ? J
                       : M3(M3::Identity() - hat(phi) / 2 +
                            (1 / (t * t) - (1 + std::cos(t)) / (2 * t * std::sin(t))) * hat(phi) * hat(phi));
      });
}

void add_rotations(CauseForms& f) {
  f.add("two_angle", sign_of_w, 0, op::log3_quaternion, always, [](V3, const V4& Q) -> V3 {
    const double square = vector(Q).squaredNorm();
    if (square <= 2.2e-16) return 2 * vector(Q);  // forgets that w may be negative
    const double s = std::sqrt(square), angle = 2 * (Q[3] < 0 ? std::atan2(-s, -Q[3]) : std::atan2(s, Q[3]));
    return angle / s * vector(Q);
  });
  for (const double x : {2e-8, 2e-6})
    f.add("nothing_below", zero, x, op::log3_quaternion, below(x),
          [](V3, const V4&) -> V3 { return V3::Zero(); });
  f.add("flipped_term", coefficient, 1e-3, op::exp3_quaternion, below(1e-3), [](V4, const V3& phi) -> V4 {
    const double t = phi.squaredNorm();
    return quaternion((0.5 + t / 48) * phi, 1 - t / 8);
  });
  for (const double x : {2.8e-3, 1e-2}) {
    f.add(
        "equal_below", zero, x, op::relative_angle,
        [x](const V4& Q, const V4& P) { return right()[op::relative_angle](Q, P) < x; },
        [](double, const V4&, const V4&) { return 0.0; });
    f.add(
        "lerp_below", interpolated, x, op::slerp,
        [x](const V4& Q, const V4& P, double) { return right()[op::relative_angle](Q, P) < x; },
        [](const V4&, const V4& Q, const V4& P, double t) -> V4 {
          return Q + t * (Q.dot(P) < 0 ? V4(-P - Q) : V4(P - Q));
        });
  }
  for (const double x : {4.5e-4, 3e-2})
    f.add(
        "any_axis", opposite_vectors, x, op::rotation_between,
        [x](const V3& a, const V3& b) { return a.cross(b).norm() < x * a.norm() * b.norm() && a.dot(b) < 0; },
        [](const V4&, const V3& a, const V3&) -> V4 {
          const V3 n = a.cross(std::fabs(a[0]) < 0.5 * a.norm() ? V3::UnitX() : V3::UnitY()).normalized();
          return quaternion(n, 0);
        });
  f.add(
      "root_of_sum", opposite_vectors, 0, op::rotation_between,
      [](const V3& a, const V3& b) { return a.dot(b) < 0; },
      [](const V4&, const V3& a, const V3& b) -> V4 {
        const V3 u = a.normalized(), v = b.normalized();
        const double s = std::sqrt(2 * (1 + u.dot(v)));
        return s == 0 ? V4(1, 0, 0, 0) : quaternion(u.cross(v) / s, s / 2);
      });
  f.add("few_steps", single, 0, op::normalize, always, [](const V4&, const V4& Q) -> V4 {
    double y = 0.9 / Q.stableNorm();  // three steps of Newton's iteration for 1 / sqrt(x), from a guess
    for (int k = 0; k < 3; ++k) y *= 1.5 - 0.5 * std::pow(y * Q.stableNorm(), 2);
    return y * Q;
  });
}

/// Formulas in place of the right ones, and what quaternions and matrices lose near pi.
void add_wrong_formulas(CauseForms& f) {
  f.add("lerp", interpolated, 0, op::slerp, always, [](const V4&, const V4& Q, const V4& P, double t) -> V4 {
    return ((1 - t) * Q + (Q.dot(P) < 0 ? -t : t) * P).normalized();
  });
  f.add(
      "far_side", other_formula, 0, op::slerp, [](const V4& Q, const V4& P, double) { return Q.dot(P) < 0; },
      [](const V4&, const V4& Q, const V4& P, double t) -> V4 {
        const double angle = std::acos(std::max(Q.dot(P), -1.0));
        return (std::sin((1 - t) * angle) * Q + std::sin(t * angle) * P) / std::sin(angle);
      });
  f.add("translation", other_formula, 0, op::difference, always,
        [](V6 d, const auto& q0, const auto& q1) -> V6 {
          const V4 Q = q0.template tail<4>();
          d.head<3>() = right()[op::rotate_point](quaternion(-vector(Q), Q[3]),
                                                  V3(q1.template head<3>() - q0.template head<3>()));
          return d;
        });
  f.add("quotient", other_formula, 0, op::se2_log, always, [](V3 d, const V4& q) -> V3 {
    d[2] = std::atan(q[3] / q[2]);
    return d;
  });
  f.add(
      "root_of_trace", trace, 0, op::exp3_quaternion, [](const V3& phi) { return phi.norm() < 3.2; },
      [](V4, const V3& phi) -> V4 {
        const M3 R = right()[op::exp3_matrix](phi);
        const double w = std::sqrt(1 + R.trace()) / 2;
        return quaternion(vee(R - R.transpose()) / (4 * w), w);
      });
  f.add("asin", acos_one, 0, op::log3_quaternion, always, [](V3, const V4& Q) -> V3 {
    const double s = vector(Q).stableNorm();
    return s == 0 ? V3::Zero() : V3((Q[3] < 0 ? -2 : 2) * std::asin(std::min(s, 1.0)) / s * vector(Q));
  });
  for (const double x : {1e-3, 1e-5})
    f.add(
        "no_signs", opposite_vectors, x, op::log3_matrix,
        [x](const M3& R) { return std::numbers::pi - theta_of(R) < x; },
        [](V3, const M3& R) -> V3 {
          return theta_of(R) * ((R.diagonal().array() + 1) / 2).max(0).sqrt().matrix();
        });
}

/// Whether the middle angle b of an order is an end of its range but for x, and that end.
std::pair<bool, double> locked(double order, const V3& angles, double x) {
  const double pi = std::numbers::pi, b = angles[1];
  const double end = order < 12 ? std::copysign(pi / 2, b) : b < 1 ? 0 : pi;
  return {std::fabs(end - b) < x, end};
}

void add_euler_angles(CauseForms& f) {
  for (const double x : {1e-7, 2e-3})
    f.add(
        "locked_below", at_lock, 0, op::euler_from_quaternion,
        [=](double order, const V4& Q) {
          return locked(order, right()[op::euler_from_quaternion](order, Q), x).first;
        },
        [](V3 angles, double order, const V4&) -> V3 {
          angles[1] = locked(order, angles, 1).second;
          return angles;
        });
  f.add("asin_of_entry", acos_one, 0, op::euler_from_quaternion, always,
        [](V3 angles, double order, const V4&) -> V3 {
          const double b = angles[1];
          angles[1] = order < 12 ? std::asin(std::sin(b)) : std::acos(std::cos(b));
          return angles;
        });
}

}  // namespace

void add_styles(CauseForms& f) {
  add_jacobians(f), add_rotations(f), add_wrong_formulas(f), add_euler_angles(f);
}

}  // namespace liecheck::properties
