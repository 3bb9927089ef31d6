// Known bugs in the dynamics of trees: liecheck's algorithms with one fault each, modelled on real reports.

#include <bugs/on_trees.hpp>

namespace liecheck::properties {
namespace {

template <class S>
VecX<S> armature(const Tree<S>& tree) {
  VecX<S> all = VecX<S>::Zero(tree.nv);
  for (std::size_t i = 0; i < tree.joints.size(); ++i)
    if (const auto& j = tree.joints[i]; j.primary < 0)
      all.segment(tree.idx_v[i], velocity_size(j.kind)).setConstant(j.armature);
  return all;
}

/// Adds factor times the armature to the mass matrix.
template <class S>
void add_armature(TreeOperations<S>& o, const Tree<S>& tree, S factor) {
  o[op::tree_crba] = [crba = o[op::tree_crba],
                      more = VecX<S>(factor * armature(tree))](const VecX<S>& q) -> MatX<S> {
    MatX<S> sum = crba(q);
    sum.diagonal() += more;
    return sum;
  };
}

}  // namespace

template <class S>
auto Bugs<S>::dynamics_of_trees() -> Entries {
  return {
      {"tree_armature_twice", "the mass matrix contains the rotor inertia twice",
       "choreonoid/choreonoid issue 26",
       on_trees<S>([](TO& o, const T& tree) { add_armature(o, tree, S(1)); })},
      {"tree_mass_without_armature", "the mass matrix lacks the armature",
       "stack-of-tasks/pinocchio issue 671",
       on_trees<S>([](TO& o, const T& tree) { add_armature(o, tree, S(-1)); })},
      {"tree_torque_without_armature", "inverse dynamics lacks the rotor inertia",
       "rdiankov/openrave pull 600", on_trees<S>([](TO& o, const T& tree) {
         o[op::tree_rnea] = [o, less = armature(tree)](const X& q, const X& v, const X& a, int i,
                                                       const V6& F) -> X {
           return o[op::tree_rnea](q, v, a, i, F) - less.cwiseProduct(a);
         };
       })},
      {"tree_energy_without_armature", "the kinetic energy lacks the rotor inertia",
       "duburcqa/jiminy pull 18", on_trees<S>([](TO& o, const T& tree) {
         o[op::tree_kinetic_energy] = [o, less = armature(tree)](const X& q, const X& v) -> S {
           return o[op::tree_kinetic_energy](q, v) - less.dot(v.cwiseAbs2()) / S(2);
         };
       })},
      {"tree_gravity_sign", "gravity acts upward", "JuliaRobotics/RigidBodyDynamics.jl pull 2",
       on_trees<S>([](TO& o, const T& tree) {
         T up = tree;
         for (S& g : up.gravity.x) g = -g;
         const TO wrong = liecheck_tree<S>(up);
         o[op::tree_gravity] = wrong[op::tree_gravity],
         o[op::tree_nonlinear_effects] = wrong[op::tree_nonlinear_effects],
         o[op::tree_rnea] = wrong[op::tree_rnea];
       })},
      {"tree_coriolis_factor", "the Coriolis terms are halved", "RussTedrake/underactuated issue 81",
       on_trees<S>([](TO& o, const T&) {
         o[op::tree_nonlinear_effects] = [o](const X& q, const X& v) -> X {
           return (o[op::tree_nonlinear_effects](q, v) + o[op::tree_gravity](q)) / S(2);
         };
       })},
      {"tree_acceleration_lost", "accelerations of all joints except the first are ignored",
       "RobotLocomotion/drake issue 2201", on_trees<S>([](TO& o, const T& tree) {
         o[op::tree_rnea] = [o, n = velocity_size(tree.joints[0].kind)](const X& q, const X& v, const X& a,
                                                                        int i, const V6& F) -> X {
           X first = X::Zero(a.size());
           first.head(n) = a.head(n);
           return o[op::tree_rnea](q, v, first, i, F);
         };
       })},
      {"tree_damping", "inverse dynamics adds 0.001 diag(M) a, forward dynamics does not",
       "dartsim/dart issue 1450", on_trees<S>([](TO& o, const T&) {
         o[op::tree_rnea] = [o](const X& q, const X& v, const X& a, int i, const V6& F) -> X {
           return o[op::tree_rnea](q, v, a, i, F) + o[op::tree_crba](q).diagonal().cwiseProduct(a) / S(1000);
         };
       })},
      {"tree_derivative_at_rest", "the derivatives of inverse dynamics are taken at zero acceleration",
       "RobotLocomotion/drake issue 2201", on_trees<S>([](TO& o, const T&) {
         o[op::rnea_derivatives] = [o](const X& q, const X& v, const X& a, int i, const V6& F) {
           return o[op::rnea_derivatives](q, v, X::Zero(a.size()), i, F);
         };
       })},
  };
}

template <class S>
auto Bugs<S>::frames_of_trees() -> Entries {
  return {
      {"tree_spatial_for_classical", "the spatial acceleration is returned as the classical one",
       "dartsim/dart issue 294",
       on_trees<S>([](TO& o, const T&) { o[op::frame_classical_acceleration] = o[op::frame_acceleration]; })},
      {"tree_world_rate", "LOCAL_WORLD_ALIGNED returns the Jacobian rate of WORLD",
       "stack-of-tasks/pinocchio issue 1522", on_trees<S>([](TO& o, const T&) {
         o[op::frame_jacobian_rate] = [o](const X& q, const X& v, Seen s) -> M {
           return o[op::frame_jacobian_rate](q, v, s == Seen::aligned ? Seen::world : s);
         };
       })},
      {"tree_local_for_world", "WORLD returns the Jacobian of LOCAL", "stack-of-tasks/pinocchio issue 1525",
       on_trees<S>([](TO& o, const T&) {
         o[op::frame_jacobian] = [o](const X& q, Seen s) -> M {
           return o[op::frame_jacobian](q, s == Seen::world ? Seen::local : s);
         };
       })},
      {"tree_aligned_for_world", "WORLD returns the velocity of LOCAL_WORLD_ALIGNED",
       "stack-of-tasks/pinocchio issue 901", on_trees<S>([](TO& o, const T&) {
         o[op::frame_velocity] = [o](const X& q, const X& v, Seen s) -> V6 {
           return o[op::frame_velocity](q, v, s == Seen::world ? Seen::aligned : s);
         };
       })},
      {"tree_momentum_point", "the momentum map refers to another point",
       "stack-of-tasks/pinocchio issue 1828", on_trees<S>([](TO& o, const T&) {
         o[op::tree_momentum_map] = [o](const X& q) -> M {
           M A = o[op::tree_momentum_map](q);
           A.bottomRows(3) += A.topRows(3);
           return A;
         };
       })},
  };
}

template struct Bugs<float>;
template struct Bugs<double>;

}  // namespace liecheck::properties
