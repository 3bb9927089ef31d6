// smooth: so3.hpp and se3.hpp, tangents (v, w), storage [x y z, x y z w].

#include <subjects/subject.hpp>

#if !__has_include(<smooth/se3.hpp>)

namespace liecheck::properties {
namespace {
const RegisteredAbsent absent("smooth");
}
}  // namespace liecheck::properties

#else

#include <smooth/se3.hpp>
#include <smooth/so3.hpp>

namespace liecheck::properties {
namespace {

template <class S>
struct Smooth {
  using O = Operations<S>;
  using V3 = typename O::V3;
  using V4 = typename O::V4;
  using V6 = typename O::V6;
  using V7 = typename O::V7;
  using M3 = typename O::M3;
  using M6 = typename O::M6;
  using SO3 = ::smooth::SO3<S>;
  using SE3 = ::smooth::SE3<S>;

  /// Of the numbers as they are: nothing is normalised.
  static SE3 configuration(const V7& q) {
    SE3 X;
    X.coeffs() = q;
    return X;
  }

  static Subject<S> make() {
    Subject<S> s;
    s.name = "smooth";
    s.version = "headers";
    O& o = s.operations;
    o.exp3_quaternion = [](const V3& phi) -> V4 { return SO3::exp(phi).coeffs(); };
    o.exp3_matrix = [](const V3& phi) -> M3 { return SO3::exp(phi).matrix(); };
    o.log3_quaternion = [](const V4& Q) -> V3 {
      SO3 X;
      X.coeffs() = Q;
      return X.log();
    };
    o.exp6 = [](const V6& xi) -> Pose<S> {
      const SE3 X = SE3::exp(xi);
      return {X.so3().matrix(), X.r3()};
    };
    o.left_jacobian3 = [](const V3& phi) -> M3 { return SO3::dl_exp(phi); };
    o.right_jacobian3 = [](const V3& phi) -> M3 { return SO3::dr_exp(phi); };
    o.left_jacobian3_inverse = [](const V3& phi) -> M3 { return SO3::dl_expinv(phi); };
    o.right_jacobian3_inverse = [](const V3& phi) -> M3 { return SO3::dr_expinv(phi); };
    o.left_jacobian6 = [](const V6& xi) -> M6 { return SE3::dl_exp(xi); };
    o.right_jacobian6 = [](const V6& xi) -> M6 { return SE3::dr_exp(xi); };
    o.left_jacobian6_inverse = [](const V6& xi) -> M6 { return SE3::dl_expinv(xi); };
    o.right_jacobian6_inverse = [](const V6& xi) -> M6 { return SE3::dr_expinv(xi); };
    o.integrate = [](const V7& q, const V6& d) -> V7 { return (configuration(q) + d).coeffs(); };
    o.difference = [](const V7& a, const V7& b) -> V6 { return configuration(b) - configuration(a); };
    return s;
  }
};

const Registered<float> in_float(Smooth<float>::make());
const Registered<double> in_double(Smooth<double>::make());

}  // namespace
}  // namespace liecheck::properties

#endif
