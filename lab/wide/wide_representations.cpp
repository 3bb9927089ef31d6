// Representations of rotations, adjoints, means, interpolation and inertial navigation at 100 digits.

#include <oracles/representations.hpp>
#include <wide/wide_case.hpp>

namespace liecheck::properties {

using namespace wide_case;

namespace {

namespace parameters = oracles::representation_formulas;

V3 times(const Wide& s, const V3& v) {
  return s * v;
}
V3 log_of(const V4& Q) {
  return tail3(closed_log(oracles::normalized(Q), zero()));
}
/// The turn about an axis of any length.
V4 turn(const V3& axis, const Wide& angle) {
  return exp3(times(Wide(angle / norm(axis)), axis));
}
void compare_pair(Case& c, const V3& exact) {
  const V3 axis = c.y.read<V3>();
  const Wide angle = c.y.read<Wide>(), length = norm(axis);
  c.relative(block::rotation_vector, times(Wide(angle / length), axis), exact);
  c.distance(block::norm_defect, abs(length - 1));
}
void compare_gram_schmidt(Case& c) {
  const M3 A = c.x.read<M3>();
  V3 columns[3];
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) columns[j][i] = A(i, j);
    for (int k = 0; k < j; ++k) columns[j] = columns[j] - times(dot(columns[k], columns[j]), columns[k]);
    columns[j] = times(Wide(1 / norm(columns[j])), columns[j]);
  }
  M3 exact;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) exact(i, j) = columns[j][i];
  c.matrix(nearest_quaternion(exact).Q);
}

void compare_coadjoint(Case& c) {
  const PoseValue X = c.x.read<PoseValue>();
  const M6 Y = c.y.read<M6>();
  const auto error = [&](int i) { return Wide(norm(oracles::block(Y, i, i) - X.R) / norm(X.R)); };
  c.distance(block::jacobian, std::max(error(0), error(1)));
  c.relative(block::coupling, oracles::block(Y, 1, 0), M3(oracles::hat(X.p) * X.R));
}
M6 adjoint(const PoseValue& X) {
  return oracles::assemble(X.R, M3(oracles::hat(X.p) * X.R), oracles::zeros<3, 3, Wide>(), X.R);
}
void compare_covariance(Case& c) {
  const PoseValue X = c.x.read<PoseValue>();
  const M6 S = c.x.read<M6>(), Y = c.y.read<M6>(), Ad = adjoint(X), exact = Ad * S * transpose(Ad);
  const auto size = [&](int i, int j) { return Wide(norm(oracles::block(S, i, j))); };
  const Wide p = norm(X.p), scales[2] = {size(0, 0) + 2 * p * size(0, 1) + p * p * size(1, 1), size(1, 1)};
  Wide error(0), skew(0);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const Wide scale = scales[i / 3] * scales[j / 3], d = Y(i, j) - exact(i, j), s = Y(i, j) - Y(j, i);
      error += d * d / scale, skew += s * s / scale;
    }
  c.distance(block::matrix, sqrt(error));
  c.distance(block::symmetry, sqrt(skew));
}
void compare_screw(Case& c) {
  const V6 V = c.x.read<V6>();
  const V3 u = head3(V), omega = tail3(V);
  const Wide square = squared_norm(omega), scale = norm(u) / sqrt(square);
  c.distance(block::direction, norm(c.y.read<V3>() - times(Wide(1 / sqrt(square)), omega)));
  c.relative(block::pitch, oracles::Vec<1, Wide>{{c.y.read<Wide>()}},
             oracles::Vec<1, Wide>{{dot(u, omega) / square}}, scale);
  c.relative(block::point, c.y.read<V3>(), times(Wide(1 / square), cross(omega, u)), scale);
}

// Means of three.
/// Squares of M / |M| tend to the projection on the eigenvector of the largest eigenvalue.
V4 chordal_mean(const std::array<V4, 3>& all, const V3& weights) {
  oracles::Mat<4, 4, Wide> M = oracles::zeros<4, 4, Wide>();
  for (std::size_t n = 0; n < 3; ++n)
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) M(i, j) += weights[int(n)] * all[n][i] * all[n][j];
  for (int step = 0; step < 500; ++step) M = Wide(1 / norm(M)) * (M * M);
  int largest = 0;
  for (int i = 1; i < 4; ++i)
    if (M(largest, largest) < M(i, i)) largest = i;
  V4 Q;
  for (int i = 0; i < 4; ++i) Q[i] = M(i, largest);
  return oracles::normalized(Q);
}
/// T is moved by the mean of the logarithms, until it stays.
V7 geodesic_mean(const std::array<V7, 3>& all, const V3& weights) {
  std::array<V4, 3> rotations;
  for (std::size_t i = 0; i < 3; ++i) rotations[i] = oracles::normalized(quaternion_of(all[i]));
  const V4 start = chordal_mean(rotations, weights);
  V7 T = all[0];
  for (int i = 0; i < 4; ++i) T[3 + i] = start[i];
  for (int step = 0; step < 2000; ++step) {
    V6 mean = oracles::zero_vector<6, Wide>();
    for (std::size_t i = 0; i < 3; ++i)
      mean = mean +
             Wide(weights[int(i)] / (weights[0] + weights[1] + weights[2])) * closed_difference(T, all[i]);
    const auto next = closed_integrate(T, mean);
    for (int i = 0; i < 3; ++i) T[i] = next.p[i];
    for (int i = 0; i < 4; ++i) T[3 + i] = next.Q[i];
    if (norm(mean) <= Wide(1e-90) * (1 + norm(head3(T)))) break;
  }
  return T;
}
/// Whether the rotations are within 2 rad of one another, so that the logarithms sum to zero from one mean only.
bool have_one_mean(const std::array<V4, 3>& Q) {
  static const Wide cosine = cos(Wide(1));
  const auto near = [](const V4& a, const V4& b) { return abs(conjugate_product(a, b)[3]) >= cosine; };
  return near(Q[0], Q[1]) && near(Q[1], Q[2]) && near(Q[2], Q[0]);
}
template <class Mean>
void compare_mean_rotation(Case& c, Mean mean, bool geodesic) {
  std::array<V4, 3> Q;
  for (V4& q : Q) q = oracles::normalized(c.x.read<V4>());
  if (geodesic && !have_one_mean(Q)) return;
  const V4 exact = mean(Q, c.x.read<V3>()), computed = c.y.read<V4>();
  c.rotation(computed, exact);
  c.distance(block::norm_defect, abs(squared_norm(computed) - 1));
}
V4 geodesic_mean_of(const std::array<V4, 3>& Q, const V3& weights) {
  std::array<V7, 3> poses;
  for (std::size_t i = 0; i < 3; ++i)
    poses[i] = {{Wide(0), Wide(0), Wide(0), Q[i][0], Q[i][1], Q[i][2], Q[i][3]}};
  return quaternion_of(geodesic_mean(poses, weights));
}
void pose_of(Case& c, const V4& Q, const V3& p, const Wide& scale) {
  const V7 computed = c.y.read<V7>();
  c.rotation(quaternion_of(computed), Q);
  c.relative(block::translation, head3(computed), p, scale);
  c.distance(block::norm_defect, abs(squared_norm(quaternion_of(computed)) - 1));
}
void compare_mean_pose(Case& c) {
  std::array<V7, 3> poses;
  Wide scale(0);
  for (V7& pose : poses) pose = c.x.read<V7>(), scale = std::max(scale, Wide(norm(head3(pose))));
  if (!have_one_mean({oracles::normalized(quaternion_of(poses[0])),
                      oracles::normalized(quaternion_of(poses[1])),
                      oracles::normalized(quaternion_of(poses[2]))}))
    return;
  const V7 exact = geodesic_mean(poses, c.x.read<V3>());
  pose_of(c, quaternion_of(exact), head3(exact), scale);
}
void compare_interpolate(Case& c) {
  const V7 q0 = c.x.read<V7>(), q1 = c.x.read<V7>();
  const auto exact = closed_integrate(q0, c.x.read<Wide>() * closed_difference(q0, q1));
  pose_of(c, exact.Q, exact.p, std::max(Wide(norm(head3(q0))), Wide(norm(head3(q1)))));
}
void compare_angle(Case& c) {
  const V3 a = c.x.read<V3>(), b = c.x.read<V3>();
  const auto terms = [&](int i, int j) { return Wide(abs(a[i] * b[j]) + abs(a[j] * b[i])); };
  c.relative(block::angle, oracles::Vec<1, Wide>{{c.y.read<Wide>()}},
             oracles::Vec<1, Wide>{{atan2(norm(cross(a, b)), dot(a, b))}},
             norm(V3{{terms(1, 2), terms(2, 0), terms(0, 1)}}));
}
void compare_directions(Case& c) {
  V3 a = c.x.read<V3>(), b = c.x.read<V3>();
  a = times(Wide(1 / norm(a)), a), b = times(Wide(1 / norm(b)), b);
  const Wide t = c.x.read<Wide>(), theta = atan2(norm(cross(a, b)), dot(a, b));
  const V3 computed = c.y.read<V3>(), exact = theta == 0 ? a
                                                         : times(Wide(sin((1 - t) * theta) / sin(theta)), a) +
                                                               times(Wide(sin(t * theta) / sin(theta)), b);
  c.distance(block::direction, norm(times(Wide(1 / norm(computed)), computed) - exact));
  c.distance(block::norm_defect, abs(norm(computed) - 1));
}

// Inertial navigation. An extended tangent (rho, nu, phi) is two tangents of poses with one rotation vector.
std::pair<V6, V6> tangents(Case& c) {
  const V3 rho = c.x.read<V3>(), nu = c.x.read<V3>(), phi = c.x.read<V3>();
  return {stack(rho, phi), stack(nu, phi)};
}
void compare_extended_exp(Case& c) {
  const auto [first, second] = tangents(c);
  c.pose(closed_exp(first));
  c.relative(block::velocity, c.y.read<V3>(), closed_exp(second).p);
}
void compare_extended_log(Case& c) {
  const V4 Q = nearest_quaternion(c.x.read<M3>()).Q;
  const V3 p = c.x.read<V3>(), v = c.x.read<V3>();
  const V6 first = closed_log(Q, p), second = closed_log(Q, v);
  c.relative(block::linear, c.y.read<V3>(), head3(first));
  c.relative(block::velocity, c.y.read<V3>(), head3(second));
  c.relative(block::rotation_vector, c.y.read<V3>(), tail3(first));
}
void compare_nine(Case& c, const M3& J, const M3& first, const M3& second) {
  const auto D = c.y.read<oracles::Mat<9, 9, Wide>>();
  const auto own = [&](int i, int j) {
    M3 part;
    for (int k = 0; k < 9; ++k) part(k / 3, k % 3) = D(3 * i + k / 3, 3 * j + k % 3);
    return part;
  };
  Wide worst(0);
  for (int i = 0; i < 3; ++i) worst = std::max(worst, Wide(norm(own(i, i) - J) / norm(J)));
  c.distance(block::jacobian, worst);
  const auto error = [&](int i, const M3& exact) {
    const Wide size = norm(exact), distance = norm(own(i, 2) - exact);
    return size > 0 ? Wide(distance / size) : distance;
  };
  c.distance(block::coupling, std::max(error(0, first), error(1, second)));
}
template <int sign>
void compare_extended_jacobian(Case& c) {
  const auto [first, second] = tangents(c);
  const auto a = closed_left_jacobian(V6(Wide(sign) * first)),
             b = closed_left_jacobian(V6(Wide(sign) * second));
  compare_nine(c, a.J, a.C, b.C);
}
void compare_extended_adjoint(Case& c) {
  const PoseValue X = c.x.read<PoseValue>();
  const V3 v = c.x.read<V3>();
  compare_nine(c, X.R, M3(oracles::hat(X.p) * X.R), M3(oracles::hat(v) * X.R));
}

/// The matrix sum_k [phi]^k m!/(k + m)!.
M3 series(int m, const V3& phi) {
  const M3 K = oracles::hat(phi);
  M3 sum = oracles::identity<3, Wide>(), term = sum;
  for (int k = 1; k < 400 && norm(term) > Wide(1e-105); ++k)
    term = Wide(1 / Wide(k + m)) * (K * term), sum = sum + term;
  return sum;
}
struct Increment {
  M3 R = oracles::identity<3, Wide>();
  V3 p = zero(), v = zero();
};
struct Measured {
  V3 gyro[3], force[3];
  Wide dt, size;
  explicit Measured(Case& c) {
    for (V3& x : gyro) x = c.x.read<V3>();
    for (V3& x : force) x = c.x.read<V3>();
    dt = c.x.read<Wide>();
    size = norm(force[0]) + norm(force[1]) + norm(force[2]);
  }
  Increment increment(bool exact, const V3& b_g, const V3& b_a) const {
    Increment s;
    for (int n = 0; n < 3; ++n) {
      const V3 phi = dt * (gyro[n] - b_g), a = force[n] - b_a, held = exact ? phi : zero();
      s.p = s.p + dt * s.v + Wide(dt * dt / 2) * (s.R * (series(2, held) * a));
      s.v = s.v + dt * (s.R * (series(1, held) * a));
      s.R = s.R * series(0, phi);
    }
    return s;
  }
};
template <bool exact>
void compare_increment(Case& c) {
  const Measured m(c);
  const Increment s = m.increment(exact, zero(), zero());
  c.matrix(nearest_quaternion(s.R).Q);
  c.relative(block::translation, c.y.read<V3>(), s.p, Wide(m.size * m.dt * m.dt));
  c.relative(block::velocity, c.y.read<V3>(), s.v, Wide(m.size * m.dt));
}
/// Central differences with a step of 1e-30, right to 1e-60.
template <bool exact>
void compare_biases(Case& c) {
  const Measured m(c);
  M3 all[5];
  const M3 R = m.increment(exact, zero(), zero()).R;
  const Wide h(1e-30);
  for (int j = 0; j < 3; ++j)
    for (const bool of_gyro : {true, false}) {
      V3 step = zero();
      step[j] = h;
      const auto at = [&](int sign) {
        const V3 b = Wide(sign) * step;
        return of_gyro ? m.increment(exact, b, zero()) : m.increment(exact, zero(), b);
      };
      const Increment up = at(1), down = at(-1);
      const auto put = [&](int i, const V3& change) {
        for (int k = 0; k < 3; ++k) all[i](k, j) = change[k] / (2 * h);
      };
      put(of_gyro ? 1 : 2, up.p - down.p), put(of_gyro ? 3 : 4, up.v - down.v);
      if (!of_gyro) continue;
      const M3 turned = transpose(R) * (up.R - down.R);
      put(0, V3{{turned(2, 1), turned(0, 2), turned(1, 0)}});
    }
  const auto error = [&](const M3& right, const Wide& scale) {
    return Wide(norm(c.y.read<M3>() - right) / std::max(Wide(norm(right)), scale));
  };
  const Wide& t = m.dt;
  c.distance(block::rotation, error(all[0], Wide(0)));
  const Wide p_g = error(all[1], Wide(m.size * t * t * t)), p_a = error(all[2], Wide(t * t));
  c.distance(block::translation, std::max(p_g, p_a));
  const Wide v_g = error(all[3], Wide(m.size * t * t)), v_a = error(all[4], t);
  c.distance(block::velocity, std::max(v_g, v_a));
}

}  // namespace

std::vector<Comparison> comparisons_of_representations() {
  using Blocks = oracles::JacobianBlocks<Wide>;
  return {{&op::quaternion_from_matrix,
           against(&Case::quaternion, [](const M3& R) { return V4(nearest_quaternion(R).Q); })},
          {&op::matrix_from_quaternion,
           against(&Case::matrix, [](const V4& Q) { return oracles::normalized(Q); })},
          {&op::quaternion_product,
           against(&Case::quaternion,
                   [](const V4& a, const V4& b) { return oracles::normalized(quaternion_product(a, b)); })},
          {&op::quaternion_inverse, against(&Case::quaternion,
                                            [](const V4& Q) {
                                              return oracles::normalized(V4{{-Q[0], -Q[1], -Q[2], Q[3]}});
                                            })},
          {&op::axis_angle_from_quaternion, [](Case& c) { compare_pair(c, log_of(c.x.read<V4>())); }},
          {&op::axis_angle_from_matrix,
           [](Case& c) { compare_pair(c, log_of(nearest_quaternion(c.x.read<M3>()).Q)); }},
          {&op::quaternion_from_axis_angle, against(&Case::quaternion, turn)},
          {&op::matrix_from_axis_angle, against(&Case::matrix, turn)},
          {&op::gibbs_from_quaternion,
           [](Case& c) {
             const V4 Q = c.x.read<V4>();
             c.relative(block::parameters, c.y.read<V3>(), times(Wide(1 / Q[3]), head3(Q)));
           }},
          {&op::mrp_from_quaternion,
           [](Case& c) {
             c.relative(block::parameters, c.y.read<V3>(), parameters::modified_rodrigues(c.x.read<V4>()));
           }},
          {&op::quaternion_from_gibbs, against(&Case::quaternion,
                                               [](const V3& g) {
                                                 return oracles::normalized(V4{{g[0], g[1], g[2], Wide(1)}});
                                               })},
          {&op::quaternion_from_mrp, against(&Case::quaternion, parameters::from_modified_rodrigues<Wide>)},
          {&op::nearest_rotation,
           against(&Case::matrix, [](const M3& A) { return V4(nearest_quaternion(A).Q); })},
          {&op::gram_schmidt, compare_gram_schmidt},
          {&op::adjoint, against(&Case::jacobian6,
                                 [](const PoseValue& X) {
                                   return Blocks{X.R, M3(oracles::hat(X.p) * X.R)};
                                 })},
          {&op::coadjoint, compare_coadjoint},
          {&op::small_adjoint, against(&Case::jacobian6,
                                       [](const V6& V) {
                                         return Blocks{oracles::hat(tail3(V)), oracles::hat(head3(V))};
                                       })},
          {&op::transport_covariance, compare_covariance},
          {&op::screw_parameters, compare_screw},
          {&op::mean_rotation, [](Case& c) { compare_mean_rotation(c, chordal_mean, false); }},
          {&op::geodesic_mean, [](Case& c) { compare_mean_rotation(c, geodesic_mean_of, true); }},
          {&op::mean_pose, compare_mean_pose},
          {&op::interpolate, compare_interpolate},
          {&op::angle_between, compare_angle},
          {&op::slerp_directions, compare_directions},
          {&op::se23_exp, compare_extended_exp},
          {&op::se23_log, compare_extended_log},
          {&op::se23_left_jacobian, compare_extended_jacobian<1>},
          {&op::se23_right_jacobian, compare_extended_jacobian<-1>},
          {&op::se23_adjoint, compare_extended_adjoint},
          {&op::preintegrate_forster, compare_increment<false>},
          {&op::preintegrate_brossard, compare_increment<true>},
          {&op::forster_bias_jacobians, compare_biases<false>},
          {&op::brossard_bias_jacobians, compare_biases<true>}};
}

}  // namespace liecheck::properties
