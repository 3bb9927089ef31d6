// Subject "pinocchio": spatial/explog.hpp and the free-flyer's Lie group. It has liecheck's conventions.

#if __has_include(<pinocchio/spatial/explog.hpp>) && __has_include(<pinocchio/config.hpp>)

#include <pinocchio/fwd.hpp>  // before Boost's headers

#include <pinocchio/multibody/liegroup/special-euclidean.hpp>
#include <pinocchio/spatial/explog-quaternion.hpp>
#include <pinocchio/spatial/explog.hpp>
#include <pinocchio/spatial/force.hpp>
#include <pinocchio/spatial/motion.hpp>
#include <subjects/own_programs.hpp>
#include <subjects/typed.hpp>

namespace liecheck::properties {
namespace {

template <class S>
struct Pinocchio : Types<S> {
  using typename Types<S>::V3, typename Types<S>::V4, typename Types<S>::V6, typename Types<S>::V7,
      typename Types<S>::M3, typename Types<S>::M6;
  using SE3 = ::pinocchio::SE3Tpl<S>;
  using Motion = ::pinocchio::MotionTpl<S>;
  using Force = ::pinocchio::ForceTpl<S>;
  using Group = ::pinocchio::SpecialEuclideanOperationTpl<3, S>;
  using Quaternion = Eigen::Quaternion<S>;

  static SE3 pose(const Pose<S>& X) { return {X.R, X.p}; }
  static Pose<S> stored(const SE3& X) { return {X.rotation(), X.translation()}; }
  static Eigen::Map<const Quaternion> quaternion(const V4& Q) {
    return Eigen::Map<const Quaternion>(Q.data());
  }
  /// Calls f(r), which fills r, and returns r.
  template <class R, class F>
  static R filled(F f) {
    R r = R::Zero();
    f(r);
    return r;
  }

  static TypedSubject<S> make() {
    TypedSubject<S> s{"pinocchio", PINOCCHIO_VERSION, {}};
    auto& o = s.operations;
    o[op::exp3_quaternion] = [](const V3& phi) -> V4 {
      Quaternion q;
      ::pinocchio::quaternion::exp3(phi, q);
      return q.coeffs();
    };
    o[op::exp3_matrix] = [](const V3& phi) -> M3 { return ::pinocchio::exp3(phi); };
    o[op::log3_quaternion] = [](const V4& Q) -> V3 { return ::pinocchio::quaternion::log3(quaternion(Q)); };
    o[op::log3_matrix] = [](const M3& R) -> V3 { return ::pinocchio::log3(R); };
    o[op::exp6] = [](const V6& xi) -> Pose<S> { return stored(::pinocchio::exp6(xi)); };
    o[op::log6] = [](const Pose<S>& T) -> V6 { return ::pinocchio::log6(pose(T)).toVector(); };
    o[op::right_jacobian3] = [](const V3& phi) -> M3 {
      return filled<M3>([&](M3& J) { ::pinocchio::Jexp3(phi, J); });
    };
    o[op::right_jacobian3_inverse] = [](const V3& phi) -> M3 {
      return filled<M3>([&](M3& J) { ::pinocchio::Jlog3(S(phi.norm()), phi, J); });
    };
    o[op::right_jacobian6] = [](const V6& xi) -> M6 {
      return filled<M6>([&](M6& J) { ::pinocchio::Jexp6(Motion(xi), J); });
    };
    o[op::integrate] = [](const V7& q, const V6& d) -> V7 {
      return filled<V7>([&](V7& r) { Group().integrate(q, d, r); });
    };
    o[op::difference] = [](const V7& a, const V7& b) -> V6 {
      return filled<V6>([&](V6& r) { Group().difference(a, b, r); });
    };
    o[op::d_integrate_arg0] = [](const V7& q, const V6& d) -> M6 {
      return filled<M6>([&](M6& J) { Group().dIntegrate_dq(q, d, J); });
    };
    o[op::d_integrate_arg1] = [](const V7& q, const V6& d) -> M6 {
      return filled<M6>([&](M6& J) { Group().dIntegrate_dv(q, d, J); });
    };
    o[op::d_difference_arg0] = [](const V7& a, const V7& b) -> M6 {
      return filled<M6>([&](M6& J) { Group().dDifference(a, b, J, ::pinocchio::ARG0); });
    };
    o[op::d_difference_arg1] = [](const V7& a, const V7& b) -> M6 {
      return filled<M6>([&](M6& J) { Group().dDifference(a, b, J, ::pinocchio::ARG1); });
    };
    o[op::compose] = [](const Pose<S>& X, const Pose<S>& Y) -> Pose<S> { return stored(pose(X) * pose(Y)); };
    o[op::inverse] = [](const Pose<S>& X) -> Pose<S> { return stored(pose(X).inverse()); };
    o[op::act_point] = [](const Pose<S>& X, const V3& x) -> V3 { return pose(X).act(x); };
    o[op::rotate_point] = [](const V4& Q, const V3& x) -> V3 { return quaternion(Q) * x; };
    o[op::act_motion] = [](const Pose<S>& X, const V6& V) -> V6 { return pose(X).act(Motion(V)).toVector(); };
    o[op::act_inverse_motion] = [](const Pose<S>& X, const V6& V) -> V6 {
      return pose(X).actInv(Motion(V)).toVector();
    };
    o[op::act_force] = [](const Pose<S>& X, const V6& F) -> V6 { return pose(X).act(Force(F)).toVector(); };
    o[op::act_inverse_force] = [](const Pose<S>& X, const V6& F) -> V6 {
      return pose(X).actInv(Force(F)).toVector();
    };
    o[op::cross_motion] = [](const V6& V, const V6& W) -> V6 {
      return Motion(V).cross(Motion(W)).toVector();
    };
    o[op::cross_force] = [](const V6& V, const V6& F) -> V6 { return Motion(V).cross(Force(F)).toVector(); };
    return s;
  }
};

const Registered<float> in_float(Pinocchio<float>::make());
const Registered<double> in_double(Pinocchio<double>::make());

const RegisteredPrograms programs(
    "pinocchio",
    {"$(pkg-config --cflags --libs pinocchio)",
     "#include <pinocchio/multibody/liegroup/special-euclidean.hpp>\n"
     "#include <pinocchio/spatial/explog-quaternion.hpp>\n"
     "#include <pinocchio/spatial/explog.hpp>\n"
     "#include <pinocchio/spatial/force.hpp>\n"
     "#include <pinocchio/spatial/motion.hpp>\n",
     "",
     {{&op::exp3_quaternion,
       "Eigen::Quaternion<S> Q;\npinocchio::quaternion::exp3(phi, Q);\nstd::cout << Q.coeffs() << '\\n';"},
      {&op::exp3_matrix, "pinocchio::exp3(phi)"},
      {&op::log3_quaternion, "pinocchio::quaternion::log3(Eigen::Quaternion<S>(Q))"},
      {&op::log3_matrix, "pinocchio::log3(R)"},
      {&op::exp6, "pinocchio::exp6(xi).toHomogeneousMatrix()"},
      {&op::log6, "pinocchio::log6(pinocchio::SE3Tpl<S>(R, p)).toVector()"},
      {&op::right_jacobian3,
       "Eigen::Matrix<S, 3, 3> J = Eigen::Matrix<S, 3, 3>::Zero();\npinocchio::Jexp3(phi, J);\nstd::cout << "
       "J << '\\n';"},
      {&op::right_jacobian3_inverse,
       "Eigen::Matrix<S, 3, 3> J = Eigen::Matrix<S, 3, 3>::Zero();\npinocchio::Jlog3(phi.norm(), phi, "
       "J);\nstd::cout << J << '\\n';"},
      {&op::right_jacobian6,
       "Eigen::Matrix<S, 6, 6> J = Eigen::Matrix<S, 6, "
       "6>::Zero();\npinocchio::Jexp6(pinocchio::MotionTpl<S>(xi), J);\nstd::cout << J << '\\n';"},
      {&op::integrate,
       "Eigen::Matrix<S, 7, 1> q1;\npinocchio::SpecialEuclideanOperationTpl<3, S>().integrate(q0, delta, "
       "q1);\nstd::cout << q1 << '\\n';"},
      {&op::difference,
       "Eigen::Matrix<S, 6, 1> delta;\npinocchio::SpecialEuclideanOperationTpl<3, S>().difference(q0, q1, "
       "delta);\nstd::cout << delta << '\\n';"},
      {&op::d_integrate_arg0,
       "Eigen::Matrix<S, 6, 6> J = Eigen::Matrix<S, 6, "
       "6>::Zero();\npinocchio::SpecialEuclideanOperationTpl<3, S>().dIntegrate_dq(q0, delta, J);\nstd::cout "
       "<< J << '\\n';"},
      {&op::d_integrate_arg1,
       "Eigen::Matrix<S, 6, 6> J = Eigen::Matrix<S, 6, "
       "6>::Zero();\npinocchio::SpecialEuclideanOperationTpl<3, S>().dIntegrate_dv(q0, delta, J);\nstd::cout "
       "<< J << '\\n';"},
      {&op::d_difference_arg0,
       "Eigen::Matrix<S, 6, 6> J = Eigen::Matrix<S, 6, "
       "6>::Zero();\npinocchio::SpecialEuclideanOperationTpl<3, S>().dDifference(q0, q1, J, "
       "pinocchio::ARG0);\nstd::cout << J << '\\n';"},
      {&op::d_difference_arg1,
       "Eigen::Matrix<S, 6, 6> J = Eigen::Matrix<S, 6, "
       "6>::Zero();\npinocchio::SpecialEuclideanOperationTpl<3, S>().dDifference(q0, q1, J, "
       "pinocchio::ARG1);\nstd::cout << J << '\\n';"},
      {&op::compose, "(pinocchio::SE3Tpl<S>(R, p) * pinocchio::SE3Tpl<S>(R_Y, p_Y)).toHomogeneousMatrix()"},
      {&op::inverse, "pinocchio::SE3Tpl<S>(R, p).inverse().toHomogeneousMatrix()"},
      {&op::act_point, "pinocchio::SE3Tpl<S>(R, p).act(p_Y)"},
      {&op::rotate_point, "Eigen::Quaternion<S>(Q) * p"},
      {&op::act_motion, "pinocchio::SE3Tpl<S>(R, p).act(pinocchio::MotionTpl<S>(V)).toVector()"},
      {&op::act_inverse_motion, "pinocchio::SE3Tpl<S>(R, p).actInv(pinocchio::MotionTpl<S>(V)).toVector()"},
      {&op::act_force, "pinocchio::SE3Tpl<S>(R, p).act(pinocchio::ForceTpl<S>(F)).toVector()"},
      {&op::act_inverse_force, "pinocchio::SE3Tpl<S>(R, p).actInv(pinocchio::ForceTpl<S>(F)).toVector()"},
      {&op::cross_motion, "pinocchio::MotionTpl<S>(V).cross(pinocchio::MotionTpl<S>(W)).toVector()"},
      {&op::cross_force, "pinocchio::MotionTpl<S>(V).cross(pinocchio::ForceTpl<S>(F)).toVector()"}}});

}  // namespace
}  // namespace liecheck::properties

#endif
