#include <conventions/reference.hpp>

#include <functional>
#include <map>
#include <oracles/ball_oracles.hpp>
#include <oracles/normalisation.hpp>
#include <oracles/orientations.hpp>

namespace liecheck::properties::conventions {
namespace {

using namespace oracles;

/// Reads values one after the other. B is a ball, which proves that a result is accurate, or a Real.
template <class B>
class Reader {
 public:
  explicit Reader(const std::vector<B>& numbers) : at_(numbers.data()), end_(at_ + numbers.size()) {}
  template <int R, int C = 1>
  oracles::Mat<R, C, B> take() {
    if (end_ - at_ < R * C) throw std::logic_error("too few numbers");
    oracles::Mat<R, C, B> m;
    for (B& x : m.x) x = *at_++;
    return m;
  }
  PoseOf<B> pose() {
    const Mat3<B> R = take<3, 3>();
    return {R, take<3>()};
  }
  BodyOf<B> body() {
    const B mass = take<1>()[0];
    const Vec3<B> c = take<3>();
    return {mass, c, take<3, 3>()};
  }

 private:
  const B *at_, *end_;
};

template <class B, int R, int C>
void append(std::vector<B>& to, const oracles::Mat<R, C, B>& m) {
  to.insert(to.end(), m.x.begin(), m.x.end());
}
template <class B>
void append(std::vector<B>& to, const B& x) {
  to.push_back(x);
}
template <class B>
void append(std::vector<B>& to, const BodyOf<B>& I) {
  append(to, I.mass), append(to, I.c), append(to, I.I_C);
}
template <class B, class... T>
std::vector<B> stacked(const T&... values) {
  std::vector<B> all;
  all.reserve(36);  // of the largest result
  (append(all, values), ...);
  return all;
}

template <class B>
using Formulas = std::map<std::string_view, std::function<std::vector<B>(Reader<B>)>>;

template <class B>
Formulas<B> exponentials() {
  using Reader = conventions::Reader<B>;
  const auto numbers = [](const auto&... values) { return stacked<B>(values...); };
  const auto jacobian3 = [=](auto f) {
    return [=](Reader x) { return numbers(f(stack(zero_vector<3, B>(), x.template take<3>())).J); };
  };
  const auto jacobian6 = [=](auto f) {
    return [=](Reader x) { return numbers(f(x.template take<6>()).matrix()); };
  };
  const auto left = [](const Vec6<B>& xi) { return left_jacobian_se3(xi); };
  const auto right = [](const Vec6<B>& xi) { return right_jacobian_se3(xi); };
  const auto left_inverse = [](const Vec6<B>& xi) { return left_jacobian_se3_inverse(xi); };
  const auto right_inverse = [](const Vec6<B>& xi) { return right_jacobian_se3_inverse(xi); };
  return {
      {"exp3_quaternion", [=](Reader x) { return numbers(exp_so3(x.template take<3>()).Q); }},
      {"exp3_matrix", [=](Reader x) { return numbers(rotation_matrix(exp_so3(x.template take<3>()).Q)); }},
      {"log3_quaternion", [=](Reader x) { return numbers(log_so3(x.template take<4>()).phi); }},
      {"log3_any_norm", [=](Reader x) { return numbers(log_so3(x.template take<4>()).phi); }},
      {"log3_matrix",
       [=](Reader x) { return numbers(log_se3_matrix(x.template take<3, 3>(), zero_vector<3, B>()).phi); }},
      {"exp6",
       [=](Reader x) {
         const ExpValue<B> e = exp_se3(x.template take<6>());
         return numbers(rotation_matrix(e.Q), e.p);
       }},
      {"log6",
       [=](Reader x) {
         const PoseOf<B> X = x.pose();
         return numbers(log_se3_matrix(X.R, X.p).value());
       }},
      {"left_jacobian3", jacobian3(left)},
      {"right_jacobian3", jacobian3(right)},
      {"left_jacobian3_inverse", jacobian3(left_inverse)},
      {"right_jacobian3_inverse", jacobian3(right_inverse)},
      {"left_jacobian6", jacobian6(left)},
      {"right_jacobian6", jacobian6(right)},
      {"left_jacobian6_inverse", jacobian6(left_inverse)},
      {"right_jacobian6_inverse", jacobian6(right_inverse)}};
}

template <class B>
Formulas<B> spatial_algebra() {
  using Reader = conventions::Reader<B>;
  const auto numbers = [](const auto&... values) { return stacked<B>(values...); };
  const auto moved = [=](auto f) {
    return [=](Reader x) {
      const PoseOf<B> X = x.pose();
      return numbers(f(X, x.template take<6>()));
    };
  };
  const auto crossed = [=](auto f) {
    return [=](Reader x) {
      const Vec6<B> V = x.template take<6>();
      return numbers(f(V, x.template take<6>()));
    };
  };
  const auto of_body = [=](auto f) {
    return [=](Reader x) {
      const BodyOf<B> I = x.body();
      return numbers(f(I, x.template take<6>()));
    };
  };
  const auto moved_body = [=](auto f) {
    return [=](Reader x) {
      const PoseOf<B> X = x.pose();
      return numbers(f(X, x.body()));
    };
  };
  return {{"compose",
           [=](Reader x) {
             const PoseOf<B> X = x.pose(), Y = x.pose();
             return numbers(X.R * Y.R, X.R * Y.p + X.p);
           }},
          {"inverse",
           [=](Reader x) {
             const PoseOf<B> X = x.pose();
             return numbers(transpose(X.R), -(transpose(X.R) * X.p));
           }},
          {"act_point",
           [=](Reader x) {
             const PoseOf<B> X = x.pose();
             return numbers(X.R * x.template take<3>() + X.p);
           }},
          {"act_motion", moved(formulas::act_motion<B>)},
          {"act_inverse_motion", moved(formulas::act_inverse_motion<B>)},
          {"act_force", moved(formulas::act_force<B>)},
          {"act_inverse_force", moved(formulas::act_inverse_force<B>)},
          {"cross_motion", crossed(formulas::cross_motion<B>)},
          {"cross_force", crossed(formulas::cross_force<B>)},
          {"act_inertia", moved_body(formulas::act_inertia<B>)},
          {"act_inverse_inertia", moved_body(formulas::act_inverse_inertia<B>)},
          {"momentum", of_body(formulas::momentum<B>)},
          {"kinetic_energy", of_body(formulas::kinetic_energy<B>)},
          {"inertia_matrix", [=](Reader x) { return numbers(formulas::inertia_matrix(x.body())); }}};
}

template <class B>
Formulas<B> configurations() {
  using Reader = conventions::Reader<B>;
  const auto numbers = [](const auto&... values) { return stacked<B>(values...); };
  const auto rotated = [=](Reader x) {
    const Quaternion<B> Q = x.template take<4>();
    return numbers(rotate(Q, x.template take<3>()));
  };
  const auto plus = [=](Reader x) {
    const Vec7<B> q = x.template take<7>();
    const IntegrateValue<B> v = oracles::integrate(q, x.template take<6>());
    return numbers(v.p, v.Q);
  };
  const auto minus = [=](Reader x) {
    const Vec7<B> q0 = x.template take<7>();
    return numbers(oracles::difference(q0, x.template take<7>()).value());
  };
  const auto minus_by_q1 = [=](Reader x) {
    const Vec7<B> q0 = x.template take<7>();
    return numbers(oracles::d_difference_arg1(q0, x.template take<7>()).matrix());
  };
  return {{"rotate_point", rotated},
          {"rotate_point_any_norm", rotated},
          {"integrate", plus},
          {"integrate_any_norm", plus},
          {"difference", minus},
          {"difference_any_norm", minus},
          {"d_integrate_arg0",
           [=](Reader x) {
             const Vec7<B> q = x.template take<7>();
             return numbers(oracles::d_integrate_arg0(q, x.template take<6>()).matrix());
           }},
          {"d_integrate_arg1",
           [=](Reader x) {
             const Vec7<B> q = x.template take<7>();
             return numbers(oracles::d_integrate_arg1(q, x.template take<6>()).matrix());
           }},
          {"d_difference_arg0",
           [=](Reader x) {
             const Vec7<B> q0 = x.template take<7>();
             return numbers(oracles::d_difference_arg0(q0, x.template take<7>()).matrix());
           }},
          {"d_difference_arg1", minus_by_q1},
          {"d_difference_any_norm", minus_by_q1},
          {"integrate_coefficient_jacobian",
           [=](Reader x) {
             return numbers(oracles::integrate_coefficient_jacobian(x.template take<7>()).value);
           }},
          {"normalize", [=](Reader x) { return numbers(oracles::normalize(x.template take<4>()).value); }},
          {"first_order_normalize",
           [=](Reader x) { return numbers(oracles::first_order_normalize(x.template take<4>()).value); }},
          {"quaternion_matrix",
           [=](Reader x) { return numbers(oracles::quaternion_matrix(x.template take<4>()).value); }}};
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
/// Between rotations and directions, Euler angles and rates: only in Real.
Formulas<Real> orientations() {
  using Reader = conventions::Reader<Real>;
  const auto numbers = [](const auto&... values) { return stacked<Real>(values...); };
  return {{"relative_angle",
           [=](Reader x) {
             const Quaternion<> Q0 = x.take<4>();
             return numbers(oracles::relative_angle(Q0, x.take<4>()).theta);
           }},
          {"twist_angle",
           [=](Reader x) {
             const Quaternion<> Q = x.take<4>();
             return numbers(oracles::twist_angle(Q, x.take<3>()).angle);
           }},
          {"slerp",
           [=](Reader x) {
             const Quaternion<> Q0 = x.take<4>(), Q1 = x.take<4>();
             return numbers(oracles::slerp(Q0, Q1, x.take<1>()[0]).Q);
           }},
          {"rotation_between",
           [=](Reader x) {
             const Vec3<Real> u = x.take<3>(), v = x.take<3>(), from = Real(1 / norm(u)) * u,
                              to = Real(1 / norm(v)) * v, n = cross(from, to);
             const Real w(1 + dot(from, to));
             if (w + norm(n) < Real(1e-40))  // opposite, but for rounding: about any axis perpendicular to u
               return numbers(normalized(abs(u[0]) > abs(u[2])
                                             ? Quaternion<>{{Real(-u[1]), u[0], Real(0), Real(0)}}
                                             : Quaternion<>{{Real(0), Real(-u[2]), u[1], Real(0)}}));
             return numbers(normalized(Quaternion<>{{n[0], n[1], n[2], w}}));
           }},
          {"euler_to_quaternion",
           [=](Reader x) {
             const Order order(static_cast<int>(x.take<1>()[0]));
             return numbers(euler(order, x.take<3>()).value);
           }},
          {"euler_to_matrix",
           [=](Reader x) {
             const Order order(static_cast<int>(x.take<1>()[0]));
             return numbers(rotation_matrix(euler(order, x.take<3>()).value));
           }},
          {"euler_from_quaternion",
           [=](Reader x) {
             const Order order(static_cast<int>(x.take<1>()[0]));
             return numbers(angles_of(order, rotation_matrix(normalized(x.take<4>()))));
           }},
          {"euler_from_matrix",
           [=](Reader x) {
             const Order order(static_cast<int>(x.take<1>()[0]));
             return numbers(angles_of(order, x.take<3, 3>()));
           }},
          {"velocity_to_rate",
           [=](Reader x) {
             const Quaternion<> Q = quaternion_of(x.take<7>());
             const Vec3<Real> u = x.take<3>(), omega = x.take<3>();
             return numbers(rotate(Q, u),
                            Real(Real(1) / 2) *
                                quaternion_product(Q, Quaternion<>{{omega[0], omega[1], omega[2], Real(0)}}));
           }},
          {"rate_to_velocity", [=](Reader x) {
             const Quaternion<> Q = quaternion_of(x.take<7>());
             const Vec3<Real> p_dot = x.take<3>();
             return numbers(rotate(Q, p_dot, true),
                            Real(2 / squared_norm(Q)) * head3(conjugate_product(Q, x.take<4>())));
           }}};
}
Formulas<Real> planar_poses() {
  using Reader = conventions::Reader<Real>;
  const auto numbers = [](const auto&... values) { return stacked<Real>(values...); };
  const auto of_log = [=](const LogResult& log) { return numbers(log.rho[0], log.rho[1], log.phi[2]); };
  return {{"se2_exp", [=](Reader x) { return numbers(planar_exp(x.take<3>()).value); }},
          {"se2_log",
           [=](Reader x) {
             return of_log(planar_difference({{Real(0), Real(0), Real(1), Real(0)}}, x.take<4>()));
           }},
          {"se2_compose",
           [=](Reader x) {
             const PlanarPose q0 = x.take<4>();
             return numbers(planar_compose(q0, x.take<4>()).value);
           }},
          {"se2_integrate",
           [=](Reader x) {
             const PlanarPose q0 = x.take<4>();
             return numbers(planar_compose(q0, planar_exp(x.take<3>()).value).value);
           }},
          {"se2_difference", [=](Reader x) {
             const PlanarPose q0 = x.take<4>();
             return of_log(planar_difference(q0, x.take<4>()));
           }}};
}

template <class B>
std::vector<B> result(const Operation& operation, const std::vector<B>& arguments) {
  static const Formulas<B> all = [] {
    Formulas<B> f = exponentials<B>();
    f.merge(spatial_algebra<B>());
    f.merge(configurations<B>());
    if constexpr (std::is_same_v<B, Real>) f.merge(orientations()), f.merge(planar_poses());
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
