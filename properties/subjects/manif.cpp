// Subject "manif": SO3.h and SE3.h. Its tangent vectors are (rho, phi).

#if __has_include(<manif/SE3.h>) && __has_include(<tl/optional.hpp>)

#include <manif/SE3.h>
#include <manif/SO3.h>
#include <subjects/own_programs.hpp>
#include <subjects/typed.hpp>

namespace liecheck::properties {
namespace {

template <class S>
struct Manif : Types<S> {
  using typename Types<S>::V3, typename Types<S>::V4, typename Types<S>::V6, typename Types<S>::V7,
      typename Types<S>::M3, typename Types<S>::M6;
  using SO3 = ::manif::SO3<S>;
  using SE3 = ::manif::SE3<S>;
  using T3 = ::manif::SO3Tangent<S>;
  using T6 = ::manif::SE3Tangent<S>;

  static SE3 configuration(const V7& q) { return SE3(q); }
  static Pose<S> stored(const SE3& X) { return {X.rotation(), X.translation()}; }

  static TypedSubject<S> make() {
    TypedSubject<S> s{"manif", "headers", {}};
    auto& o = s.operations;
    o[op::exp3_quaternion] = [](const V3& phi) -> V4 { return T3(phi).exp().quat().coeffs(); };
    o[op::exp3_matrix] = [](const V3& phi) -> M3 { return T3(phi).exp().rotation(); };
    o[op::log3_quaternion] = [](const V4& Q) -> V3 { return SO3(Eigen::Quaternion<S>(Q)).log().coeffs(); };
    o[op::exp6] = [](const V6& xi) -> Pose<S> { return stored(T6(xi).exp()); };
    o[op::left_jacobian3] = [](const V3& phi) -> M3 { return T3(phi).ljac(); };
    o[op::right_jacobian3] = [](const V3& phi) -> M3 { return T3(phi).rjac(); };
    o[op::left_jacobian3_inverse] = [](const V3& phi) -> M3 { return T3(phi).ljacinv(); };
    o[op::right_jacobian3_inverse] = [](const V3& phi) -> M3 { return T3(phi).rjacinv(); };
    o[op::left_jacobian6] = [](const V6& xi) -> M6 { return T6(xi).ljac(); };
    o[op::right_jacobian6] = [](const V6& xi) -> M6 { return T6(xi).rjac(); };
    o[op::left_jacobian6_inverse] = [](const V6& xi) -> M6 { return T6(xi).ljacinv(); };
    o[op::right_jacobian6_inverse] = [](const V6& xi) -> M6 { return T6(xi).rjacinv(); };
    o[op::integrate] = [](const V7& q, const V6& d) -> V7 { return (configuration(q) + T6(d)).coeffs(); };
    o[op::difference] = [](const V7& a, const V7& b) -> V6 {
      return (configuration(b) - configuration(a)).coeffs();
    };
    return s;
  }
};

const Registered<float> in_float(Manif<float>::make());
const Registered<double> in_double(Manif<double>::make());

const RegisteredPrograms programs(
    "manif", {"-I MANIF -I TL_OPTIONAL",
              "#include <manif/SE3.h>\n"
              "#include <manif/SO3.h>\n",
              "",
              {{&op::exp3_quaternion, "manif::SO3Tangent<S>(phi).exp().quat().coeffs()"},
               {&op::exp3_matrix, "manif::SO3Tangent<S>(phi).exp().rotation()"},
               {&op::log3_quaternion, "manif::SO3<S>(Eigen::Quaternion<S>(Q)).log().coeffs()"},
               {&op::exp6, "manif::SE3Tangent<S>(xi).exp().transform()"},
               {&op::left_jacobian3, "manif::SO3Tangent<S>(phi).ljac()"},
               {&op::right_jacobian3, "manif::SO3Tangent<S>(phi).rjac()"},
               {&op::left_jacobian3_inverse, "manif::SO3Tangent<S>(phi).ljacinv()"},
               {&op::right_jacobian3_inverse, "manif::SO3Tangent<S>(phi).rjacinv()"},
               {&op::left_jacobian6, "manif::SE3Tangent<S>(xi).ljac()"},
               {&op::right_jacobian6, "manif::SE3Tangent<S>(xi).rjac()"},
               {&op::left_jacobian6_inverse, "manif::SE3Tangent<S>(xi).ljacinv()"},
               {&op::right_jacobian6_inverse, "manif::SE3Tangent<S>(xi).rjacinv()"},
               {&op::integrate, "(manif::SE3<S>(q0) + manif::SE3Tangent<S>(delta)).coeffs()"},
               {&op::difference, "(manif::SE3<S>(q1) - manif::SE3<S>(q0)).coeffs()"}}});

}  // namespace
}  // namespace liecheck::properties

#endif
