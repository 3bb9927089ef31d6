#include <subjects/tree_bugs.hpp>

#include <subjects/liecheck_trees.hpp>

namespace liecheck::properties {
namespace {

template <class S>
struct Planted {
  using T = Tree<S>;
  using O = TreeOperations<S>;
  using X = VecX<S>;
  using M = MatX<S>;
  using V6 = Vec<S, 6>;

  static X armature(const T& tree) {
    X all = X::Zero(tree.nv);
    for (std::size_t i = 0; i < tree.joints.size(); ++i)
      if (const auto& j = tree.joints[i]; j.primary < 0)
        all.segment(tree.idx_v[i], velocity_size(j.kind)).setConstant(j.armature);
    return all;
  }
  static O with_armature(const T& tree, S factor) {
    O o = liecheck_tree<S>(tree);
    o[op::tree_crba] = [crba = o[op::tree_crba], more = X(factor * armature(tree))](const X& q) -> M {
      M sum = crba(q);
      sum.diagonal() += more;
      return sum;
    };
    return o;
  }
  static O rnea_without_armature(const T& tree) {
    O o = liecheck_tree<S>(tree);
    o[op::tree_rnea] = [rnea = o[op::tree_rnea], less = armature(tree)](const X& q, const X& v, const X& a,
                                                                        int i, const V6& F) -> X {
      return rnea(q, v, a, i, F) - less.cwiseProduct(a);
    };
    return o;
  }
  static O gravity_sign(const T& tree) {
    T up = tree;
    for (S& g : up.gravity.x) g = -g;
    O o = liecheck_tree<S>(tree), wrong = liecheck_tree<S>(up);
    o[op::tree_gravity] = wrong[op::tree_gravity],
    o[op::tree_nonlinear_effects] = wrong[op::tree_nonlinear_effects],
    o[op::tree_rnea] = wrong[op::tree_rnea];
    return o;
  }
  static O half_coriolis(const T& tree) {
    O o = liecheck_tree<S>(tree);
    o[op::tree_nonlinear_effects] = [o](const X& q, const X& v) -> X {
      return (o[op::tree_nonlinear_effects](q, v) + o[op::tree_gravity](q)) / S(2);
    };
    return o;
  }
  static O acceleration_of_the_first(const T& tree) {
    O o = liecheck_tree<S>(tree);
    o[op::tree_rnea] = [o, n = velocity_size(tree.joints[0].kind)](const X& q, const X& v, const X& a, int i,
                                                                   const V6& F) -> X {
      X first = X::Zero(a.size());
      first.head(n) = a.head(n);
      return o[op::tree_rnea](q, v, first, i, F);
    };
    return o;
  }
  static O damped(const T& tree) {
    O o = liecheck_tree<S>(tree);
    o[op::tree_rnea] = [o](const X& q, const X& v, const X& a, int i, const V6& F) -> X {
      return o[op::tree_rnea](q, v, a, i, F) + o[op::tree_crba](q).diagonal().cwiseProduct(a) / S(1000);
    };
    return o;
  }
  static O derivative_at_rest(const T& tree) {
    O o = liecheck_tree<S>(tree);
    o[op::rnea_derivatives] = [o](const X& q, const X& v, const X& a, int i, const V6& F) {
      return o[op::rnea_derivatives](q, v, X::Zero(a.size()), i, F);
    };
    return o;
  }
  static O spatial_for_classical(const T& tree) {
    O o = liecheck_tree<S>(tree);
    o[op::frame_classical_acceleration] = o[op::frame_acceleration];
    return o;
  }
  static O world_rate_for_aligned(const T& tree) {
    O o = liecheck_tree<S>(tree);
    o[op::frame_jacobian_rate] = [o](const X& q, const X& v, Seen s) -> M {
      return o[op::frame_jacobian_rate](q, v, s == Seen::aligned ? Seen::world : s);
    };
    return o;
  }
  static O local_for_world(const T& tree) {
    O o = liecheck_tree<S>(tree);
    o[op::frame_jacobian] = [o](const X& q, Seen s) -> M {
      return o[op::frame_jacobian](q, s == Seen::world ? Seen::local : s);
    };
    return o;
  }
  static O aligned_for_world(const T& tree) {
    O o = liecheck_tree<S>(tree);
    o[op::frame_velocity] = [o](const X& q, const X& v, Seen s) -> V6 {
      return o[op::frame_velocity](q, v, s == Seen::world ? Seen::aligned : s);
    };
    return o;
  }
  static O momentum_of_the_point(const T& tree) {
    O o = liecheck_tree<S>(tree);
    o[op::tree_momentum_map] = [o](const X& q) -> M {
      M A = o[op::tree_momentum_map](q);
      A.bottomRows(3) += A.topRows(3);
      return A;
    };
    return o;
  }
};

}  // namespace

template <class S>
const std::vector<TreeBug<S>>& tree_bugs() {
  using P = Planted<S>;
  static const std::vector<TreeBug<S>> all = {
      {"tree_armature_twice", "the mass matrix contains the rotor inertia twice",
       "choreonoid/choreonoid issue 26",
       [](const Tree<S>& t) { return P::with_armature(t, S(1)); }},
      {"tree_mass_without_armature", "the mass matrix lacks the armature",
       "stack-of-tasks/pinocchio issue 671", [](const Tree<S>& t) { return P::with_armature(t, S(-1)); }},
      {"tree_torque_without_armature", "inverse dynamics lacks the rotor inertia",
       "rdiankov/openrave pull 600", P::rnea_without_armature},
      {"tree_gravity_sign", "gravity acts upward", "JuliaRobotics/RigidBodyDynamics.jl pull 2",
       P::gravity_sign},
      {"tree_coriolis_factor", "the Coriolis terms are halved", "RussTedrake/underactuated issue 81",
       P::half_coriolis},
      {"tree_acceleration_lost", "accelerations of all joints except the first are ignored",
       "RobotLocomotion/drake issue 2201", P::acceleration_of_the_first},
      {"tree_damping", "inverse dynamics adds 0.001 diag(M) a, forward dynamics does not",
       "dartsim/dart issue 1450", P::damped},
      {"tree_derivative_at_rest", "the derivatives of inverse dynamics are taken at zero acceleration",
       "RobotLocomotion/drake issue 2201", P::derivative_at_rest},
      {"tree_spatial_for_classical", "the spatial acceleration is returned as the classical one",
       "dartsim/dart issue 294", P::spatial_for_classical},
      {"tree_world_rate", "LOCAL_WORLD_ALIGNED returns the Jacobian rate of WORLD",
       "stack-of-tasks/pinocchio issue 1522", P::world_rate_for_aligned},
      {"tree_local_for_world", "WORLD returns the Jacobian of LOCAL",
       "stack-of-tasks/pinocchio issue 1525", P::local_for_world},
      {"tree_aligned_for_world", "WORLD returns the velocity of LOCAL_WORLD_ALIGNED",
       "stack-of-tasks/pinocchio issue 901", P::aligned_for_world},
      {"tree_momentum_point", "the momentum map refers to another point",
       "stack-of-tasks/pinocchio issue 1828", P::momentum_of_the_point},
  };
  return all;
}
template const std::vector<TreeBug<float>>& tree_bugs();
template const std::vector<TreeBug<double>>& tree_bugs();

}  // namespace liecheck::properties
