// Subject "ceres": rotation.h of Ceres Solver. Its quaternions store w first; this file reorders them.

#include <subjects/typed.hpp>

#if __has_include(<ceres/rotation.h>)

#include <ceres/rotation.h>
#include <ceres/version.h>
#include <subjects/own_programs.hpp>

namespace liecheck::properties {
namespace {

template <class S>
struct CeresRotation : Types<S> {
  using typename Types<S>::V3, typename Types<S>::V4, typename Types<S>::M3;

  static V4 w_last(const V4& q) { return {q[1], q[2], q[3], q[0]}; }
  static V4 w_first(const V4& q) { return {q[3], q[0], q[1], q[2]}; }

  static V4 exp3_quaternion(const V3& phi) {
    V4 q;
    ::ceres::AngleAxisToQuaternion(phi.data(), q.data());
    return w_last(q);
  }
  static M3 exp3_matrix(const V3& phi) {
    M3 R;
    ::ceres::AngleAxisToRotationMatrix(phi.data(), R.data());
    return R;
  }
  static V3 log3_quaternion(const V4& Q) {
    const V4 q = w_first(Q);
    V3 phi;
    ::ceres::QuaternionToAngleAxis(q.data(), phi.data());
    return phi;
  }
  static V3 log3_matrix(const M3& R) {
    V3 phi;
    ::ceres::RotationMatrixToAngleAxis(R.data(), phi.data());
    return phi;
  }
  static V3 rotate_point(const V4& Q, const V3& x) {
    const V4 q = w_first(Q);
    V3 y;
    ::ceres::QuaternionRotatePoint(q.data(), x.data(), y.data());
    return y;
  }

  static TypedSubject<S> make() {
    TypedSubject<S> s{"ceres", CERES_VERSION_STRING, {}};
    s.operations[op::exp3_quaternion] = exp3_quaternion;
    s.operations[op::exp3_matrix] = exp3_matrix;
    s.operations[op::log3_quaternion] = log3_quaternion;
    s.operations[op::log3_matrix] = log3_matrix;
    s.operations[op::rotate_point] = rotate_point;
    return s;
  }
};

const Registered<float> in_float(CeresRotation<float>::make());
const Registered<double> in_double(CeresRotation<double>::make());

const std::string quaternion_of_Q = "const S q[] = {Q[3], Q[0], Q[1], Q[2]};  // w x y z\n",
                  print_phi = "std::cout << Eigen::Map<Eigen::Matrix<S, 3, 1>>(phi) << '\\n';\n";
const RegisteredPrograms programs(
    "ceres",
    {"-lceres",
     "#include <ceres/rotation.h>\n",
     "",
     {{&op::exp3_quaternion,
       "S q[4];  // w x y z\nceres::AngleAxisToQuaternion(phi.data(), q);\n"
       "std::cout << Eigen::Map<Eigen::Matrix<S, 4, 1>>(q) << '\\n';\n"},
      {&op::exp3_matrix,
       "Eigen::Matrix<S, 3, 3> R;  // column by column, as Ceres stores it\n"
       "ceres::AngleAxisToRotationMatrix(phi.data(), R.data());\nstd::cout << R << '\\n';\n"},
      {&op::log3_quaternion,
       quaternion_of_Q + "S phi[3];\nceres::QuaternionToAngleAxis(q, phi);\n" + print_phi},
      {&op::log3_matrix, "S phi[3];\nceres::RotationMatrixToAngleAxis(R.data(), phi);\n" + print_phi},
      {&op::rotate_point, quaternion_of_Q +
                              "S y[3];\nceres::QuaternionRotatePoint(q, p.data(), y);\n"
                              "std::cout << Eigen::Map<Eigen::Matrix<S, 3, 1>>(y) << '\\n';\n"}}});

}  // namespace
}  // namespace liecheck::properties

#endif
