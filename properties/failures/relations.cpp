#include <failures/relations.hpp>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <conventions/probe.hpp>
#include <conventions/reference.hpp>
#include <failures/relation_numbers.hpp>
#include <limits>

namespace liecheck::properties {

namespace {

/// Of a rotation vector that is not predicted, but taken from the result.
const Numbers unknown(3, unknown_number);

Numbers with_rho(const Numbers& phi, const Eigen::Vector3d& p) {
  return joined({rho_of(mat3(exact("left_jacobian3_inverse", phi)), p), phi});
}
/// exp6 of the rotation R and phi, with the exact translation.
Numbers exp_of(const RowMajor3& R, const Numbers& x) {
  return joined(
      {numbers<3>(R), numbers(Eigen::Vector3d(mat3(exact("left_jacobian3", cut(x, 3, 3))) * vec3(x, 0)))});
}
/// q0 and then a pose (R, p) or a rotation Q and a translation p.
Numbers moved(const Numbers& x, const Eigen::Quaterniond& Q, const Eigen::Vector3d& p) {
  return joined({numbers(Eigen::Vector3d(vec3(x, 0) + quat(x, 3) * p)), numbers(quat(x, 3) * Q)});
}

/// The pose in the plane from the body at q0 to the body at q1.
Numbers relative_planar_pose(const Numbers& x) {
  const double c = x[2], s = x[3];
  return exact("se2_compose", joined({{-c * x[0] - s * x[1], s * x[0] - c * x[1], c, -s}, cut(x, 4, 4)}));
}

double apart(const Numbers& a, const Numbers& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::fabs(a[i] - b[i]));
  return most;
}
/// The derivative of a difference by a Jacobian at the exact difference; if that is wrong, too, at the subject's own
/// difference, if it has one, whose errors may be those of the same Jacobian.
template <class Jacobian>
Numbers by_difference(const CallOf& c, const char* operation, const Jacobian& jacobian) {
  const Numbers right = exact(operation, c.x), by_exact = jacobian(exact("difference", c.x));
  try {
    const Numbers by_own = jacobian(c.own("difference", c.x));
    return apart(by_exact, right) > apart(by_own, right) / 30 ? by_own : by_exact;
  } catch (const std::domain_error&) {  // it has no difference, or refuses the arguments
    return by_exact;
  }
}

const Relation all_relations[] = {
    {"exp3_matrix", "exp3_quaternion",
     [](const CallOf& c) -> Numbers { return numbers<3>(RowMajor3(quat(c.part(c.x)).toRotationMatrix())); }},
    {"log3_matrix", "log3_quaternion",
     [](const CallOf& c) -> Numbers { return c.part(numbers(quat_of(mat3(c.x)))); }},
    {"exp6", "exp3_matrix",
     [](const CallOf& c) -> Numbers { return exp_of(mat3(c.part(cut(c.x, 3, 3))), c.x); }},
    {"exp6", "exp3_quaternion",
     [](const CallOf& c) -> Numbers {
       return exp_of(RowMajor3(quat(c.part(cut(c.x, 3, 3))).toRotationMatrix()), c.x);
     }},
    {"exp6", "left_jacobian3",
     [](const CallOf& c) -> Numbers {
       return joined({cut(exact("exp6", c.x), 0, 9),
                      numbers(Eigen::Vector3d(mat3(c.part(cut(c.x, 3, 3))) * vec3(c.x, 0)))});
     }},
    {"exp6", "left_jacobian3",  // as the rotation times the right Jacobian, which is the left one of -phi
     [](const CallOf& c) -> Numbers {
       const Numbers all = exact("exp6", c.x);
       return joined({cut(all, 0, 9), numbers(Eigen::Vector3d(
                                          mat3(all) * mat3(c.part(minus(cut(c.x, 3, 3)))) * vec3(c.x, 0)))});
     }},
    {"log6", "log3_matrix",
     [](const CallOf& c) -> Numbers { return with_rho(c.part(cut(c.x, 0, 9)), vec3(c.x, 9)); }},
    {"log6", "log3_quaternion",
     [](const CallOf& c) -> Numbers { return with_rho(c.part(numbers(quat_of(mat3(c.x)))), vec3(c.x, 9)); }},
    {"log6", "log3_quaternion",  // of a pose that has the other quaternion
     [](const CallOf& c) -> Numbers {
       return with_rho(c.part(minus(numbers(quat_of(mat3(c.x))))), vec3(c.x, 9));
     }},
    {"log6", "left_jacobian3_inverse",
     [](const CallOf& c) -> Numbers {
       return joined({rho_of(mat3(c.part(cut(c.got, 3, 3))), vec3(c.x, 9)), unknown});
     }},
    {"log6", "log6",
     [](const CallOf& c) -> Numbers {
       return joined({cut(with_rho(cut(c.got, 3, 3), vec3(c.x, 9)), 0, 3), unknown});
     }},
    {"integrate", "exp6",
     [](const CallOf& c) -> Numbers {
       const Numbers X = c.part(cut(c.x, 7, 6));
       return moved(c.x, quat_of(mat3(X)), vec3(X, 9));
     }},
    {"integrate", "exp3_quaternion",
     [](const CallOf& c) -> Numbers {
       return moved(c.x, quat(c.part(cut(c.x, 10, 3))), vec3(exact("exp6", cut(c.x, 7, 6)), 9));
     }},
    {"integrate", "quaternion_product",
     [](const CallOf& c) -> Numbers {
       const Numbers turn = exact("exp3_quaternion", cut(c.x, 10, 3));
       return joined({cut(exact("integrate", c.x), 0, 3), c.part(joined({cut(c.x, 3, 4), turn}))});
     }},
    {"integrate", "left_jacobian3",
     [](const CallOf& c) -> Numbers {
       return moved(c.x, quat_of(mat3(exact("exp6", cut(c.x, 7, 6)))),
                    mat3(c.part(cut(c.x, 10, 3))) * vec3(c.x, 7));
     }},
    {"difference", "log6", [](const CallOf& c) -> Numbers { return c.part(relative_pose(c.x)); }},
    {"difference", "log3_quaternion",
     [](const CallOf& c) -> Numbers {
       return with_rho(c.part(relative_quaternion(c.x, 3, 10)), vec3(relative_pose(c.x), 9));
     }},
    {"difference", "quaternion_product",
     [](const CallOf& c) -> Numbers {
       const Numbers inverse = minus(cut(c.x, 3, 3));
       const Numbers Q = c.part(joined({inverse, cut(c.x, 6, 1), cut(c.x, 10, 4)}));
       return with_rho(exact("log3_quaternion", Q), vec3(relative_pose(c.x), 9));
     }},
    {"difference", "log3_matrix",
     [](const CallOf& c) -> Numbers {
       return with_rho(c.part(cut(relative_pose(c.x), 0, 9)), vec3(relative_pose(c.x), 9));
     }},
    {"difference", "left_jacobian3_inverse",
     [](const CallOf& c) -> Numbers {
       return joined({rho_of(mat3(c.part(cut(c.got, 3, 3))), vec3(relative_pose(c.x), 9)), unknown});
     }},
    {"difference", "difference",
     [](const CallOf& c) -> Numbers {
       return joined({cut(with_rho(cut(c.got, 3, 3), vec3(relative_pose(c.x), 9)), 0, 3), unknown});
     }},
    {"d_integrate_arg0", "exp6",
     [](const CallOf& c) -> Numbers {
       const Numbers X = c.part(minus(cut(c.x, 7, 6)));
       return numbers<6>(adjoint(mat3(X), vec3(X, 9)));
     }},
    {"d_integrate_arg0", "exp6",
     [](const CallOf& c) -> Numbers {
       const Numbers X = c.part(cut(c.x, 7, 6));
       const RowMajor3 R = mat3(X).transpose();
       return numbers<6>(adjoint(R, Eigen::Vector3d(-R * vec3(X, 9))));
     }},
    {"d_integrate_arg1", "right_jacobian6",
     [](const CallOf& c) -> Numbers { return c.part(cut(c.x, 7, 6)); }},
    {"d_difference_arg0", "left_jacobian6_inverse",
     [](const CallOf& c) -> Numbers {
       return by_difference(c, "d_difference_arg0",
                            [&](const Numbers& delta) { return minus(c.part(delta)); });
     }},
    {"d_difference_arg0", "right_jacobian6_inverse",
     [](const CallOf& c) -> Numbers {
       return by_difference(c, "d_difference_arg0",
                            [&](const Numbers& delta) { return minus(c.part(minus(delta))); });
     }},
    {"d_difference_arg0", "difference",
     [](const CallOf& c) -> Numbers { return minus(exact("left_jacobian6_inverse", c.part(c.x))); }},
    {"d_difference_arg1", "right_jacobian6_inverse",
     [](const CallOf& c) -> Numbers { return by_difference(c, "d_difference_arg1", c.part); }},
    {"d_difference_arg1", "left_jacobian6_inverse",
     [](const CallOf& c) -> Numbers {
       return by_difference(c, "d_difference_arg1",
                            [&](const Numbers& delta) { return c.part(minus(delta)); });
     }},
    {"d_difference_arg1", "difference",
     [](const CallOf& c) -> Numbers { return exact("right_jacobian6_inverse", c.part(c.x)); }},
    {"right_jacobian3", "left_jacobian3", [](const CallOf& c) -> Numbers { return c.part(minus(c.x)); }},
    {"right_jacobian3_inverse", "left_jacobian3_inverse",
     [](const CallOf& c) -> Numbers { return c.part(minus(c.x)); }},
    {"right_jacobian6", "left_jacobian6", [](const CallOf& c) -> Numbers { return c.part(minus(c.x)); }},
    {"right_jacobian6_inverse", "left_jacobian6_inverse",
     [](const CallOf& c) -> Numbers { return c.part(minus(c.x)); }},
    {"left_jacobian3_inverse", "left_jacobian3",
     [](const CallOf& c) -> Numbers { return numbers<3>(RowMajor3(mat3(c.part(c.x)).inverse())); }},
    {"left_jacobian6", "left_jacobian3",
     [](const CallOf& c) -> Numbers {
       return jacobian6(mat3(c.part(cut(c.x, 3, 3))), coupling_of(exact("left_jacobian6", c.x)));
     }},
    {"left_jacobian6_inverse", "left_jacobian3_inverse",
     [](const CallOf& c) -> Numbers {
       const RowMajor3 J = mat3(c.part(cut(c.x, 3, 3)));
       return jacobian6(J, RowMajor3(-J * coupling_of(exact("left_jacobian6", c.x)) * J));
     }},
    {"left_jacobian6_inverse", "left_jacobian6",
     [](const CallOf& c) -> Numbers {
       const RowMajor3 J = mat3(exact("left_jacobian3_inverse", cut(c.x, 3, 3)));
       return jacobian6(J, RowMajor3(-J * coupling_of(c.part(c.x)) * J));
     }},
    {"relative_angle", "log3_quaternion",
     [](const CallOf& c) -> Numbers { return {vec3(c.part(relative_quaternion(c.x, 0, 4)), 0).norm()}; }},
    {"slerp", "log3_quaternion",
     [](const CallOf& c) -> Numbers {
       Numbers phi = c.part(relative_quaternion(c.x, 0, 4));
       for (double& number : phi) number *= c.x[8];
       return numbers(quat(c.x) * quat(exact("exp3_quaternion", phi)));
     }},
    {"rotate_point_any_norm", "rotate_point", [](const CallOf& c) -> Numbers { return c.part(c.x); }},
    {"log3_any_norm", "log3_quaternion", [](const CallOf& c) -> Numbers { return c.part(c.x); }},
    {"integrate_any_norm", "integrate", [](const CallOf& c) -> Numbers { return c.part(c.x); }},
    {"difference_any_norm", "difference", [](const CallOf& c) -> Numbers { return c.part(c.x); }},
    {"d_difference_any_norm", "d_difference_arg1", [](const CallOf& c) -> Numbers { return c.part(c.x); }},
    {"se2_integrate", "se2_exp",
     [](const CallOf& c) -> Numbers {
       return exact("se2_compose", joined({cut(c.x, 0, 4), c.part(cut(c.x, 4, 3))}));
     }},
    {"se2_integrate", "se2_compose",
     [](const CallOf& c) -> Numbers {
       return c.part(joined({cut(c.x, 0, 4), exact("se2_exp", cut(c.x, 4, 3))}));
     }},
    {"se2_difference", "se2_log",
     [](const CallOf& c) -> Numbers { return c.part(relative_planar_pose(c.x)); }},
    {"euler_to_matrix", "euler_to_quaternion",
     [](const CallOf& c) -> Numbers { return numbers<3>(RowMajor3(quat(c.part(c.x)).toRotationMatrix())); }},
    {"euler_to_quaternion", "exp3_quaternion",  // both by way of a matrix
     [](const CallOf& c) -> Numbers {
       return c.part(exact("log3_quaternion", exact("euler_to_quaternion", c.x)));
     }},
    {"euler_from_quaternion", "euler_from_matrix",
     [](const CallOf& c) -> Numbers {
       return c.part(joined({{c.x[0]}, numbers<3>(RowMajor3(quat(c.x, 1).toRotationMatrix()))}));
     }},
};

}  // namespace

Numbers exact(const char* name, const Numbers& arguments) {
  const std::vector<oracles::Real> x(arguments.begin(), arguments.end());
  Numbers result;
  for (const oracles::Real& r : conventions::exact_result(conventions::operation_named(name), x))
    result.push_back(static_cast<double>(r));
  return result;
}

Numbers relative_pose(const Numbers& x) {
  const Eigen::Quaterniond q0 = quat(x, 3), q1 = quat(x, 10);
  return joined({numbers<3>(RowMajor3((q0.conjugate() * q1).toRotationMatrix())),
                 numbers(Eigen::Vector3d(q0.conjugate() * (vec3(x, 7) - vec3(x, 0))))});
}

std::span<const Relation> relations() {
  static const std::vector<Relation> all = [] {
    std::vector<Relation> both(std::begin(all_relations), std::end(all_relations));
    const auto derived = derived_relations();
    both.insert(both.end(), derived.begin(), derived.end());
    return both;
  }();
  return all;
}

}  // namespace liecheck::properties
