#include <conventions/reference.hpp>

#include <functional>
#include <map>
#include <oracles/ball_oracles.hpp>
#include <oracles/normalisation.hpp>

namespace liecheck::properties::conventions {
namespace {

using namespace oracles;
using B = DoubleBall;

/// Reads values one after the other.
class Reader {
 public:
  explicit Reader(const Numbers& numbers) : at_(numbers.data()) {}
  template <int R, int C = 1>
  oracles::Mat<R, C, B> take() {
    oracles::Mat<R, C, B> m;
    for (B& x : m.x) x = B(*at_++);
    return m;
  }
  PoseOf<B> pose() {
    const Mat3<B> R = take<3, 3>();
    return {R, take<3>()};
  }
  BodyOf<B> body() {
    const B mass(*at_++);
    const Vec3<B> c = take<3>();
    return {mass, c, take<3, 3>()};
  }

 private:
  const double* at_;
};

template <int R, int C>
void append(Numbers& to, const oracles::Mat<R, C, B>& m) {
  for (const B& x : m.x) to.push_back(x.head());
}
void append(Numbers& to, const B& x) {
  to.push_back(x.head());
}
void append(Numbers& to, const BodyOf<B>& I) {
  append(to, I.mass), append(to, I.c), append(to, I.I_C);
}
template <class... T>
Numbers numbers(const T&... values) {
  Numbers all;
  (append(all, values), ...);
  return all;
}

using Formula = std::function<Numbers(Reader)>;
using Formulas = std::map<std::string_view, Formula>;

Formulas exponentials() {
  const auto jacobian3 = [](auto f) {
    return [f](Reader x) { return numbers(f(stack(zero_vector<3, B>(), x.take<3>())).J); };
  };
  const auto jacobian6 = [](auto f) { return [f](Reader x) { return numbers(f(x.take<6>()).matrix()); }; };
  const auto left = [](const Vec6<B>& xi) { return left_jacobian_se3(xi); };
  const auto right = [](const Vec6<B>& xi) { return right_jacobian_se3(xi); };
  const auto left_inverse = [](const Vec6<B>& xi) { return left_jacobian_se3_inverse(xi); };
  const auto right_inverse = [](const Vec6<B>& xi) { return right_jacobian_se3_inverse(xi); };
  return {{"exp3_quaternion", [](Reader x) { return numbers(exp_so3(x.take<3>()).Q); }},
          {"exp3_matrix", [](Reader x) { return numbers(rotation_matrix(exp_so3(x.take<3>()).Q)); }},
          {"log3_quaternion", [](Reader x) { return numbers(log_so3(x.take<4>()).phi); }},
          {"log3_any_norm", [](Reader x) { return numbers(log_so3(x.take<4>()).phi); }},
          {"log3_matrix",
           [](Reader x) { return numbers(log_se3_matrix(x.take<3, 3>(), zero_vector<3, B>()).phi); }},
          {"exp6",
           [](Reader x) {
             const ExpValue<B> e = exp_se3(x.take<6>());
             return numbers(rotation_matrix(e.Q), e.p);
           }},
          {"log6",
           [](Reader x) {
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

Formulas spatial_algebra() {
  const auto moved = [](auto f) {
    return [f](Reader x) {
      const PoseOf<B> X = x.pose();
      return numbers(f(X, x.take<6>()));
    };
  };
  const auto crossed = [](auto f) {
    return [f](Reader x) {
      const Vec6<B> V = x.take<6>();
      return numbers(f(V, x.take<6>()));
    };
  };
  const auto of_body = [](auto f) {
    return [f](Reader x) {
      const BodyOf<B> I = x.body();
      return numbers(f(I, x.take<6>()));
    };
  };
  const auto moved_body = [](auto f) {
    return [f](Reader x) {
      const PoseOf<B> X = x.pose();
      return numbers(f(X, x.body()));
    };
  };
  return {{"compose",
           [](Reader x) {
             const PoseOf<B> X = x.pose(), Y = x.pose();
             return numbers(X.R * Y.R, X.R * Y.p + X.p);
           }},
          {"inverse",
           [](Reader x) {
             const PoseOf<B> X = x.pose();
             return numbers(transpose(X.R), -(transpose(X.R) * X.p));
           }},
          {"act_point",
           [](Reader x) {
             const PoseOf<B> X = x.pose();
             return numbers(X.R * x.take<3>() + X.p);
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
          {"inertia_matrix", [](Reader x) { return numbers(formulas::inertia_matrix(x.body())); }}};
}

Formulas configurations() {
  const auto rotated = [](Reader x) {
    const Quaternion<B> Q = x.take<4>();
    return numbers(rotate(Q, x.take<3>()));
  };
  const auto plus = [](Reader x) {
    const Vec7<B> q = x.take<7>();
    const IntegrateValue<B> v = oracles::integrate(q, x.take<6>());
    return numbers(v.p, v.Q);
  };
  const auto minus = [](Reader x) {
    const Vec7<B> q0 = x.take<7>();
    return numbers(oracles::difference(q0, x.take<7>()).value());
  };
  const auto minus_by_q1 = [](Reader x) {
    const Vec7<B> q0 = x.take<7>();
    return numbers(oracles::d_difference_arg1(q0, x.take<7>()).matrix());
  };
  return {
      {"rotate_point", rotated},
      {"rotate_point_any_norm", rotated},
      {"integrate", plus},
      {"integrate_any_norm", plus},
      {"difference", minus},
      {"difference_any_norm", minus},
      {"d_integrate_arg0",
       [](Reader x) {
         const Vec7<B> q = x.take<7>();
         return numbers(oracles::d_integrate_arg0(q, x.take<6>()).matrix());
       }},
      {"d_integrate_arg1",
       [](Reader x) {
         const Vec7<B> q = x.take<7>();
         return numbers(oracles::d_integrate_arg1(q, x.take<6>()).matrix());
       }},
      {"d_difference_arg0",
       [](Reader x) {
         const Vec7<B> q0 = x.take<7>();
         return numbers(oracles::d_difference_arg0(q0, x.take<7>()).matrix());
       }},
      {"d_difference_arg1", minus_by_q1},
      {"d_difference_any_norm", minus_by_q1},
      {"integrate_coefficient_jacobian",
       [](Reader x) { return numbers(oracles::integrate_coefficient_jacobian(x.take<7>()).value); }},
      {"normalize", [](Reader x) { return numbers(oracles::normalize(x.take<4>()).value); }},
      {"first_order_normalize",
       [](Reader x) { return numbers(oracles::first_order_normalize(x.take<4>()).value); }},
      {"quaternion_matrix", [](Reader x) { return numbers(oracles::quaternion_matrix(x.take<4>()).value); }}};
}

}  // namespace

Numbers reference(const Operation& operation, const Numbers& arguments) {
  static const Formulas all = [] {
    Formulas f = exponentials();
    f.merge(spatial_algebra());
    f.merge(configurations());
    return f;
  }();
  return all.at(operation.name)(Reader(arguments));
}

}  // namespace liecheck::properties::conventions
