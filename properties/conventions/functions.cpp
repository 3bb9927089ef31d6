// Conventions of functions: what else exp, log, a Jacobian, an increment or a product may mean.

#include <Eigen/Geometry>
#include <conventions/table.hpp>
#include <string>

namespace liecheck::properties::conventions {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

Vector3d vector(const Numbers& x, std::size_t at) {
  return {x[at], x[at + 1], x[at + 2]};
}
Numbers joined(const Numbers& a, const Numbers& b) {
  Numbers all = a;
  all.insert(all.end(), b.begin(), b.end());
  return all;
}
Numbers part(const Numbers& x, std::size_t at, std::size_t n) {
  const auto from = x.begin() + static_cast<std::ptrdiff_t>(at);
  return {from, from + static_cast<std::ptrdiff_t>(n)};
}
Numbers minus(Numbers x, std::size_t from = 0) {
  for (std::size_t i = from; i < x.size(); ++i) x[i] = -x[i];
  return x;
}

/// A configuration of a free-flyer.
struct Placed {
  Vector3d p;
  Quaterniond Q;
  Placed(const Vector3d& at, const Quaterniond& rotation) : p(at), Q(rotation.normalized()) {}
  explicit Placed(const Numbers& x, std::size_t at = 0)
      : Placed(vector(x, at), {x[at + 6], x[at + 3], x[at + 4], x[at + 5]}) {}
  Placed inverse() const { return {-(Q.conjugate() * p), Q.conjugate()}; }
  Numbers numbers() const { return {p.x(), p.y(), p.z(), Q.x(), Q.y(), Q.z(), Q.w()}; }
};

Numbers minus_result(const Operation& o, const Numbers& x, const Function& right) {
  return minus(right(o, x));
}
Numbers of_minus(const Operation& o, const Numbers& x, const Function& right) {
  return right(o, minus(x));
}
Numbers of_exchanged(const Operation& o, const Numbers& x, const Function& right) {
  const std::size_t n = x.size() / 2;
  return right(o, joined(part(x, n, n), part(x, 0, n)));
}
/// The function whose name has `from` replaced by `to`.
Numbers renamed(const Operation& o, std::string_view from, std::string_view to, const Numbers& x,
                const Function& right) {
  std::string name(o.name);
  name.replace(name.find(from), from.size(), to);
  return right(operation_named(name), x);
}

Numbers inverse_jacobian(const Operation& o, const Numbers& x, const Function& right) {
  if (o.name.ends_with("_inverse")) return renamed(o, "_inverse", "", x, right);
  return right(operation_named(std::string(o.name) + "_inverse"), x);
}

/// exp(delta) T0 = (T0^-1 exp(-delta))^-1 and log(T1 T0^-1) = difference(q1^-1, q0^-1), with derivatives in the axes
/// of the parent.
Numbers left_increments(const Operation& o, const Numbers& x, const Function& right) {
  if (o.name == "integrate_coefficient_jacobian") {  // p_dot = u + omega x p, Q_dot = (omega, 0) Q / 2
    const Placed q(x);
    Eigen::Matrix<double, 7, 6, Eigen::RowMajor> J = Eigen::Matrix<double, 7, 6>::Zero();
    J.topLeftCorner<3, 3>().setIdentity();
    J.topRightCorner<3, 3>() = -hat<double>(q.p);
    J.block<3, 3>(3, 3) = (q.Q.w() * Matrix3d::Identity() - hat<double>(q.Q.vec())) / 2;
    J.block<1, 3>(6, 3) = -q.Q.vec().transpose() / 2;
    return {J.data(), J.data() + J.size()};
  }
  const Numbers q0_inverse = Placed(x).inverse().numbers();
  if (o.name.starts_with("integrate"))
    return Placed(right(o, joined(q0_inverse, minus(part(x, 7, 6))))).inverse().numbers();
  if (o.name.starts_with("d_integrate")) return right(o, minus(x, 7));
  const Numbers q1_inverse = Placed(x, 7).inverse().numbers();
  return o.name.starts_with("d_") ? right(o, joined(q0_inverse, q1_inverse))
                                  : right(o, joined(q1_inverse, q0_inverse));
}
/// integrate and difference in body axes, but their derivatives in the axes of the parent.
Numbers left_derivatives(const Operation& o, const Numbers& x, const Function& right) {
  if (o.name.starts_with("d_integrate")) return right(o, minus(x, 7));
  const Numbers delta = right(operation_named("difference"), x);
  if (o.name == "d_difference_arg0") return minus(right(operation_named("right_jacobian6_inverse"), delta));
  return right(operation_named("left_jacobian6_inverse"), delta);
}

Numbers from_q1_to_q0(const Operation& o, const Numbers& x, const Function& right) {
  const Numbers exchanged = joined(part(x, 7, 7), part(x, 0, 7));
  if (!o.name.starts_with("d_")) return right(o, exchanged);
  return right(operation_named(o.name == "d_difference_arg0" ? "d_difference_arg1" : "d_difference_arg0"),
               exchanged);
}

/// Q1 = exp(phi) Q0, but p as it should be.
Numbers reversed_product(const Operation& o, const Numbers& x, const Function& right) {
  const Placed q0(x);
  if (o.name.starts_with("integrate")) {
    const Numbers e = right(operation_named("exp3_quaternion"), part(x, 10, 3));
    const Placed q1(right(o, x));
    return Placed(q1.p, Quaterniond(e[3], e[0], e[1], e[2]) * q0.Q).numbers();
  }
  const Placed q1(x, 7), relative(q0.Q.conjugate() * (q1.p - q0.p), q1.Q * q0.Q.conjugate());
  return right(o, joined({0, 0, 0, 0, 0, 0, 1}, relative.numbers()));
}

/// The translation is rho, in the axes of the body.
Numbers without_V(const Operation& o, const Numbers& x, const Function& right) {
  Numbers r = right(o, x);
  if (o.name == "exp6") {
    std::copy_n(x.begin(), 3, r.begin() + 9);
  } else if (o.name == "log6") {
    std::copy_n(x.begin() + 9, 3, r.begin());
  } else if (o.name.starts_with("integrate")) {
    const Placed q0(x);
    Vector3d::Map(r.data()) = q0.p + q0.Q * vector(x, 7);
  } else {
    const Placed q0(x), q1(x, 7);
    Vector3d::Map(r.data()) = q0.Q.conjugate() * (q1.p - q0.p);
  }
  return r;
}
/// The translation is rho, in the axes of the parent.
Numbers translation_added(const Operation& o, const Numbers& x, const Function& right) {
  Numbers r = right(o, x);
  const double sign = o.name.starts_with("integrate") ? 1 : -1;
  Vector3d::Map(r.data()) = vector(x, 7) + sign * vector(x, 0);
  return r;
}

Numbers half_angles(const Operation& o, Numbers x, const Function& right, double factor) {
  if (o.name.starts_with("exp"))
    for (double& a : x) a *= factor;
  Numbers r = right(o, x);
  if (o.name.starts_with("log"))
    for (double& a : r) a /= factor;
  return r;
}

Numbers momentum_at_centre(const Operation& o, const Numbers& x, const Function& right) {
  Numbers h = right(o, x);
  Vector3d::Map(h.data() + 3) -= vector(x, 1).cross(vector(h, 0));
  return h;
}

std::vector<Convention> conventions_of_exponentials() {
  constexpr auto
      right_is_left =
          " right_jacobian3 right_jacobian6 right_jacobian3_inverse right_jacobian6_inverse "
          "se23_right_jacobian ",
      left_is_right =
          " left_jacobian3 left_jacobian6 left_jacobian3_inverse left_jacobian6_inverse se23_left_jacobian ";
  return {{"log is that of the inverse", "change its sign, or its order of frames", nullptr, minus_result,
           " log3_quaternion log3_matrix log6 log3_any_norm "},
          {"exp is that of the opposite argument", "change the sign of its argument", nullptr, of_minus,
           " exp3_quaternion exp3_matrix exp6 "},
          {"the right Jacobian is the left one", "offer it under the name left_jacobian, or call it at -xi",
           nullptr, of_minus, right_is_left},
          {"the left Jacobian is the right one", "offer it under the name right_jacobian, or call it at -xi",
           nullptr, of_minus, left_is_right},
          {"a Jacobian and its inverse are exchanged", "exchange their names", nullptr, inverse_jacobian,
           " right_jacobian3 right_jacobian6 right_jacobian3_inverse right_jacobian6_inverse left_jacobian3 "
           "left_jacobian6 left_jacobian3_inverse left_jacobian6_inverse "},
          {"the translation is rho, not V(phi) rho", "take the exponential of SE(3), not of R^3 x SO(3)",
           nullptr, without_V, " exp6 log6 integrate difference integrate_any_norm difference_any_norm "},
          {"quaternions turn by twice the rotation vector",
           "exp takes the half angle, and log gives twice the angle of the quaternion", nullptr,
           [](const Operation& o, const Numbers& x, const Function& right) {
             return half_angles(o, x, right, 2);
           },
           " exp3_quaternion log3_quaternion log3_any_norm "},
          {"quaternions turn by half of the rotation vector", "exp takes the half angle, not a quarter of it",
           nullptr,
           [](const Operation& o, const Numbers& x, const Function& right) {
             return half_angles(o, x, right, 0.5);
           },
           " exp3_quaternion log3_quaternion log3_any_norm "}};
}

std::vector<Convention> conventions_of_configurations() {
  return {
      {"increments are on the left, in the axes of the parent",
       "liecheck's are on the right, in body axes: T exp(delta)",
       nullptr,
       left_increments,
       " integrate difference d_integrate_arg0 d_integrate_arg1 d_difference_arg0 d_difference_arg1 "
       "integrate_coefficient_jacobian integrate_any_norm difference_any_norm d_difference_any_norm ",
       {"increments", "left", "right"}},
      {"the derivatives are those of increments on the left",
       "give those of increments on the right, in body axes", nullptr, left_derivatives,
       " d_integrate_arg0 d_integrate_arg1 d_difference_arg0 d_difference_arg1 d_difference_any_norm "},
      {"the difference goes from q1 to q0", "exchange its arguments: difference(q0, q1) leads from q0 to q1",
       nullptr, from_q1_to_q0,
       " difference d_difference_arg0 d_difference_arg1 difference_any_norm d_difference_any_norm "},
      {"the product of quaternions is in the reverse order (JPL)", "exchange the factors: Q1 = Q0 exp(phi)",
       nullptr, reversed_product, " integrate difference integrate_any_norm difference_any_norm "},
      {"the translation is added in the axes of the parent",
       "take the exponential of SE(3): p1 = p0 + R0 V(phi) rho", nullptr, translation_added,
       " integrate difference integrate_any_norm difference_any_norm "}};
}

std::vector<Convention> conventions_of_spatial_algebra() {
  return {
      {"forces are treated as motions", "forces have their own transform X^-T and product ad*", nullptr,
       [](const Operation& o, const Numbers& x, const Function& right) {
         return renamed(o, "force", "motion", x, right);
       },
       " act_force act_inverse_force cross_force "},
      {"motions are treated as forces", "motions have their own transform X and product ad", nullptr,
       [](const Operation& o, const Numbers& x, const Function& right) {
         return renamed(o, "motion", "force", x, right);
       },
       " act_motion act_inverse_motion cross_motion "},
      {"the product of a motion and a force is ad^T, without its minus sign", "change its sign", nullptr,
       minus_result, " cross_force "},
      {"the product of motions is [W, V]", "exchange its arguments", nullptr, minus_result, " cross_motion "},
      {"the product of poses is in the reverse order", "exchange its arguments", nullptr, of_exchanged,
       " compose "},
      {"momentum is about the centre of mass", "add c x m (u + omega x c) to its angular part", nullptr,
       momentum_at_centre, " momentum "}};
}

/// The pose of x, R row by row and p, inverted.
Numbers inverse_pose(const Numbers& x) {
  Numbers all = x;
  for (std::size_t i = 0; i < 3; ++i) {
    all[9 + i] = 0;
    for (std::size_t j = 0; j < 3; ++j) all[3 * i + j] = x[3 * j + i], all[9 + i] -= x[3 * j + i] * x[9 + j];
  }
  return all;
}
Numbers transposed(const Numbers& x, std::size_t n) {
  Numbers all = x;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) all[n * i + j] = x[n * j + i];
  return all;
}

std::vector<Convention> conventions_of_representations() {
  return {{"the product of quaternions is Q1 Q0", "exchange its arguments", nullptr, of_exchanged,
           " quaternion_product "},
          {"the rows of the matrix are made orthogonal, not its columns",
           "transpose the matrix and the result", nullptr,
           [](const Operation& o, const Numbers& x, const Function& right) {
             return transposed(right(o, transposed(x, 3)), 3);
           },
           " gram_schmidt "},
          {"the rotation of an axis and an angle is the inverse one", "change the sign of the angle", nullptr,
           [](const Operation& o, const Numbers& x, const Function& right) { return right(o, minus(x, 3)); },
           " quaternion_from_axis_angle matrix_from_axis_angle "},
          {"the derivatives are those by the measurements, not by the biases", "change their sign", nullptr,
           minus_result, " forster_bias_jacobians brossard_bias_jacobians "}};
}

std::vector<Convention> conventions_of_transforms() {
  return {
      {"the adjoint is that of the inverse pose", "invert the pose: Ad takes motions of B to A", nullptr,
       [](const Operation& o, const Numbers& x, const Function& right) { return right(o, inverse_pose(x)); },
       " adjoint coadjoint transport_covariance "},
      {"the coadjoint is Ad^T", "it is Ad^-T: forces of B to forces of A", nullptr,
       [](const Operation&, const Numbers& x, const Function& right) {
         return transposed(right(operation_named("adjoint"), x), 6);
       },
       " coadjoint "},
      {"the small adjoint is -ad^T, that of forces", "give the matrix of V x W of motions", nullptr,
       [](const Operation& o, const Numbers& x, const Function& right) {
         return transposed(minus(right(o, x)), 6);
       },
       " small_adjoint "},
      {"the pitch of a screw is that of a whole turn", "divide it by 2 pi", nullptr,
       [](const Operation& o, const Numbers& x, const Function& right) {
         Numbers screw = right(o, x);
         screw[3] *= 6.283185307179586;
         return screw;
       },
       " screw_parameters "},
      {"translation and rotation are interpolated apart",
       "interpolate along the screw, T0 exp(t log(T0^-1 T1))", nullptr,
       [](const Operation& o, const Numbers& x, const Function& right) {
         Numbers q = right(o, x);
         for (std::size_t i = 0; i < 3; ++i) q[i] = (1 - x[14]) * x[i] + x[14] * x[7 + i];
         return q;
       },
       " interpolate "}};
}

}  // namespace

std::vector<Convention> function_conventions() {
  std::vector<Convention> all;
  for (const auto& group :
       {conventions_of_exponentials(), conventions_of_configurations(), conventions_of_spatial_algebra(),
        conventions_of_representations(), conventions_of_transforms()})
    all.insert(all.end(), group.begin(), group.end());
  return all;
}

}  // namespace liecheck::properties::conventions
