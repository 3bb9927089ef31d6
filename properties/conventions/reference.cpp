#include <conventions/reference.hpp>

#include <functional>
#include <map>
#include <oracles/ball_oracles.hpp>
#include <oracles/normalisation.hpp>

namespace liecheck::properties::conventions {
namespace {

using namespace oracles;

/// Reads values one after the other. B is a ball, which proves that a result is accurate, or a Real.
template <class B>
class Reader {
 public:
  explicit Reader(const std::vector<B>& numbers) : at_(numbers.data()) {}
  template <int R, int C = 1>
  oracles::Mat<R, C, B> take() {
    oracles::Mat<R, C, B> m;
    for (B& x : m.x) x = *at_++;
    return m;
  }
  PoseOf<B> pose() {
    const Mat3<B> R = take<3, 3>();
    return {R, take<3>()};
  }
  BodyOf<B> body() {
    const B mass = *at_++;
    const Vec3<B> c = take<3>();
    return {mass, c, take<3, 3>()};
  }

 private:
  const B* at_;
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
std::vector<B> joined(const T&... values) {
  std::vector<B> all;
  (append(all, values), ...);
  return all;
}

template <class B>
using Formulas = std::map<std::string_view, std::function<std::vector<B>(Reader<B>)>>;

template <class B>
Formulas<B> exponentials() {
  using Reader = conventions::Reader<B>;
  const auto numbers = [](const auto&... values) { return joined<B>(values...); };
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
  const auto numbers = [](const auto&... values) { return joined<B>(values...); };
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
  const auto numbers = [](const auto&... values) { return joined<B>(values...); };
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

template <class B>
std::vector<B> result(const Operation& operation, const std::vector<B>& arguments) {
  static const Formulas<B> all = [] {
    Formulas<B> f = exponentials<B>();
    f.merge(spatial_algebra<B>());
    f.merge(configurations<B>());
    return f;
  }();
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
