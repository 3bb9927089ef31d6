// Subject "smooth": so3.hpp and se3.hpp. Its tangent vectors are (v, w); it stores poses as [x y z, x y z w].

#include <subjects/typed.hpp>

#if __has_include(<smooth/se3.hpp>)

#include <smooth/se3.hpp>
#include <smooth/so3.hpp>
#include <subjects/own_programs.hpp>

namespace liecheck::properties {
namespace {

template <class S>
struct Smooth {
  using SO3 = ::smooth::SO3<S>;
  using SE3 = ::smooth::SE3<S>;

  /// Copies the numbers and normalises nothing.
  static SE3 configuration(const Vec<S, 7>& q) {
    SE3 X;
    X.coeffs() = q;
    return X;
  }

  static TypedSubject<S> make() {
    TypedSubject<S> s{"smooth", "headers", {}};
    auto& o = s.operations;
    o[op::exp3_quaternion] = [](const Vec<S, 3>& phi) -> Vec<S, 4> { return SO3::exp(phi).coeffs(); };
    o[op::exp3_matrix] = [](const Vec<S, 3>& phi) -> Mat<S, 3> { return SO3::exp(phi).matrix(); };
    o[op::log3_quaternion] = [](const Vec<S, 4>& Q) -> Vec<S, 3> {
      SO3 X;
      X.coeffs() = Q;
      return X.log();
    };
    o[op::exp6] = [](const Vec<S, 6>& xi) -> Pose<S> {
      const SE3 X = SE3::exp(xi);
      return {X.so3().matrix(), X.r3()};
    };
    o[op::left_jacobian3] = [](const Vec<S, 3>& phi) -> Mat<S, 3> { return SO3::dl_exp(phi); };
    o[op::right_jacobian3] = [](const Vec<S, 3>& phi) -> Mat<S, 3> { return SO3::dr_exp(phi); };
    o[op::left_jacobian3_inverse] = [](const Vec<S, 3>& phi) -> Mat<S, 3> { return SO3::dl_expinv(phi); };
    o[op::right_jacobian3_inverse] = [](const Vec<S, 3>& phi) -> Mat<S, 3> { return SO3::dr_expinv(phi); };
    o[op::left_jacobian6] = [](const Vec<S, 6>& xi) -> Mat<S, 6> { return SE3::dl_exp(xi); };
    o[op::right_jacobian6] = [](const Vec<S, 6>& xi) -> Mat<S, 6> { return SE3::dr_exp(xi); };
    o[op::left_jacobian6_inverse] = [](const Vec<S, 6>& xi) -> Mat<S, 6> { return SE3::dl_expinv(xi); };
    o[op::right_jacobian6_inverse] = [](const Vec<S, 6>& xi) -> Mat<S, 6> { return SE3::dr_expinv(xi); };
    o[op::integrate] = [](const Vec<S, 7>& q, const Vec<S, 6>& d) -> Vec<S, 7> {
      return (configuration(q) + d).coeffs();
    };
    o[op::difference] = [](const Vec<S, 7>& a, const Vec<S, 7>& b) -> Vec<S, 6> {
      return configuration(b) - configuration(a);
    };
    return s;
  }
};

const Registered<float> in_float(Smooth<float>::make());
const Registered<double> in_double(Smooth<double>::make());

const RegisteredPrograms programs(
    "smooth",
    {"-I SMOOTH",
     "#include <smooth/se3.hpp>\n"
     "#include <smooth/so3.hpp>\n",
     "",
     {{&op::exp3_quaternion, "smooth::SO3<S>::exp(phi).coeffs()"},
      {&op::exp3_matrix, "smooth::SO3<S>::exp(phi).matrix()"},
      {&op::log3_quaternion, "smooth::SO3<S> X;\nX.coeffs() = Q;\nstd::cout << X.log() << '\\n';"},
      {&op::exp6, "smooth::SE3<S>::exp(xi).matrix()"},
      {&op::left_jacobian3, "smooth::SO3<S>::dl_exp(phi)"},
      {&op::right_jacobian3, "smooth::SO3<S>::dr_exp(phi)"},
      {&op::left_jacobian3_inverse, "smooth::SO3<S>::dl_expinv(phi)"},
      {&op::right_jacobian3_inverse, "smooth::SO3<S>::dr_expinv(phi)"},
      {&op::left_jacobian6, "smooth::SE3<S>::dl_exp(xi)"},
      {&op::right_jacobian6, "smooth::SE3<S>::dr_exp(xi)"},
      {&op::left_jacobian6_inverse, "smooth::SE3<S>::dl_expinv(xi)"},
      {&op::right_jacobian6_inverse, "smooth::SE3<S>::dr_expinv(xi)"},
      {&op::integrate, "smooth::SE3<S> X;\nX.coeffs() = q0;\nstd::cout << (X + delta).coeffs() << '\\n';"},
      {&op::difference,
       "smooth::SE3<S> X, Y;\nX.coeffs() = q0, Y.coeffs() = q1;\nstd::cout << Y - X << '\\n';"}}});

}  // namespace
}  // namespace liecheck::properties

#endif
