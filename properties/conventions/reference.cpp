#include <conventions/reference.hpp>

#include <conventions/formulas.hpp>
#include <oracles/normalisation.hpp>

namespace liecheck::properties::conventions {
namespace {

using namespace formula_detail;

template <class B>
Formulas<B> exponentials() {
  using V3 = Vec3<B>;
  using V4 = Quaternion<B>;
  using V6 = Vec6<B>;
  const auto jacobian3 = [](auto f) {
    return of<B, V3>([f](const V3& phi) { return f(stack(zero_vector<3, B>(), phi)).J; });
  };
  const auto left = [](const V6& xi) { return left_jacobian_se3(xi); };
  const auto right = [](const V6& xi) { return right_jacobian_se3(xi); };
  const auto left_inverse = [](const V6& xi) { return left_jacobian_se3_inverse(xi); };
  const auto right_inverse = [](const V6& xi) { return right_jacobian_se3_inverse(xi); };
  const auto log3 = of<B, V4>([](const V4& Q) { return log_so3(Q).phi; });
  return {{"exp3_quaternion", of<B, V3>([](const V3& phi) { return exp_so3(phi).Q; })},
          {"exp3_matrix", of<B, V3>([](const V3& phi) { return rotation_matrix(exp_so3(phi).Q); })},
          {"log3_quaternion", log3},
          {"log3_any_norm", log3},
          {"log3_matrix",
           of<B, Mat3<B>>([](const auto& R) { return log_se3_matrix(R, zero_vector<3, B>()).phi; })},
          {"exp6", of<B, V6>([](const V6& xi) {
             const ExpValue<B> e = exp_se3(xi);
             return PoseOf<B>{rotation_matrix(e.Q), e.p};
           })},
          {"log6", of<B, PoseOf<B>>([](const auto& X) { return log_se3_matrix(X.R, X.p); })},
          {"left_jacobian3", jacobian3(left)},
          {"right_jacobian3", jacobian3(right)},
          {"left_jacobian3_inverse", jacobian3(left_inverse)},
          {"right_jacobian3_inverse", jacobian3(right_inverse)},
          {"left_jacobian6", of<B, V6>(left)},
          {"right_jacobian6", of<B, V6>(right)},
          {"left_jacobian6_inverse", of<B, V6>(left_inverse)},
          {"right_jacobian6_inverse", of<B, V6>(right_inverse)}};
}

template <class B>
Formulas<B> spatial_algebra() {
  using P = PoseOf<B>;
  using I = BodyOf<B>;
  using V = Vec6<B>;
  return {{"compose", of<B, P, P>([](const P& X, const P& Y) {
             return P{X.R * Y.R, X.R * Y.p + X.p};
           })},
          {"inverse", of<B, P>([](const P& X) {
             return P{transpose(X.R), -(transpose(X.R) * X.p)};
           })},
          {"act_point", of<B, P, Vec3<B>>([](const P& X, const auto& x) { return X.R * x + X.p; })},
          {"act_motion", of<B, P, V>(formulas::act_motion<B>)},
          {"act_inverse_motion", of<B, P, V>(formulas::act_inverse_motion<B>)},
          {"act_force", of<B, P, V>(formulas::act_force<B>)},
          {"act_inverse_force", of<B, P, V>(formulas::act_inverse_force<B>)},
          {"cross_motion", of<B, V, V>(formulas::cross_motion<B>)},
          {"cross_force", of<B, V, V>(formulas::cross_force<B>)},
          {"act_inertia", of<B, P, I>(formulas::act_inertia<B>)},
          {"act_inverse_inertia", of<B, P, I>(formulas::act_inverse_inertia<B>)},
          {"momentum", of<B, I, V>(formulas::momentum<B>)},
          {"kinetic_energy", of<B, I, V>(formulas::kinetic_energy<B>)},
          {"inertia_matrix", of<B, I>(formulas::inertia_matrix<B>)}};
}

template <class B>
Formulas<B> configurations() {
  using V4 = Quaternion<B>;
  using V6 = Vec6<B>;
  using V7 = Vec7<B>;
  const auto rotated = of<B, V4, Vec3<B>>([](const V4& Q, const auto& x) { return rotate(Q, x); });
  const auto plus = of<B, V7, V6>([](const V7& q, const V6& delta) {
    const IntegrateValue<B> v = oracles::integrate(q, delta);
    return std::pair(v.p, v.Q);
  });
  const auto minus = of<B, V7, V7>([](const V7& q0, const V7& q1) { return oracles::difference(q0, q1); });
  const auto minus_by_q1 =
      of<B, V7, V7>([](const V7& q0, const V7& q1) { return oracles::d_difference_arg1(q0, q1); });
  return {{"rotate_point", rotated},
          {"rotate_point_any_norm", rotated},
          {"integrate", plus},
          {"integrate_any_norm", plus},
          {"difference", minus},
          {"difference_any_norm", minus},
          {"d_integrate_arg0",
           of<B, V7, V6>([](const V7& q, const V6& delta) { return oracles::d_integrate_arg0(q, delta); })},
          {"d_integrate_arg1",
           of<B, V7, V6>([](const V7& q, const V6& delta) { return oracles::d_integrate_arg1(q, delta); })},
          {"d_difference_arg0",
           of<B, V7, V7>([](const V7& q0, const V7& q1) { return oracles::d_difference_arg0(q0, q1); })},
          {"d_difference_arg1", minus_by_q1},
          {"d_difference_any_norm", minus_by_q1},
          {"integrate_coefficient_jacobian",
           of<B, V7>([](const V7& q) { return oracles::integrate_coefficient_jacobian(q); })},
          {"normalize", of<B, V4>([](const V4& Q) { return oracles::normalize(Q); })},
          {"first_order_normalize", of<B, V4>([](const V4& Q) { return oracles::first_order_normalize(Q); })},
          {"matrix_from_quaternion_any_norm",
           of<B, V4>([](const V4& Q) { return oracles::matrix_from_quaternion(Q); })}};
}

/// Euler angles [rad] of a rotation matrix, middle angle in (-pi/2, pi/2) or (0, pi), by its entries.
Vec3<Real> angles_of(const Order& order, const Mat3<Real>& R) {
  const Mat3<Real> M = order.rotating ? R : transpose(R);
  const int i = order.axes[0], j = order.axes[1], k = 3 - i - j;
  const Real sign((j - i + 3) % 3 == 1 ? 1 : -1), turn(order.rotating ? 1 : -1);
  const bool proper = order.axes[0] == order.axes[2];
  const auto length = [](const Real& x, const Real& y) { return Real(sqrt(Real(x * x + y * y))); };
  const Real a = proper ? Real(turn * atan2(M(j, i), Real(-turn * sign * M(k, i))))
                        : Real(atan2(Real(-sign * M(j, k)), M(k, k))),
             b = proper ? Real(atan2(length(M(j, i), M(k, i)), M(i, i)))
                        : Real(turn * atan2(Real(sign * M(i, k)), length(M(j, k), M(k, k))));
  // Row j of R_i(a)^T M, which is that of the last turn: with it the angles give M back also where a is any, at gimbal lock.
  const auto left = [&](int n) { return Real(cos(a) * M(j, n) + sign * sin(a) * M(k, n)); };
  const Real c =
      proper ? Real(atan2(Real(-sign * left(k)), left(j))) : Real(atan2(Real(sign * left(i)), left(j)));
  return {{Real(turn * a), b, Real(turn * c)}};
}
/// A rotation that turns u to v the shortest way; of opposite ones, about an axis perpendicular to u.
Quaternion<> between(const Vec3<>& u, const Vec3<>& v) {
  const Vec3<> from = Real(1 / norm(u)) * u, to = Real(1 / norm(v)) * v, n = cross(from, to);
  const Real w(1 + dot(from, to));
  if (w + norm(n) < Real(1e-40))  // opposite, but for rounding
    return normalized(abs(u[0]) > abs(u[2]) ? Quaternion<>{{Real(-u[1]), u[0], Real(0), Real(0)}}
                                            : Quaternion<>{{Real(0), Real(-u[2]), u[1], Real(0)}});
  return normalized(Quaternion<>{{n[0], n[1], n[2], w}});
}
/// Between rotations and directions, Euler angles and rates: only in Real.
Formulas<Real> orientations() {
  using V3 = Vec3<>;
  using V4 = Quaternion<>;
  using V7 = Vec7<>;
  return {{"relative_angle", of<Real, V4, V4>([](const V4& Q0, const V4& Q1) {
             return oracles::relative_angle(Q0, Q1).theta;
           })},
          {"twist_angle",
           of<Real, V4, V3>([](const V4& Q, const V3& axis) { return oracles::twist_angle(Q, axis).angle; })},
          {"slerp", of<Real, V4, V4, Real>([](const V4& Q0, const V4& Q1, const Real& t) {
             return oracles::slerp(Q0, Q1, t).Q;
           })},
          {"rotation_between", of<Real, V3, V3>(between)},
          {"euler_to_quaternion", of<Real, Order, V3>(euler)},
          {"euler_to_matrix", of<Real, Order, V3>([](const Order& order, const V3& angles) {
             return rotation_matrix(euler(order, angles).value);
           })},
          {"euler_from_quaternion", of<Real, Order, V4>([](const Order& order, const V4& Q) {
             return angles_of(order, rotation_matrix(normalized(Q)));
           })},
          {"euler_from_matrix", of<Real, Order, Mat3<>>(angles_of)},
          {"velocity_to_rate", of<Real, V7, V3, V3>([](const V7& q, const V3& u, const V3& omega) {
             const V4 Q = quaternion_of(q), turning{{omega[0], omega[1], omega[2], Real(0)}};
             return std::pair(rotate(Q, u), V4(Real(Real(1) / 2) * quaternion_product(Q, turning)));
           })},
          {"rate_to_velocity", of<Real, V7, V3, V4>([](const V7& q, const V3& p_dot, const V4& Q_dot) {
             const V4 Q = quaternion_of(q);
             return std::pair(rotate(Q, p_dot, true),
                              V3(Real(2 / squared_norm(Q)) * head3(conjugate_product(Q, Q_dot))));
           })}};
}
Formulas<Real> planar_poses() {
  using V3 = Vec3<>;
  using V4 = PlanarPose;
  const auto of_log = [](const LogResult& log) { return V3{{log.rho[0], log.rho[1], log.phi[2]}}; };
  return {{"se2_exp", of<Real, V3>(planar_exp)},
          {"se2_log", of<Real, V4>([of_log](const V4& q) {
             return of_log(planar_difference({{Real(0), Real(0), Real(1), Real(0)}}, q));
           })},
          {"se2_compose", of<Real, V4, V4>(planar_compose)},
          {"se2_integrate", of<Real, V4, V3>([](const V4& q, const V3& delta) {
             return planar_compose(q, planar_exp(delta).value);
           })},
          {"se2_difference", of<Real, V4, V4>([of_log](const V4& q0, const V4& q1) {
             return of_log(planar_difference(q0, q1));
           })}};
}

template <class B>
std::vector<B> result(const Operation& operation, const std::vector<B>& arguments) {
  static const Formulas<B> all = [] {
    Formulas<B> f = exponentials<B>();
    f.merge(spatial_algebra<B>());
    f.merge(configurations<B>());
    if constexpr (std::is_same_v<B, Real>) {
      f.merge(orientations()), f.merge(planar_poses());
      f.merge(representations()), f.merge(transforms()), f.merge(navigation());
    }
    return f;
  }();
  if constexpr (!std::is_same_v<B, Real>)
    if (!all.contains(operation.name)) {
      std::vector<Real> exact;
      for (const B& x : arguments) exact.push_back(oracles::exact<Real>(x));
      std::vector<B> value;
      for (const Real& x : result<Real>(operation, exact)) value.emplace_back(static_cast<double>(x));
      return value;
    }
  return all.at(operation.name)(Reader<B>(arguments));
}

}  // namespace

Numbers reference(const Operation& operation, const Numbers& arguments) {
  Numbers numbers;
  for (const DoubleBall& x : result(operation, std::vector<DoubleBall>(arguments.begin(), arguments.end())))
    numbers.push_back(x.head());
  return numbers;
}

std::vector<Real> exact_result(const Operation& operation, const std::vector<Real>& arguments) {
  return result(operation, arguments);
}

}  // namespace liecheck::properties::conventions
