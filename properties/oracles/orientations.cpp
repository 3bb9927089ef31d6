#include <oracles/orientations.hpp>

#include <oracles/exp.hpp>

namespace liecheck::oracles {
namespace {

using Wide = Real100;

template <class T>
T dot4(const Quaternion<T>& a, const Quaternion<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}
/// The rotation by `angle` about a coordinate axis.
template <class T>
Quaternion<T> about(int axis, const T& angle) {
  Quaternion<T> Q = zero_vector<4, T>();
  sin_cos(T(angle / 2), Q[axis], Q[3]);
  return Q;
}
template <class T>
Mat3<T> matrix_about(int axis, const T& angle) {
  Mat3<T> R = identity<3, T>();
  const int j = (axis + 1) % 3, k = (axis + 2) % 3;
  sin_cos(angle, R(k, j), R(j, j));
  R(k, k) = R(j, j), R(j, k) = -R(k, j);
  return R;
}
/// r = (cos, sin)/|(cos, sin)|.
template <class T>
Vec<2, T> unit_pair(const T& c, const T& s) {
  const T n = sqrt(c * c + s * s);
  return {{c / n, s / n}};
}

}  // namespace

RelativeAngle relative_angle(const Quaternion<>& Q0, const Quaternion<>& Q1) {
  const Quaternion<Wide> a = cast<Wide>(Q0), b = cast<Wide>(Q1), Q = conjugate_product(a, b);
  const auto size = [&](int i, int j) { return Wide(abs(a[i] * b[j]) + abs(a[j] * b[i])); };
  const Vec3<Wide> terms{{size(3, 0) + size(1, 2), size(3, 1) + size(2, 0), size(3, 2) + size(0, 1)}};
  const LogResult log = log_of(Q, zero_vector<3, Wide>());
  const Quaternion<Wide> x = normalized(a), y = normalized(b);
  const Wide half = norm(dot4(x, y) < 0 ? x + y : x - y) / 2;
  // The difference loses digits below theta = 1e-50. There only the two formulas of the logarithm confirm the value.
  const bool apart = agree(Wide(4 * asin(half)), Wide(log.theta), agreement, Wide(1e-50));
  return {log.theta, log.pi_minus_theta, Real(Wide(2 * norm(terms) / norm(Q))), log.resolved && apart};
}

TwistAngle twist_angle(const Quaternion<>& Q, const Vec3<>& axis) {
  const Quaternion<Wide> q = cast<Wide>(Q);
  const Vec3<Wide> n = cast<Wide>(axis);
  const Wide length = norm(n);
  Wide s = dot(head3(q), n) / length, w = q[3], terms(0);
  for (int i = 0; i < 3; ++i) terms += abs(q[i] * n[i]) / length;
  if (w < 0) s = -s, w = -w;
  const Wide square = s * s + w * w, angle = 2 * atan2(s, w);
  TwistAngle r;
  r.determined = square > Wide(1e-20);
  if (!r.determined) return r;
  r.angle = Real(angle), r.pi_minus_angle = Real(Wide(2 * atan2(w, Wide(abs(s)))));
  const Wide sensitivity = 2 * w * (abs(s) + terms) / square, size = abs(angle);
  r.scale = Real(size < sensitivity ? sensitivity : size);
  r.resolved = confirmed(true, [&]<class T>(T) {
    const T sine(s), cosine(w);
    return agree(T(4 * atan(T(sine / (sqrt(T(sine * sine + cosine * cosine)) + cosine)))), T(angle));
  });
  return r;
}

Slerp slerp(const Quaternion<>& Q0, const Quaternion<>& Q1, const Real& t) {
  const Quaternion<Wide> a = normalized(cast<Wide>(Q0)), b = normalized(cast<Wide>(Q1));
  const Wide sign(dot4(a, b) < 0 ? -1 : 1), fraction(t);
  const Quaternion<Wide> relative = conjugate_product(a, b);
  const Wide s = norm(head3(relative)), w = abs(relative[3]);
  const auto on_arc = [&](const Wide& towards, const Wide& half) {
    if (s == 0) return a;
    return normalized(Wide(sin(Wide((1 - fraction) * half))) * a +
                      Wide(towards * sin(Wide(fraction * half))) * b);
  };
  Slerp r;
  const Wide half = atan2(s, w), pi = acos(Wide(-1));
  r.theta = Real(Wide(2 * half)), r.pi_minus_theta = Real(Wide(2 * atan2(w, s)));
  const Quaternion<Wide> Q = on_arc(sign, half);
  r.Q = cast<Real>(Q), r.other = cast<Real>(on_arc(-sign, Wide(pi - half)));
  const LogResult log = log_of(relative, zero_vector<3, Wide>());
  const ExpResult step = exp_so3(t * log.phi);
  const Quaternion<> second = quaternion_product(cast<Real>(a), step.Q);
  r.resolved = log.resolved && step.resolved && (agree(second, r.Q) || agree(-second, r.Q) || log.at_pi);
  return r;
}

Order::Order(int number) {
  // The sequences in the order of docs/conventions.md.
  static const char* const sequences[12] = {"xyz", "xzy", "yxz", "yzx", "zxy", "zyx",
                                            "xyx", "xzx", "yxy", "yzy", "zxz", "zyz"};
  const char* const letters = sequences[number / 2];
  for (std::size_t i = 0; i < 3; ++i) axes[i] = letters[i] - 'x';
  rotating = number % 2 == 1;
}

std::string Order::name() const {
  std::string text;
  for (const int axis : axes) text += "XYZ"[axis];
  return text;
}

Resolved<Quaternion<>> euler(const Order& order, const Vec3<>& angles) {
  Quaternion<Wide> Q = zero_vector<4, Wide>();
  Q[3] = 1;
  Mat3<> R = identity<3, Real>();
  for (int n = 0; n < 3; ++n) {
    const int axis = order.axes[static_cast<std::size_t>(n)];
    const Quaternion<Wide> step = about<Wide>(axis, Wide(angles[n]));
    const Mat3<> turn = matrix_about<Real>(axis, angles[n]);
    Q = order.rotating ? quaternion_product(Q, step) : quaternion_product(step, Q);
    R = order.rotating ? R * turn : turn * R;
  }
  const Quaternion<> value = cast<Real>(Q);
  return {value, agree(R, rotation_matrix(value))};
}

Resolved<PlanarPose> planar_exp(const Vec3<>& delta) {
  const ExpResult e =
      exp_se3(stack(Vec3<>{{delta[0], delta[1], Real(0)}}, Vec3<>{{Real(0), Real(0), delta[2]}}));
  Real sine, cosine;
  sin_cos(delta[2], sine, cosine);
  const PlanarPose value{{e.p[0], e.p[1], e.Q[3] * e.Q[3] - e.Q[2] * e.Q[2], 2 * e.Q[3] * e.Q[2]}};
  const Vec<2, Real> r{{value[2], value[3]}}, second{{cosine, sine}};
  return {value, e.resolved && agree(second, r)};
}

Resolved<PlanarPose> planar_compose(const PlanarPose& q0, const PlanarPose& q1) {
  const auto x = cast<Wide>(q0), y = cast<Wide>(q1);
  const Vec<2, Wide> a = unit_pair<Wide>(x[2], x[3]), b = unit_pair<Wide>(y[2], y[3]);
  const Vec<4, Wide> value{{x[0] + (a[0] * y[0] - a[1] * y[1]), x[1] + (a[1] * y[0] + a[0] * y[1]),
                            a[0] * b[0] - a[1] * b[1], a[1] * b[0] + a[0] * b[1]}};
  // Second formula, by angles at 50 digits.
  const Real first = atan2(q0[3], q0[2]), sum = first + atan2(q1[3], q1[2]),
             size = sqrt(q1[0] * q1[0] + q1[1] * q1[1]), along = first + atan2(q1[1], q1[0]);
  const PlanarPose exact = cast<Real>(value);
  const Vec<2, Real> p{{exact[0], exact[1]}}, r{{exact[2], exact[3]}},
      p2{{q0[0] + size * cos(along), q0[1] + size * sin(along)}}, r2{{Real(cos(sum)), Real(sin(sum))}};
  const Real scale = size + sqrt(q0[0] * q0[0] + q0[1] * q0[1]);
  return {exact, agree(p2, p, agreement, scale) && agree(r2, r)};
}

LogResult planar_difference(const PlanarPose& q0, const PlanarPose& q1) {
  const auto x = cast<Wide>(q0), y = cast<Wide>(q1);
  const Vec<2, Wide> a = unit_pair<Wide>(x[2], x[3]);
  // Products of stored numbers are exact, so that s is zero if both angles are equal.
  const Wide dx = y[0] - x[0], dy = y[1] - x[1], c = x[2] * y[2] + x[3] * y[3], s = x[2] * y[3] - x[3] * y[2],
             n = sqrt(c * c + s * s);
  // The half angle: (sin, cos) ~ (s, n + c), or (n - c, s) beyond a right angle.
  Quaternion<Wide> Q = zero_vector<4, Wide>();
  if (c >= 0)
    Q[2] = s, Q[3] = n + c;
  else
    Q[2] = n - c, Q[3] = s;
  return log_of(normalized(Q), {{a[0] * dx + a[1] * dy, a[0] * dy - a[1] * dx, Wide(0)}});
}

}  // namespace liecheck::oracles
