// Known bugs in extended poses and preintegration, and in the derivatives of trees.

#include <bugs/on_trees.hpp>

namespace liecheck::properties {

template <class S>
auto Bugs<S>::navigation() -> Entries {
  using V9 = Vec<S, 9>;
  using V15 = Vec<S, 15>;
  using M9 = Mat<S, 9>;
  using D = Mat<S, 15, 3>;
  return {
      {"se23_exp_plain_velocity", "the velocity is nu, without J_l", "borglab/gtsam issue 2241",
       changed<op::se23_exp>([](V15& X, const V9& xi) { X.template tail<3>() = xi.template segment<3>(3); })},
      {"se23_log_plain_velocity", "nu is v", "NorthCarolinaRivalRobotics/tide issue 23",
       changed<op::se23_log>([](V9& xi, const V15& X) { xi.template segment<3>(3) = X.template tail<3>(); })},
      {"se23_jacobian_blocks", "the blocks of position and velocity are exchanged", "pvangoor/pylie issue 1",
       changed<op::se23_left_jacobian>([](M9& J, const V9&) {
         const M3 A = J.template block<3, 3>(0, 6);
         J.template block<3, 3>(0, 6) = J.template block<3, 3>(3, 6), J.template block<3, 3>(3, 6) = A;
       })},
      {"se23_right_is_left", "J_l for J_r", "pypose/pypose commit a2dfadf1", op::se23_right_jacobian,
       [](const V9& xi) -> M9 { return good()[op::se23_left_jacobian](xi); }},
      {"se23_adjoint_column", "[v] R stands in the column of the velocity", "pvangoor/pylie issue 1",
       changed<op::se23_adjoint>([](M9& Ad, const V15&) {
         Ad.template block<3, 3>(3, 3) += Ad.template block<3, 3>(3, 6),
             Ad.template block<3, 3>(3, 6).setZero();
       })},
      {"forster_without_half", "dp += dv dt, without a dt^2 / 2", "ami-iit/kindyn-vio issue 35",
       changed<op::preintegrate_forster>([](V15& x, const V9&, const V9& a, const S& dt) {
         x.template segment<3>(9) -= dt * dt / S(2) * a.template head<3>();
       })},
      {"forster_order", "increments of rotation are multiplied on the left", "pypose/pypose commit dcecb6fb",
       changed<op::preintegrate_forster>([](V15& x, const V9& w, const V9&, const S& dt) {
         M3 R = M3::Identity();
         for (int i = 0; i < 3; ++i)
           R = (good()[op::exp3_matrix](dt * w.template segment<3>(3 * i)) * R).eval();
         for (int i = 0; i < 9; ++i) x[i] = R(i / 3, i % 3);
       })},
      {"brossard_is_forster", "G_1 = I and G_2 = I/2", "a step of Euler for the exact integral",
       op::preintegrate_brossard,
       [](const V9& w, const V9& a, const S& dt) -> V15 {
         return good()[op::preintegrate_forster](w, a, dt);
       }},
      {"forster_bias_left_jacobian", "J_l for J_r", "pypose/pypose commit a2dfadf1",
       changed<op::forster_bias_jacobians>([](D& x, const V9& w, const V9&, const S& dt) {
         const V3 last = dt * w.template tail<3>();
         x.template topRows<3>() +=
             dt * (good()[op::right_jacobian3](last) - good()[op::left_jacobian3](last));
       })},
      {"brossard_bias_of_forster", "the derivatives of Forster's recursion",
       "the first-order terms of the exact integral", op::brossard_bias_jacobians,
       [](const V9& w, const V9& a, const S& dt) -> D {
         return good()[op::forster_bias_jacobians](w, a, dt);
       }},
      {"bias_sign", "the derivative by the measurement for that by the bias", "OB_GINS issue 14",
       changed<op::forster_bias_jacobians>([](D& x, const V9&, const V9&, const S&) { x = -x; })},
  };
}

// Longer than 80 lines: a list of independent bugs.
template <class S>
auto Bugs<S>::derivatives_of_trees() -> Entries {
  return {
      {"static_gravity_sign", "gravity acts upward", "JuliaRobotics/RigidBodyDynamics.jl issue 2",
       on_trees<S>([](TO& o, const T& tree) {
         T up = tree;
         for (S& g : up.gravity.x) g = -g;
         o[op::tree_static_torque] = liecheck_tree<S>(up)[op::tree_static_torque];
       })},
      {"static_derivative_without_wrench", "the derivative of gravity alone",
       "stack-of-tasks/pinocchio, computeStaticTorqueDerivatives", on_trees<S>([](TO& o, const T&) {
         o[op::static_torque_derivative] = [o](const X& q, int, const V6& F) -> M {
           return o[op::static_torque_derivative](q, -1, F);
         };
       })},
      {"coriolis_rank_one", "h v^T/(v . v), which gives h and no rate of M",
       "robotology/urdf2casadi-matlab issue 10", on_trees<S>([](TO& o, const T&) {
         o[op::tree_coriolis] = [o](const X& q, const X& v) -> M {
           const X h = o[op::tree_nonlinear_effects](q, v) - o[op::tree_gravity](q);
           return h * v.transpose() / std::max(v.squaredNorm(), std::numeric_limits<S>::min());
         };
       })},
      {"coriolis_transposed", "C^T", "robotology/idyntree pull 1283", on_trees<S>([](TO& o, const T&) {
         o[op::tree_coriolis] = [o](const X& q, const X& v) -> M {
           return o[op::tree_coriolis](q, v).transpose();
         };
       })},
      {"com_of_body_count", "the sum of centres is divided by the number of bodies",
       "jrl-umi3218/RBDyn commit eccbf26", on_trees<S>([](TO& o, const T& tree) {
         S mass(0);
         for (const auto& j : tree.joints) mass += j.body.mass;
         const S factor = mass / S(tree.joints.size());
         o[op::tree_center_of_mass] = [o, factor](const X& q) -> V3 {
           return factor * o[op::tree_center_of_mass](q);
         };
       })},
      {"com_jacobian_without_division", "the linear rows of A_g, not divided by the mass",
       "stack-of-tasks/pinocchio issue 1297", on_trees<S>([](TO& o, const T&) {
         o[op::tree_com_jacobian] = [o](const X& q) -> M { return o[op::tree_momentum_map](q).topRows(3); };
       })},
      {"momentum_derivative_fixed_centre", "the centre of mass does not move with q",
       "stack-of-tasks/pinocchio issue 1473", on_trees<S>([](TO& o, const T&) {
         o[op::momentum_derivative] = [o](const X& q, const X& v) -> M {
           M D = o[op::momentum_derivative](q, v);
           const M dc = o[op::tree_com_jacobian](q);
           const V3 l = top(o[op::tree_momentum](q, v));
           for (int k = 0; k < D.cols(); ++k) D.col(k).template tail<3>() += V3(dc.col(k)).cross(l);
           return D;
         };
       })},
      {"momentum_rate_half", "the derivative by v lacks the factor 2 of the Coriolis terms",
       "RobotLocomotion/drake issue 8194", on_trees<S>([](TO& o, const T&) {
         o[op::momentum_rate_derivatives] = [o](const X& q, const X& v, const X& a) -> std::pair<M, M> {
           auto D = o[op::momentum_rate_derivatives](q, v, a);
           return {D.first, D.second / S(2)};
         };
       })},
      {"frame_velocity_fixed_lever", "in LOCAL_WORLD_ALIGNED the reference point does not move with q",
       "stack-of-tasks/pinocchio issue 2702", on_trees<S>([](TO& o, const T&) {
         o[op::frame_velocity_derivatives] = [o](const X& q, const X& v, Seen s) -> std::pair<M, M> {
           auto D = o[op::frame_velocity_derivatives](q, v, s);
           if (s != Seen::aligned) return D;
           const V3 omega = low(o[op::frame_velocity](q, v, s));
           const M J = o[op::frame_jacobian](q, s);
           for (int k = 0; k < J.cols(); ++k)
             D.first.col(k).template head<3>() -= omega.cross(V3(J.col(k).template head<3>()));
           return D;
         };
       })},
      {"frame_acceleration_by_v", "twice the rate of J, which is right for one joint only",
       "stack-of-tasks/pinocchio commit 05a7e030", on_trees<S>([](TO& o, const T&) {
         o[op::frame_acceleration_derivatives] = [o](const X& q, const X& v, const X& a,
                                                     Seen s) -> std::pair<M, M> {
           auto D = o[op::frame_acceleration_derivatives](q, v, a, s);
           return {D.first, S(2) * o[op::frame_jacobian_rate](q, v, s)};
         };
       })},
      {"frame_acceleration_with_gravity", "the acceleration contains gravity",
       "stack-of-tasks/pinocchio issue 639", on_trees<S>([](TO& o, const T&) {
         o[op::frame_acceleration_derivatives] = [o](const X& q, const X& v, const X& a,
                                                     Seen s) -> std::pair<M, M> {
           auto D = o[op::frame_acceleration_derivatives](q, v, a, s);
           const M J = o[op::frame_jacobian](q, s);
           for (int k = 0; k < J.cols(); ++k)
             D.first.col(k).template head<3>() += V3(J.col(k).template tail<3>()).cross(V3(0, 0, S(9.81)));
           return D;
         };
       })},
      {"operational_inertia_inverse", "J M^-1 J^T, not inverted", "Khatib 1987, the inverse is left out",
       on_trees<S>([](TO& o, const T&) {
         o[op::operational_inertia] = [o](const X& q, Seen s) -> M6 {
           return o[op::operational_inertia](q, s).inverse();
         };
       })},
  };
}

template struct Bugs<float>;
template struct Bugs<double>;

}  // namespace liecheck::properties
