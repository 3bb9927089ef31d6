// How interpolation, representations of rotations, extended poses and preintegration follow from other operations.

#include <cmath>
#include <failures/relation_numbers.hpp>
#include <failures/relations.hpp>

namespace liecheck::properties {

namespace {

Numbers scaled(Numbers x, double by) {
  for (double& number : x) number *= by;
  return x;
}
/// The pose of interpolation at t, with the tangent delta from q0 to q1.
Numbers along(const Numbers& x, const Numbers& delta) {
  return exact("integrate", joined({cut(x, 0, 7), scaled(delta, x[14])}));
}
Numbers with_rho(const Numbers& phi, const Eigen::Vector3d& p) {
  return joined({rho_of(mat3(exact("left_jacobian3_inverse", phi)), p), phi});
}
/// The tangent from q0 to q1 with the rotation vector phi.
Numbers way_of(const Numbers& x, const Numbers& phi) {
  return with_rho(phi, vec3(relative_pose(x), 9));
}
/// t times the exact tangent from q0 to q1.
Numbers step_of(const Numbers& x) {
  return scaled(exact("difference", cut(x, 0, 14)), x[14]);
}

Numbers axis_and_angle(const Numbers& phi) {
  const double angle = vec3(phi, 0).norm();
  return joined({angle > 0 ? scaled(phi, 1 / angle) : Numbers{1, 0, 0}, {angle}});
}
/// The rotation vector of an axis and an angle.
Numbers phi_of(const Numbers& x) {
  return scaled(cut(x, 0, 3), x.at(3));
}
Numbers matrix_of(const Numbers& Q) {
  return numbers<3>(RowMajor3(quat(Q).toRotationMatrix()));
}

/// (sin((1 - t) theta) a + sin(t theta) b) / sin(theta).
Numbers on_arc(const Numbers& a, const Numbers& b, double theta, double t) {
  Numbers x;
  for (std::size_t i = 0; i < a.size(); ++i)
    x.push_back((std::sin((1 - t) * theta) * a[i] + std::sin(t * theta) * b[i]) / std::sin(theta));
  return x;
}

/// (rho, phi) and (nu, phi) of (rho, nu, phi); xi = 0, 3.
Numbers twist_of(const Numbers& x, std::size_t xi) {
  return joined({cut(x, xi, 3), cut(x, 6, 3)});
}
/// (R, p) and (R, v) of (R, p, v).
Numbers pose_of(const Numbers& x, std::size_t at) {
  return joined({cut(x, 0, 9), cut(x, at, 3)});
}
Numbers extended_exp(const Numbers& x, const Numbers& R, const Numbers& J) {
  return joined(
      {R, numbers(Eigen::Vector3d(mat3(J) * vec3(x, 0))), numbers(Eigen::Vector3d(mat3(J) * vec3(x, 3)))});
}
Numbers extended_log(const Numbers& x, const Numbers& phi, const Numbers& J_inverse) {
  const RowMajor3 J = mat3(J_inverse);
  return joined({rho_of(J, vec3(x, 9)), rho_of(J, vec3(x, 12)), phi});
}
Numbers extended_log(const Numbers& x, const Numbers& phi) {
  return extended_log(x, phi, exact("left_jacobian3_inverse", phi));
}
/// [[J, 0, C(rho)], [0, J, C(nu)], [0, 0, J]].
Numbers jacobian9(const RowMajor3& J, const RowMajor3& of_rho, const RowMajor3& of_nu) {
  Eigen::Matrix<double, 9, 9, Eigen::RowMajor> all = Eigen::Matrix<double, 9, 9, Eigen::RowMajor>::Zero();
  for (const Eigen::Index i : {0, 3, 6}) all.block<3, 3>(i, i) = J;
  all.block<3, 3>(0, 6) = of_rho, all.block<3, 3>(3, 6) = of_nu;
  return numbers<9>(all);
}
/// From the same Jacobian of poses, at (rho, phi) and (nu, phi).
Numbers by_jacobian6(const CallOf& c) {
  const Numbers J = c.part(twist_of(c.x, 0));
  return jacobian9(mat6(J).topLeftCorner<3, 3>(), coupling_of(J), coupling_of(c.part(twist_of(c.x, 3))));
}

/// (dR, dp, dv) of three measurements of constant omega and a, where each turns by the given rotation.
Numbers increments(const Numbers& x, const std::function<RowMajor3(const Numbers&)>& rotation) {
  const double dt = x.at(18);
  RowMajor3 R = RowMajor3::Identity();
  Eigen::Vector3d p = Eigen::Vector3d::Zero(), v = p;
  for (std::size_t i = 0; i < 9; i += 3) {
    const Eigen::Vector3d a = R * vec3(x, 9 + i);
    p += v * dt + a * (dt * dt / 2), v += a * dt;
    R = (R * rotation(scaled(cut(x, i, 3), dt))).eval();
  }
  return joined({numbers<3>(R), numbers(p), numbers(v)});
}

const Relation all_relations[] = {
    {"preintegrate_forster", "exp3_matrix",
     [](const CallOf& c) -> Numbers {
       return increments(c.x, [&](const Numbers& phi) { return mat3(c.part(phi)); });
     }},
    {"preintegrate_forster", "exp3_quaternion",
     [](const CallOf& c) -> Numbers {
       return increments(
           c.x, [&](const Numbers& phi) -> RowMajor3 { return quat(c.part(phi)).toRotationMatrix(); });
     }},
    {"interpolate", "difference",
     [](const CallOf& c) -> Numbers { return along(c.x, c.part(cut(c.x, 0, 14))); }},
    {"interpolate", "log6",
     [](const CallOf& c) -> Numbers { return along(c.x, c.part(relative_pose(c.x))); }},
    {"interpolate", "log3_quaternion",
     [](const CallOf& c) -> Numbers {
       return along(c.x, way_of(c.x, c.part(relative_quaternion(c.x, 3, 10))));
     }},
    {"interpolate", "log3_matrix",
     [](const CallOf& c) -> Numbers {
       return along(c.x, way_of(c.x, c.part(cut(relative_pose(c.x), 0, 9))));
     }},
    {"interpolate", "left_jacobian3_inverse",
     [](const CallOf& c) -> Numbers {
       const Numbers X = relative_pose(c.x), phi = cut(exact("log6", X), 3, 3);
       return along(c.x, joined({rho_of(mat3(c.part(phi)), vec3(X, 9)), phi}));
     }},
    {"interpolate", "integrate",
     [](const CallOf& c) -> Numbers {
       return c.part(joined({cut(c.x, 0, 7), step_of(c.x)}));
     }},
    {"interpolate", "exp6",
     [](const CallOf& c) -> Numbers {
       const Numbers X = c.part(step_of(c.x));
       return joined({numbers(Eigen::Vector3d(vec3(c.x, 0) + quat(c.x, 3) * vec3(X, 9))),
                      numbers(Eigen::Quaterniond(quat(c.x, 3) * quat_of(mat3(X))))});
     }},
    {"axis_angle_from_quaternion", "log3_quaternion",
     [](const CallOf& c) -> Numbers { return axis_and_angle(c.part(c.x)); }},
    {"axis_angle_from_matrix", "quaternion_from_matrix",
     [](const CallOf& c) -> Numbers { return exact("axis_angle_from_quaternion", c.part(c.x)); }},
    {"axis_angle_from_matrix", "log3_matrix",
     [](const CallOf& c) -> Numbers { return axis_and_angle(c.part(c.x)); }},
    {"log3_matrix", "quaternion_from_matrix",
     [](const CallOf& c) -> Numbers { return exact("log3_quaternion", c.part(c.x)); }},
    {"quaternion_from_axis_angle", "exp3_quaternion",
     [](const CallOf& c) -> Numbers { return c.part(phi_of(c.x)); }},
    {"matrix_from_axis_angle", "quaternion_from_axis_angle",
     [](const CallOf& c) -> Numbers { return matrix_of(c.part(c.x)); }},
    {"matrix_from_axis_angle", "exp3_matrix", [](const CallOf& c) -> Numbers { return c.part(phi_of(c.x)); }},
    {"exp3_matrix", "matrix_from_quaternion",
     [](const CallOf& c) -> Numbers { return c.part(exact("exp3_quaternion", c.x)); }},
    {"rotate_point", "matrix_from_quaternion",
     [](const CallOf& c) -> Numbers {
       return numbers(Eigen::Vector3d(mat3(c.part(cut(c.x, 0, 4))) * vec3(c.x, 4)));
     }},
    {"slerp", "relative_angle",
     [](const CallOf& c) -> Numbers {
       const double half = c.part(cut(c.x, 0, 8)).at(0) / 2;
       const Numbers Q0 = cut(c.x, 0, 4), Q1 = cut(c.x, 4, 4);
       double cosine = 0;
       for (std::size_t i = 0; i < 4; ++i) cosine += Q0[i] * Q1[i];
       return on_arc(Q0, cosine < 0 ? minus(Q1) : Q1, half, c.x[8]);
     }},
    {"slerp_directions", "angle_between",
     [](const CallOf& c) -> Numbers {
       return on_arc(cut(c.x, 0, 3), cut(c.x, 3, 3), c.part(cut(c.x, 0, 6)).at(0), c.x[6]);
     }},
    {"se23_exp", "exp3_matrix",
     [](const CallOf& c) -> Numbers {
       const Numbers phi = cut(c.x, 6, 3);
       return extended_exp(c.x, c.part(phi), exact("left_jacobian3", phi));
     }},
    {"se23_exp", "left_jacobian3",
     [](const CallOf& c) -> Numbers {
       const Numbers phi = cut(c.x, 6, 3);
       return extended_exp(c.x, exact("exp3_matrix", phi), c.part(phi));
     }},
    {"se23_exp", "exp6",
     [](const CallOf& c) -> Numbers {
       return joined({c.part(twist_of(c.x, 0)), cut(c.part(twist_of(c.x, 3)), 9, 3)});
     }},
    {"se23_log", "log3_matrix",
     [](const CallOf& c) -> Numbers { return extended_log(c.x, c.part(cut(c.x, 0, 9))); }},
    {"se23_log", "log3_quaternion",
     [](const CallOf& c) -> Numbers { return extended_log(c.x, c.part(numbers(quat_of(mat3(c.x))))); }},
    {"se23_log", "log3_quaternion",
     [](const CallOf& c) -> Numbers {
       return extended_log(c.x, c.part(minus(numbers(quat_of(mat3(c.x))))));
     }},
    {"se23_log", "left_jacobian3_inverse",
     [](const CallOf& c) -> Numbers {
       const Numbers phi = exact("log3_matrix", cut(c.x, 0, 9));
       return extended_log(c.x, phi, c.part(phi));
     }},
    {"se23_log", "log6",
     [](const CallOf& c) -> Numbers {
       const Numbers of_p = c.part(pose_of(c.x, 9)), of_v = c.part(pose_of(c.x, 12));
       return joined({cut(of_p, 0, 3), cut(of_v, 0, 3), cut(of_p, 3, 3)});
     }},
    {"se23_left_jacobian", "left_jacobian3",
     [](const CallOf& c) -> Numbers {
       return jacobian9(mat3(c.part(cut(c.x, 6, 3))), coupling_of(exact("left_jacobian6", twist_of(c.x, 0))),
                        coupling_of(exact("left_jacobian6", twist_of(c.x, 3))));
     }},
    {"se23_left_jacobian", "left_jacobian6", by_jacobian6},
    {"se23_right_jacobian", "se23_left_jacobian",
     [](const CallOf& c) -> Numbers { return c.part(minus(c.x)); }},
    {"se23_right_jacobian", "right_jacobian6", by_jacobian6},
    {"transport_covariance", "adjoint",
     [](const CallOf& c) -> Numbers {
       const RowMajor6 Ad = mat6(c.part(cut(c.x, 0, 12)));
       return numbers<6>(RowMajor6(Ad * mat6(cut(c.x, 12, 36)) * Ad.transpose()));
     }},
};

}  // namespace

std::span<const Relation> derived_relations() {
  return all_relations;
}

}  // namespace liecheck::properties
