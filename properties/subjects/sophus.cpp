// Subject "sophus": so3.hpp and se3.hpp. A failed SOPHUS_ENSURE throws an exception here.

#if __has_include(<sophus/se3.hpp>)

#define SOPHUS_ENABLE_ENSURE_HANDLER
#include <sophus/se3.hpp>
#include <stdexcept>
#include <subjects/own_programs.hpp>
#include <subjects/typed.hpp>

namespace Sophus {
void ensureFailed(char const* function, char const*, int, char const* description) {
  throw std::invalid_argument(std::string("Sophus: ") + function + ": " + description);
}
}  // namespace Sophus

namespace liecheck::properties {
namespace {

template <class S>
struct SophusGroups : Types<S> {
  using typename Types<S>::V3, typename Types<S>::V4, typename Types<S>::V6, typename Types<S>::V7,
      typename Types<S>::M3, typename Types<S>::M6;
  using SO3 = ::Sophus::SO3<S>;
  using SE3 = ::Sophus::SE3<S>;

  static SO3 rotation(const V4& Q) { return SO3(Eigen::Quaternion<S>(Q)); }
  static SE3 configuration(const V7& q) { return {rotation(q.template tail<4>()), q.template head<3>()}; }
  static Pose<S> stored(const SE3& X) { return {X.rotationMatrix(), X.translation()}; }

  static TypedSubject<S> make() {
    TypedSubject<S> s{"sophus", "headers", {}};
    auto& o = s.operations;
    o[op::exp3_quaternion] = [](const V3& phi) -> V4 { return SO3::exp(phi).unit_quaternion().coeffs(); };
    o[op::exp3_matrix] = [](const V3& phi) -> M3 { return SO3::exp(phi).matrix(); };
    o[op::log3_quaternion] = [](const V4& Q) -> V3 { return rotation(Q).log(); };
    o[op::log3_matrix] = [](const M3& R) -> V3 { return SO3(R).log(); };
    o[op::exp6] = [](const V6& xi) -> Pose<S> { return stored(SE3::exp(xi)); };
    o[op::log6] = [](const Pose<S>& T) -> V6 { return SE3(T.R, T.p).log(); };
    o[op::left_jacobian3] = [](const V3& phi) -> M3 { return SO3::leftJacobian(phi); };
    o[op::left_jacobian3_inverse] = [](const V3& phi) -> M3 { return SO3::leftJacobianInverse(phi); };
    o[op::right_jacobian3] = [](const V3& phi) -> M3 { return SO3::leftJacobian(V3(-phi)); };
    o[op::right_jacobian3_inverse] = [](const V3& phi) -> M3 { return SO3::leftJacobianInverse(V3(-phi)); };
    o[op::left_jacobian6] = [](const V6& xi) -> M6 { return SE3::leftJacobian(xi); };
    o[op::left_jacobian6_inverse] = [](const V6& xi) -> M6 { return SE3::leftJacobianInverse(xi); };
    o[op::right_jacobian6] = [](const V6& xi) -> M6 { return SE3::leftJacobian(V6(-xi)); };
    o[op::right_jacobian6_inverse] = [](const V6& xi) -> M6 { return SE3::leftJacobianInverse(V6(-xi)); };
    o[op::integrate] = [](const V7& q, const V6& d) -> V7 {
      const SE3 T = configuration(q) * SE3::exp(d);
      V7 r;
      r << T.translation(), T.unit_quaternion().coeffs();
      return r;
    };
    o[op::difference] = [](const V7& a, const V7& b) -> V6 {
      return (configuration(a).inverse() * configuration(b)).log();
    };
    o[op::rotate_point] = [](const V4& Q, const V3& x) -> V3 { return rotation(Q) * x; };
    return s;
  }
};

const Registered<float> in_float(SophusGroups<float>::make());
const Registered<double> in_double(SophusGroups<double>::make());

const RegisteredPrograms programs(
    "sophus",
    {"-I SOPHUS",
     "#include <sophus/se3.hpp>\n",
     "",
     {{&op::exp3_quaternion, "Sophus::SO3<S>::exp(phi).unit_quaternion().coeffs()"},
      {&op::exp3_matrix, "Sophus::SO3<S>::exp(phi).matrix()"},
      {&op::log3_quaternion, "Sophus::SO3<S>(Eigen::Quaternion<S>(Q)).log()"},
      {&op::log3_matrix, "Sophus::SO3<S>(R).log()"},
      {&op::exp6, "Sophus::SE3<S>::exp(xi).matrix3x4()"},
      {&op::log6, "Sophus::SE3<S>(R, p).log()"},
      {&op::left_jacobian3, "Sophus::SO3<S>::leftJacobian(phi)"},
      {&op::left_jacobian3_inverse, "Sophus::SO3<S>::leftJacobianInverse(phi)"},
      {&op::right_jacobian3, "Sophus::SO3<S>::leftJacobian(Eigen::Matrix<S, 3, 1>(-phi))"},
      {&op::right_jacobian3_inverse, "Sophus::SO3<S>::leftJacobianInverse(Eigen::Matrix<S, 3, 1>(-phi))"},
      {&op::left_jacobian6, "Sophus::SE3<S>::leftJacobian(xi)"},
      {&op::left_jacobian6_inverse, "Sophus::SE3<S>::leftJacobianInverse(xi)"},
      {&op::right_jacobian6, "Sophus::SE3<S>::leftJacobian(Eigen::Matrix<S, 6, 1>(-xi))"},
      {&op::right_jacobian6_inverse, "Sophus::SE3<S>::leftJacobianInverse(Eigen::Matrix<S, 6, 1>(-xi))"},
      {&op::integrate,
       "const Sophus::SE3<S> T = Sophus::SE3<S>(Eigen::Quaternion<S>(q0.tail<4>()), q0.head<3>()) * "
       "Sophus::SE3<S>::exp(delta);\nstd::cout << T.translation() << '\\n' << T.unit_quaternion().coeffs() "
       "<< '\\n';"},
      {&op::difference,
       "(Sophus::SE3<S>(Eigen::Quaternion<S>(q0.tail<4>()), q0.head<3>()).inverse() * "
       "Sophus::SE3<S>(Eigen::Quaternion<S>(q1.tail<4>()), q1.head<3>())).log()"},
      {&op::rotate_point, "Sophus::SO3<S>(Eigen::Quaternion<S>(Q)) * p"}}});

}  // namespace
}  // namespace liecheck::properties

#endif
