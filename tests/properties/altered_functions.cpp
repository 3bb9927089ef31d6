// Libraries whose functions mean something else.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "altered_libraries.hpp"

namespace liecheck::properties::conventions {
namespace {

void take(Library& l, const std::string& name, const std::string& other) {
  l[name] = correct()[other];
}

template <int N>
void transpose(double* v) {
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < i; ++j) std::swap(v[N * i + j], v[N * j + i]);
}
template <int N, int D>
void scale(double* v) {
  for (int i = 0; i < 3; ++i) v[i] *= double(N) / D;
}
Numbers exponential(const Numbers& delta) {
  return correct()["integrate"](
      {0, 0, 0, 0, 0, 0, 1, delta[0], delta[1], delta[2], delta[3], delta[4], delta[5]});
}
Eigen::Quaterniond rotation(const Numbers& q, std::size_t at) {
  return {q[at + 6], q[at + 3], q[at + 4], q[at + 5]};
}
Eigen::Vector3d point(const Numbers& q, std::size_t at) {
  return {q[at], q[at + 1], q[at + 2]};
}
Numbers configuration(const Eigen::Vector3d& p, const Eigen::Quaterniond& Q) {
  return {p[0], p[1], p[2], Q.x(), Q.y(), Q.z(), Q.w()};
}
Numbers logarithm(const Eigen::Vector3d& p, const Eigen::Quaterniond& Q) {
  Numbers x{0, 0, 0, 0, 0, 0, 1};
  const Numbers q = configuration(p, Q);
  x.insert(x.end(), q.begin(), q.end());
  return correct()["difference"](x);
}

}  // namespace

void right_jacobian_is_left(Library& l) {
  take(l, "right_jacobian3", "left_jacobian3"), take(l, "right_jacobian6", "left_jacobian6");
  take(l, "right_jacobian3_inverse", "left_jacobian3_inverse");
  take(l, "right_jacobian6_inverse", "left_jacobian6_inverse");
  take(l, "se23_right_jacobian", "se23_left_jacobian");
}
void log_of_the_inverse(Library& l) {
  change_results(l, {{"log3_quaternion", 0}, {"log3_any_norm", 0}, {"log3_matrix", 0}}, negate3);
  change_results(l, {{"log6", 0}}, negate6);
}
void left_increments(Library& l) {
  Library left{{"integrate",
                [](const Numbers& x) {
                  const Numbers e = exponential({x.begin() + 7, x.end()});
                  return configuration(rotation(e, 0) * point(x, 0) + point(e, 0),
                                       rotation(e, 0) * rotation(x, 0));
                }},
               {"difference", [](const Numbers& x) {
                  const Eigen::Quaterniond Q = rotation(x, 7) * rotation(x, 0).conjugate();
                  return logarithm(point(x, 7) - Q * point(x, 0), Q);
                }}};
  Library all = correct();
  left["d_integrate_arg1"] = [f = all["left_jacobian6"]](const Numbers& x) {
    return f({x.begin() + 7, x.end()});
  };
  left["d_difference_arg1"] = [f = all["left_jacobian6_inverse"], d = left["difference"]](const Numbers& x) {
    return f(d(x));
  };
  for (const auto& [name, function] : left) l[name] = function;
  for (const char* name : {"integrate_any_norm", "difference_any_norm", "d_difference_any_norm",
                           "d_integrate_arg0", "d_difference_arg0", "integrate_coefficient_jacobian"})
    l.erase(name);
}
void reversed_quaternion_product(Library& l) {
  l["integrate"] = [f = correct()["integrate"]](const Numbers& x) {
    const Numbers e = exponential({x.begin() + 7, x.end()});
    return configuration(point(f(x), 0), rotation(e, 0) * rotation(x, 0));
  };
  l["difference"] = [](const Numbers& x) {
    return logarithm(rotation(x, 0).conjugate() * (point(x, 7) - point(x, 0)),
                     rotation(x, 7) * rotation(x, 0).conjugate());
  };
  l.erase("integrate_any_norm"), l.erase("difference_any_norm");
}
void translation_without_V(Library& l) {
  for (const char* name : {"integrate", "difference", "integrate_any_norm", "difference_any_norm"})
    l.erase(name);
  l["exp6"] = [f = l["exp6"]](const Numbers& x) {
    Numbers r = f(x);
    std::copy_n(x.begin(), 3, r.begin() + 9);
    return r;
  };
  l["log6"] = [f = l["log6"]](const Numbers& x) {
    Numbers r = f(x);
    std::copy_n(x.begin() + 9, 3, r.begin());
    return r;
  };
}
void forces_as_motions(Library& l) {
  take(l, "act_force", "act_motion"), take(l, "act_inverse_force", "act_inverse_motion");
  take(l, "cross_force", "cross_motion");
}
void cross_force_sign(Library& l) {
  change_results(l, {{"cross_force", 0}}, negate6);
}
void angle_for_half_angle(Library& l) {
  change_arguments(l, {{"exp3_quaternion", 0}}, scale<2, 1>);
  change_results(l, {{"log3_quaternion", 0}, {"log3_any_norm", 0}}, scale<1, 2>);
}
void exp_of_the_opposite(Library& l) {
  change_arguments(l, {{"exp3_quaternion", 0}, {"exp3_matrix", 0}}, negate3);
  change_arguments(l, {{"exp6", 0}}, negate6);
}
void left_jacobian_is_right(Library& l) {
  change_arguments(l, {{"left_jacobian3", 0}, {"left_jacobian3_inverse", 0}}, negate3);
  take(l, "se23_left_jacobian", "se23_right_jacobian");
  change_arguments(l, {{"left_jacobian6", 0}, {"left_jacobian6_inverse", 0}}, negate6);
}
void jacobians_exchanged_with_inverses(Library& l) {
  for (const std::string name : {"left_jacobian3", "right_jacobian3", "left_jacobian6", "right_jacobian6"})
    take(l, name, name + "_inverse"), take(l, name + "_inverse", name);
}
void quarter_angles(Library& l) {
  change_arguments(l, {{"exp3_quaternion", 0}}, scale<1, 2>);
  change_results(l, {{"log3_quaternion", 0}, {"log3_any_norm", 0}}, scale<2, 1>);
}
void left_derivatives(Library& l) {
  Library left = correct();
  left_increments(left);
  l["d_integrate_arg1"] = left["d_integrate_arg1"];
  l["d_difference_arg1"] = [d = l["difference"], f = l["left_jacobian6_inverse"]](const Numbers& x) {
    return f(d(x));
  };
  l.erase("d_integrate_arg0"), l.erase("d_difference_arg0"), l.erase("d_difference_any_norm");
}
void difference_from_q1(Library& l) {
  change_results(l, {{"difference", 0}, {"difference_any_norm", 0}}, negate6);
  for (const auto& [name, other] : {std::pair{"d_difference_arg0", "d_difference_arg1"},
                                    {"d_difference_arg1", "d_difference_arg0"},
                                    {"d_difference_any_norm", "d_difference_arg0"}})
    l[name] = [f = correct()[other]](Numbers x) {
      std::swap_ranges(x.begin(), x.begin() + 7, x.begin() + 7);
      return f(x);
    };
}
void added_translations(Library& l) {
  l["integrate"] = [f = l["integrate"]](const Numbers& x) {
    Numbers r = f(x);
    for (std::size_t i = 0; i < 3; ++i) r[i] = x[i] + x[7 + i];
    return r;
  };
  l["difference"] = [f = l["difference"]](const Numbers& x) {
    Numbers r = f(x);
    for (std::size_t i = 0; i < 3; ++i) r[i] = x[7 + i] - x[i];
    return r;
  };
  l.erase("integrate_any_norm"), l.erase("difference_any_norm");
}
void motions_as_forces(Library& l) {
  take(l, "act_motion", "act_force"), take(l, "act_inverse_motion", "act_inverse_force");
  take(l, "cross_motion", "cross_force");
}
void cross_motion_exchanged(Library& l) {
  change_results(l, {{"cross_motion", 0}}, negate6);
}
void compose_exchanged(Library& l) {
  change_arguments(l, {{"compose", 0}}, [](double* x) { std::swap_ranges(x, x + 12, x + 12); });
}
void momentum_about_the_centre(Library& l) {
  l["momentum"] = [f = l["momentum"]](Numbers x) {
    Numbers h = f(x);
    const Eigen::Vector3d c(x[1], x[2], x[3]), k = c.cross(Eigen::Vector3d(h[0], h[1], h[2]));
    for (int i = 0; i < 3; ++i) h[std::size_t(3 + i)] -= k[i];
    return h;
  };
}

void quaternion_product_exchanged(Library& l) {
  l["quaternion_product"] = [](const Numbers& x) {
    Numbers y(x.begin() + 4, x.end());
    y.insert(y.end(), x.begin(), x.begin() + 4);
    return correct()["quaternion_product"](y);
  };
}
void rows_made_orthogonal(Library& l) {
  change_arguments(l, {{"gram_schmidt", 0}}, transpose<3>);
  change_results(l, {{"gram_schmidt", 0}}, transpose<3>);
}
void axis_and_angle_inverse(Library& l) {
  change_arguments(l, {{"quaternion_from_axis_angle", 3}, {"matrix_from_axis_angle", 3}},
                   [](double* angle) { *angle = -*angle; });
}
void adjoint_of_the_inverse(Library& l) {
  change_arguments(l, {{"adjoint", 0}, {"coadjoint", 0}, {"transport_covariance", 0}}, [](double* x) {
    const Numbers r = correct()["inverse"](Numbers(x, x + 12));
    std::ranges::copy(r, x);
  });
}
void coadjoint_transposed(Library& l) {
  take(l, "coadjoint", "adjoint");
  change_results(l, {{"coadjoint", 0}}, transpose<6>);
}
void pitch_of_a_turn(Library& l) {
  change_results(l, {{"screw_parameters", 3}}, [](double* pitch) { *pitch *= 8 * std::atan(1.0); });
}
void position_rotation_velocity(Library& l) {
  const auto rows = [](double* v) { std::swap_ranges(v + 3, v + 6, v + 6); };
  const auto both = [](double* J) {
    std::swap_ranges(J + 27, J + 54, J + 54);
    for (int i = 0; i < 9; ++i) std::swap_ranges(J + 9 * i + 3, J + 9 * i + 6, J + 9 * i + 6);
  };
  const Places matrices = {{"se23_left_jacobian", 0}, {"se23_right_jacobian", 0}, {"se23_adjoint", 0}};
  change_arguments(l, {{"se23_exp", 0}, {"se23_left_jacobian", 0}, {"se23_right_jacobian", 0}}, rows);
  change_results(l, {{"se23_log", 0}}, rows), change_results(l, matrices, both);
}
void rotation_velocity_position(Library& l) {
  const auto rows = [](double* v) { std::swap_ranges(v, v + 3, v + 6); };
  const auto both = [](double* J) {
    std::swap_ranges(J, J + 27, J + 54);
    for (int i = 0; i < 9; ++i) std::swap_ranges(J + 9 * i, J + 9 * i + 3, J + 9 * i + 6);
  };
  const Places matrices = {{"se23_left_jacobian", 0}, {"se23_right_jacobian", 0}, {"se23_adjoint", 0}};
  change_arguments(l, {{"se23_exp", 0}, {"se23_left_jacobian", 0}, {"se23_right_jacobian", 0}}, rows);
  change_results(l, {{"se23_log", 0}}, rows), change_results(l, matrices, both);
}
void by_measurements(Library& l) {
  change_results(l, {{"forster_bias_jacobians", 0}, {"brossard_bias_jacobians", 0}}, [](double* D) {
    for (int i = 0; i < 45; ++i) D[i] = -D[i];
  });
}

}  // namespace liecheck::properties::conventions
