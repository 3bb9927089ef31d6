#include "altered_libraries.hpp"

#include <Eigen/Geometry>
#include <adapters/shapes.hpp>
#include <algorithm>
#include <numbers>

namespace liecheck::properties::conventions {
namespace {

using Function = std::function<Numbers(const Numbers&)>;
using Change = std::function<void(double*)>;
using adapters::Shape;
/// Operations, each with the offset of a value among its arguments or in its result.
using Places = std::vector<std::pair<std::string, std::ptrdiff_t>>;

template <class S, class R, class... A>
Function flat(R (*function)(A...)) {
  return [function](const Numbers& numbers) {
    std::vector<S> x(numbers.begin(), numbers.end());
    const S* at = x.data();
    const auto next = [&]<class T>(T*) {
      const T value = Shape<T>::get(at);
      at += Shape<T>::size;
      return value;
    };
    const std::tuple<std::remove_cvref_t<A>...> arguments{
        next(static_cast<std::remove_cvref_t<A>*>(nullptr))...};
    std::vector<S> result(Shape<R>::size);
    Shape<R>::put(std::apply(function, arguments), result.data());
    return Numbers(result.begin(), result.end());
  };
}

template <class S, const auto&... all>
Library of_slots(const Slots<S, all...>& slots) {
  Library l;
  const auto one = [&](const auto& operation) {
    if (slots[operation]) l[std::string(operation.name)] = flat<S>(slots[operation]);
  };
  (one(all), ...);
  return l;
}

void change_arguments(Library& l, const Places& where, const Change& change) {
  for (const auto& [name, offset] : where)
    if (l.contains(name))
      l[name] = [f = l[name], offset = offset, change](Numbers x) {
        change(x.data() + offset);
        return f(x);
      };
}
void change_results(Library& l, const Places& where, const Change& change) {
  for (const auto& [name, offset] : where)
    if (l.contains(name))
      l[name] = [f = l[name], offset = offset, change](const Numbers& x) {
        Numbers r = f(x);
        change(r.data() + offset);
        return r;
      };
}

}  // namespace

template <class S>
Library library(const SpatialSlots<S>& slots) {
  return of_slots<S>(slots);
}
template Library library(const SpatialSlots<float>&);
template Library library(const SpatialSlots<double>&);

Library correct() {
  for (const Subject<double>* s : subjects<double>())
    if (s->name == "liecheck") return of_slots<double>(s->operations);
  return {};
}

namespace {

void take(Library& l, const std::string& name, const std::string& other) {
  l[name] = correct()[other];
}

void exchange_halves(double* v) {
  std::swap_ranges(v, v + 3, v + 3);
}
void negate3(double* v) {
  for (int i = 0; i < 3; ++i) v[i] = -v[i];
}
void negate6(double* v) {
  negate3(v), negate3(v + 3);
}
template <int N, int D>
void scale(double* v) {
  for (int i = 0; i < 3; ++i) v[i] *= double(N) / D;
}
template <int N>
void transpose(double* v) {
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < i; ++j) std::swap(v[N * i + j], v[N * j + i]);
}

const Places quaternion_arguments{{"log3_quaternion", 0},       {"log3_any_norm", 0},
                                  {"rotate_point", 0},          {"rotate_point_any_norm", 0},
                                  {"quaternion_matrix", 0},     {"integrate", 3},
                                  {"integrate_any_norm", 3},    {"difference", 3},
                                  {"difference", 10},           {"difference_any_norm", 3},
                                  {"difference_any_norm", 10},  {"d_difference_arg0", 3},
                                  {"d_difference_arg0", 10},    {"d_difference_arg1", 3},
                                  {"d_difference_arg1", 10},    {"d_difference_any_norm", 3},
                                  {"d_difference_any_norm", 10}},
    quaternion_results{{"exp3_quaternion", 0}, {"integrate", 3}, {"integrate_any_norm", 3}},
    tangent_arguments{{"exp6", 0},
                      {"left_jacobian6", 0},
                      {"right_jacobian6", 0},
                      {"left_jacobian6_inverse", 0},
                      {"right_jacobian6_inverse", 0},
                      {"integrate", 7},
                      {"integrate_any_norm", 7},
                      {"d_integrate_arg0", 7},
                      {"d_integrate_arg1", 7}},
    tangent_results{{"log6", 0}, {"difference", 0}, {"difference_any_norm", 0}},
    twist_arguments{{"act_motion", 12},    {"act_inverse_motion", 12}, {"cross_motion", 0},
                    {"cross_motion", 6},   {"cross_force", 0},         {"momentum", 13},
                    {"kinetic_energy", 13}},
    twist_results{{"act_motion", 0}, {"act_inverse_motion", 0}, {"cross_motion", 0}},
    wrench_arguments{{"act_force", 12}, {"act_inverse_force", 12}, {"cross_force", 6}},
    wrench_results{{"act_force", 0}, {"act_inverse_force", 0}, {"cross_force", 0}, {"momentum", 0}},
    pose_arguments{{"log6", 0},
                   {"compose", 0},
                   {"compose", 12},
                   {"inverse", 0},
                   {"act_point", 0},
                   {"act_motion", 0},
                   {"act_inverse_motion", 0},
                   {"act_force", 0},
                   {"act_inverse_force", 0},
                   {"act_inertia", 0},
                   {"act_inverse_inertia", 0}},
    pose_results{{"exp6", 0}, {"compose", 0}, {"inverse", 0}},
    jacobians3{{"left_jacobian3", 0},
               {"right_jacobian3", 0},
               {"left_jacobian3_inverse", 0},
               {"right_jacobian3_inverse", 0}},
    jacobians6{{"left_jacobian6", 0},          {"right_jacobian6", 0},   {"left_jacobian6_inverse", 0},
               {"right_jacobian6_inverse", 0}, {"d_integrate_arg0", 0},  {"d_integrate_arg1", 0},
               {"d_difference_arg0", 0},       {"d_difference_arg1", 0}, {"d_difference_any_norm", 0}},
    configuration_arguments{{"integrate", 0},         {"integrate_any_norm", 0},  {"difference", 0},
                            {"difference", 7},        {"difference_any_norm", 0}, {"difference_any_norm", 7},
                            {"d_difference_arg0", 0}, {"d_difference_arg0", 7},   {"d_difference_arg1", 0},
                            {"d_difference_arg1", 7}},
    configuration_results{{"integrate", 0}, {"integrate_any_norm", 0}},
    body_arguments{{"act_inertia", 12},
                   {"act_inverse_inertia", 12},
                   {"momentum", 0},
                   {"kinetic_energy", 0},
                   {"inertia_matrix", 0}},
    body_results{{"act_inertia", 0}, {"act_inverse_inertia", 0}};

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

void w_first(Library& l) {
  l.erase("integrate_coefficient_jacobian");
  change_arguments(l, quaternion_arguments, [](double* q) { std::rotate(q, q + 1, q + 4); });
  change_results(l, quaternion_results, [](double* q) { std::rotate(q, q + 3, q + 4); });
}
void passive_quaternions(Library& l) {
  l.erase("integrate_coefficient_jacobian");
  change_arguments(l, quaternion_arguments, negate3);
  change_results(l, quaternion_results, negate3);
}
void twists_angular_first(Library& l) {
  l.erase("inertia_matrix");
  for (const Places& p : {tangent_arguments, twist_arguments}) change_arguments(l, p, exchange_halves);
  for (const Places& p : {tangent_results, twist_results}) change_results(l, p, exchange_halves);
}
void wrenches_moment_first(Library& l) {
  l.erase("inertia_matrix");
  change_arguments(l, wrench_arguments, exchange_halves);
  change_results(l, wrench_results, exchange_halves);
}
void columns(Library& l) {
  l.erase("integrate_coefficient_jacobian");
  change_arguments(l, pose_arguments, transpose<3>), change_arguments(l, {{"log3_matrix", 0}}, transpose<3>);
  change_results(l, pose_results, transpose<3>), change_results(l, jacobians3, transpose<3>);
  change_results(l, {{"exp3_matrix", 0}, {"quaternion_matrix", 0}}, transpose<3>);
  change_results(l, jacobians6, transpose<6>);
}
void passive_poses(Library& l) {
  const auto invert = [](double* x) {
    const Numbers r = correct()["inverse"](Numbers(x, x + 12));
    std::ranges::copy(r, x);
  };
  change_arguments(l, pose_arguments, invert), change_results(l, pose_results, invert);
}
void jacobians_angular_first(Library& l) {
  l.erase("integrate_coefficient_jacobian");
  change_results(l, jacobians6, [](double* J) {
    std::swap_ranges(J, J + 18, J + 18);
    for (int row = 0; row < 6; ++row) exchange_halves(J + 6 * row);
  });
}
void degrees(Library& l) {
  const auto to_radians = [](double* v) {
    for (int i = 0; i < 3; ++i) v[i] *= std::numbers::pi / 180;
  };
  const auto to_degrees = [](double* v) {
    for (int i = 0; i < 3; ++i) v[i] *= 180 / std::numbers::pi;
  };
  Places inside_arguments{{"exp3_quaternion", 0}, {"exp3_matrix", 0}}, inside_results = inside_arguments;
  for (auto [name, at] : jacobians3) inside_arguments.emplace_back(name, at);
  for (auto [name, at] : tangent_arguments) inside_arguments.emplace_back(name, at + 3);
  inside_results = {{"log3_quaternion", 0}, {"log3_any_norm", 0}, {"log3_matrix", 0}};
  for (auto [name, at] : tangent_results) inside_results.emplace_back(name, at + 3);
  change_arguments(l, inside_arguments, to_radians), change_results(l, inside_results, to_degrees);
}
void quaternion_before_p(Library& l) {
  for (const char* name :
       {"integrate_coefficient_jacobian", "d_difference_any_norm", "d_integrate_arg0", "d_integrate_arg1"})
    l.erase(name);
  change_arguments(l, configuration_arguments, [](double* q) { std::rotate(q, q + 4, q + 7); });
  change_results(l, configuration_results, [](double* q) { std::rotate(q, q + 3, q + 7); });
}
void inertia_about_the_origin(Library& l) {
  const auto moved = [](double sign) {
    return [sign](double* I) {
      const Eigen::Vector3d c(I[1], I[2], I[3]);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          I[4 + 3 * i + j] += sign * I[0] * ((i == j ? c.squaredNorm() : 0) - c[i] * c[j]);
    };
  };
  change_arguments(l, body_arguments, moved(-1)), change_results(l, body_results, moved(1));
}
void right_jacobian_is_left(Library& l) {
  take(l, "right_jacobian3", "left_jacobian3"), take(l, "right_jacobian6", "left_jacobian6");
  take(l, "right_jacobian3_inverse", "left_jacobian3_inverse");
  take(l, "right_jacobian6_inverse", "left_jacobian6_inverse");
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
void passive_rotation_matrices(Library& l) {
  change_arguments(l, {{"log3_matrix", 0}}, transpose<3>);
  change_results(l, {{"exp3_matrix", 0}, {"quaternion_matrix", 0}}, transpose<3>);
}
void exp_of_the_opposite(Library& l) {
  change_arguments(l, {{"exp3_quaternion", 0}, {"exp3_matrix", 0}}, negate3);
  change_arguments(l, {{"exp6", 0}}, negate6);
}
void opposite_tangents(Library& l) {
  change_arguments(l, tangent_arguments, negate6), change_results(l, tangent_results, negate6);
  change_arguments(l, {{"exp3_quaternion", 0}, {"exp3_matrix", 0}}, negate3);
  change_arguments(l, jacobians3, negate3);
  change_results(l, {{"log3_quaternion", 0}, {"log3_any_norm", 0}, {"log3_matrix", 0}}, negate3);
}
void left_jacobian_is_right(Library& l) {
  change_arguments(l, {{"left_jacobian3", 0}, {"left_jacobian3_inverse", 0}}, negate3);
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

}  // namespace liecheck::properties::conventions
