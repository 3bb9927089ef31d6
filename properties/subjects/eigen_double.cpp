#include <subjects/eigen_geometry.hpp>
#include <subjects/own_programs.hpp>

namespace liecheck::properties {
namespace {

const Registered<double> in_double(EigenGeometry<double>::make());

const std::string angle_axis =
                      "const S theta = phi.norm();\n"
                      "const Eigen::Matrix<S, 3, 1> x(1, 0, 0), axis = theta > 0 ? phi / theta : x;\n"
                      "const Eigen::AngleAxis<S> a(theta, axis);\n",
                  T_of_X =
                      "Eigen::Transform<S, 3, Eigen::Isometry> T;\n"
                      "T.linear() = R, T.translation() = p, T.makeAffine();\n";
const RegisteredPrograms programs(
    "eigen",
    {"",
     "#include <Eigen/Geometry>\n#include <unsupported/Eigen/MatrixFunctions>\n",
     "",
     {{&op::exp3_quaternion, angle_axis + "std::cout << Eigen::Quaternion<S>(a).coeffs() << '\\n';"},
      {&op::exp3_matrix, angle_axis + "std::cout << a.toRotationMatrix() << '\\n';"},
      {&op::log3_quaternion,
       "const Eigen::AngleAxis<S> a{Eigen::Quaternion<S>(Q)};\nstd::cout << a.angle() * a.axis() << '\\n';"},
      {&op::log3_matrix, "const Eigen::AngleAxis<S> a{R};\nstd::cout << a.angle() * a.axis() << '\\n';"},
      {&op::exp6,
       "Eigen::Matrix<S, 4, 4> m;\n"
       "m << 0, -xi[5], xi[4], xi[0], xi[5], 0, -xi[3], xi[1], -xi[4], xi[3], 0, xi[2], 0, 0, 0, 0;\n"
       "std::cout << m.exp() << '\\n';"},
      {&op::log6,
       "Eigen::Matrix<S, 4, 4> T;\nT << R, p, 0, 0, 0, 1;\nconst Eigen::Matrix<S, 4, 4> m = T.log();\n"
       "std::cout << m.topRightCorner<3, 1>() << '\\n' << (m(2, 1) - m(1, 2)) / 2 << '\\n'\n"
       "          << (m(0, 2) - m(2, 0)) / 2 << '\\n' << (m(1, 0) - m(0, 1)) / 2 << '\\n';"},
      {&op::compose, T_of_X + "Eigen::Transform<S, 3, Eigen::Isometry> Y;\n"
                              "Y.linear() = R_Y, Y.translation() = p_Y, Y.makeAffine();\n"
                              "std::cout << (T * Y).matrix() << '\\n';"},
      {&op::inverse, T_of_X + "std::cout << T.inverse().matrix() << '\\n';"},
      {&op::act_point, T_of_X + "std::cout << T * p_Y << '\\n';"},
      {&op::rotate_point, "Eigen::Quaternion<S>(Q) * p"}}});

}  // namespace
}  // namespace liecheck::properties
