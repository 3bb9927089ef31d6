// Extended poses, preintegration, and derivatives of the motions and momenta of trees.

#include <history/history.hpp>

namespace liecheck::properties::history {
namespace {

using X = VecX<double>;
using M = MatX<double>;
using T = Tree<double>;
using TO = TreeOperations<double>;
using V9 = Vec<double, 9>;
using V15 = Vec<double, 15>;
using M9 = Mat<double, 9>;
using D = Mat<double, 15, 3>;

M3 turn_by(const V3& phi) {
  const double n = phi.norm();
  const M3 K = hat<double>(phi);
  if (n < 1e-8) return M3::Identity() + K + K * K / 2;
  const double half = std::sin(n / 2) / n;
  return M3::Identity() + std::sin(n) / n * K + 2 * half * half * K * K;
}
M3 right_jacobian(const V3& phi) {
  const double n = phi.norm(), x = n * n;
  const M3 K = hat<double>(phi);
  const double b = n < 0.01 ? 0.5 - x / 24 + x * x / 720 : (1 - std::cos(n)) / x,
               c = n < 0.01 ? 1. / 6 - x / 120 + x * x / 5040 : (n - std::sin(n)) / (x * n);
  return M3::Identity() - b * K + c * K * K;
}
V15 stored(const M3& R, const V3& p, const V3& v) {
  V15 x;
  for (int i = 0; i < 9; ++i) x[i] = R(i / 3, i % 3);
  x.segment<3>(9) = p, x.tail<3>() = v;
  return x;
}
V15 forster(const V9& w, const V9& a, const double& dt) {
  M3 R = M3::Identity();
  V3 p = V3::Zero(), v = p;
  for (int i = 0; i < 9; i += 3) {
    const V3 step = R * a.segment<3>(i);
    p += v * dt + step * dt * dt / 2, v += step * dt;
    R = (R * turn_by(dt * w.segment<3>(i))).eval();
  }
  return stored(R, p, v);
}
/// `jacobian` is J_r of each turn.
D forster_biases(const V9& w, const V9& a, double dt, M3 (*jacobian)(const V3&)) {
  M3 R = M3::Identity(), R_g = M3::Zero(), p_g = R_g, p_a = R_g, v_g = R_g, v_a = R_g;
  for (int i = 0; i < 9; i += 3) {
    const V3 phi = dt * w.segment<3>(i);
    const M3 turned = R * hat<double>(V3(a.segment<3>(i))) * R_g;
    p_g += dt * v_g - dt * dt / 2 * turned, p_a += dt * v_a - dt * dt / 2 * R;
    v_g -= dt * turned, v_a -= dt * R;
    R_g = (turn_by(phi).transpose() * R_g - dt * jacobian(phi)).eval();
    R = (R * turn_by(phi)).eval();
  }
  return (D() << R_g, p_g, p_a, v_g, v_a).finished();
}
M9 extended_adjoint(const V15& x, int column) {
  M3 R;
  for (int i = 0; i < 9; ++i) R(i / 3, i % 3) = x[i];
  M9 Ad = M9::Zero();
  for (int i = 0; i < 9; i += 3) Ad.block<3, 3>(i, i) = R;
  Ad.block<3, 3>(0, 6) = hat<double>(V3(x.segment<3>(9))) * R;
  Ad.block<3, 3>(3, column) += hat<double>(V3(x.tail<3>())) * R;
  return Ad;
}

std::vector<HistoricBug> navigation() {
  const auto row = rows_of(op::preintegrate_forster, forster);
  return {
      {"pylie_1", "pylie before 0.2", "pvangoor/pylie#1", "v != 0", "X exp(xi) X^-1 != exp(Ad xi)",
       "The block of the velocity stood in another column than that of the rotation.",
       forms(
           op::se23_adjoint, [](const V15& X) -> M9 { return extended_adjoint(X, 0); },
           [](const V15& X) -> M9 { return extended_adjoint(X, 6); })},
      row("kindyn_vio_35", "kindyn-vio", "ami-iit/kindyn-vio#35", "more than one measurement",
          "a wrong displacement",
          "The position was a multiple of a dt^2, without the velocity that has built up.",
          [](const V9& w, const V9& a, const double& dt) -> V15 {
            V15 x = forster(w, a, dt);
            V3 p = V3::Zero();
            M3 R = M3::Identity();
            for (int i = 0; i < 9; i += 3)
              p += 1.5 * dt * dt * (R * a.segment<3>(i)), R = (R * turn_by(dt * w.segment<3>(i))).eval();
            x.segment<3>(9) = p;
            return x;
          }),
      row("pypose_dcecb6f", "PyPose 0.6", "commit dcecb6f of pypose/pypose", "turns that do not commute",
          "the product in the wrong order", "The increments were multiplied on the left.",
          [](const V9& w, const V9& a, const double& dt) -> V15 {
            V15 x = forster(w, a, dt);
            M3 R = M3::Identity();
            for (int i = 0; i < 9; i += 3) R = (turn_by(dt * w.segment<3>(i)) * R).eval();
            for (int i = 0; i < 9; ++i) x[i] = R(i / 3, i % 3);
            return x;
          }),
      {"pypose_a2dfadf", "PyPose before 0.1", "commit a2dfadf of pypose/pypose", "all", "J_l for J_r",
       "The skew matrix was transposed, so that the right Jacobian became the left one.",
       forms(
           op::forster_bias_jacobians,
           [](const V9& w, const V9& a, const double& dt) -> D {
             return forster_biases(w, a, dt, [](const V3& phi) { return right_jacobian(-phi); });
           },
           [](const V9& w, const V9& a, const double& dt) -> D {
             return forster_biases(w, a, dt, right_jacobian);
           })},
  };
}

// Longer than 80 lines: one entry for each report.
std::vector<HistoricBug> derivatives() {
  const auto own = [](const auto& operation) {
    return [&operation](const T&, const TO& good) { return good[operation]; };
  };
  return {
      {"pinocchio_2702", "Pinocchio to 3.7", "stack-of-tasks/pinocchio#2702", "LOCAL_WORLD_ALIGNED",
       "dv/dq by the base's translation is not zero", "The reference point was held while q moved.",
       tree_forms(
           op::frame_velocity_derivatives,
           [](const T&, const TO& good) {
             return [good](const X& q, const X& v, Seen s) -> std::pair<M, M> {
               auto d = good[op::frame_velocity_derivatives](q, v, s);
               if (s != Seen::aligned) return d;
               const V3 omega = H::low(good[op::frame_velocity](q, v, s));
               const M J = good[op::frame_jacobian](q, s);
               for (int k = 0; k < J.cols(); ++k)
                 d.first.col(k).head<3>() -= omega.cross(V3(J.col(k).head<3>()));
               return d;
             };
           },
           own(op::frame_velocity_derivatives))},
      {"pinocchio_1473", "Pinocchio to 2.6.3", "stack-of-tasks/pinocchio#1473", "a momentum that is not zero",
       "angular rows differ", "The centre of mass did not move with q.",
       tree_forms(
           op::momentum_derivative,
           [](const T&, const TO& good) {
             return [good](const X& q, const X& v) -> M {
               M d = good[op::momentum_derivative](q, v);
               const M dc = good[op::tree_com_jacobian](q);
               const V3 l = H::top(good[op::tree_momentum](q, v));
               for (int k = 0; k < d.cols(); ++k) d.col(k).tail<3>() += V3(dc.col(k)).cross(l);
               return d;
             };
           },
           own(op::momentum_derivative))},
      {"pinocchio_1297", "a use of Pinocchio", "stack-of-tasks/pinocchio#1297", "m != 1", "off by the mass",
       "The linear rows of the centroidal map were not divided by the mass.",
       tree_forms(
           op::tree_com_jacobian,
           [](const T&, const TO& good) {
             return [good](const X& q) -> M { return good[op::tree_momentum_map](q).topRows(3); };
           },
           own(op::tree_com_jacobian))},
      {"rbdyn_eccbf26", "RBDyn, 2012", "commit eccbf26 of jrl-umi3218/RBDyn", "m is not the number of bodies",
       "a scaled centre", "The sum of the centres times masses was divided by the number of bodies.",
       tree_forms(
           op::tree_center_of_mass,
           [](const T& tree, const TO& good) {
             double mass = 0;
             for (const auto& j : tree.joints) mass += j.body.mass;
             return [good, factor = mass / static_cast<double>(tree.joints.size())](const X& q) -> V3 {
               return factor * good[op::tree_center_of_mass](q);
             };
           },
           own(op::tree_center_of_mass))},
      {"rigidbodydynamics_2", "RigidBodyDynamics.jl, 2016", "JuliaRobotics/RigidBodyDynamics.jl#2", "g != 0",
       "torques of the wrong sign", "The acceleration of the root was set to +g.",
       tree_forms(
           op::tree_static_torque,
           [](const T& tree, const TO&) {
             T up = tree;
             for (double& g : up.gravity.x) g = -g;
             return correct_tree(up)[op::tree_static_torque];
           },
           own(op::tree_static_torque))},
      {"idyntree_1283", "iDynTree, in review", "gbionics/idyntree#1283", "v != 0", "M' != C + C^T",
       "The factor of each body was not the one that Christoffel's symbols have.",
       tree_forms(
           op::tree_coriolis,
           [](const T&, const TO& good) {
             return [good](const X& q, const X& v) -> M {  // another C with the same C v
               const M C = good[op::tree_coriolis](q, v);
               const X h = C * v;
               return h * v.transpose() / std::max(v.squaredNorm(), 1e-300);
             };
           },
           own(op::tree_coriolis))},
      {"pinocchio_639", "Pinocchio before 2.1.3", "stack-of-tasks/pinocchio#639", "after RNEA's derivatives",
       "the derivative contains gravity", "One variable held the acceleration with and without gravity.",
       tree_forms(
           op::frame_acceleration_derivatives,
           [](const T& tree, const TO& good) {
             const V3 g(tree.gravity[0], tree.gravity[1], tree.gravity[2]);
             return [good, g](const X& q, const X& v, const X& a, Seen s) -> std::pair<M, M> {
               auto d = good[op::frame_acceleration_derivatives](q, v, a, s);
               const M J = good[op::frame_jacobian](q, s);
               for (int k = 0; k < J.cols(); ++k) d.first.col(k).head<3>() += g.cross(V3(J.col(k).tail<3>()));
               return d;
             };
           },
           own(op::frame_acceleration_derivatives))},
  };
}

const HistoryRows navigation_rows(navigation), derivative_rows(derivatives);

}  // namespace
}  // namespace liecheck::properties::history
