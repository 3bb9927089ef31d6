#pragma once
// A tree of bodies in plain numbers, and the algorithms that a subject offers on it.

#include <functional>
#include <oracles/tree.hpp>
#include <subjects/subject.hpp>
#include <utility>

namespace liecheck::properties {

/// A body fixed to a joint at (Q, p).
template <class S>
struct FixedBody {
  int joint;
  oracles::BodyOf<S> body;
  oracles::Quaternion<S> Q;
  oracles::Vec3<S> p;
};

/// Joints that move, as the oracle has them; one frame; and bodies beside those of the joints.
template <class S>
struct Tree : oracles::TreeOf<S> {
  std::vector<FixedBody<S>> fixed;
  int frame_joint = 0;
  oracles::Quaternion<S> frame_Q;
  oracles::Vec3<S> frame_p;
};

enum class Seen { world, local, aligned };

/// Bound to one tree. q, v, a, tau as the subject orders them: joint by joint, nothing for a mimic. A null entry is
/// not offered. F [6] acts on the body of a joint, in its axes at its origin.
template <class S>
struct TreeOperations {
  using X = VecX<S>;
  using M = MatX<S>;
  using V6 = Vec<S, 6>;
  std::function<X(const X& q, const X& v, const X& a, int joint, const V6& F)> rnea;
  std::function<X(const X& q, const X& v, const X& tau, int joint, const V6& F)> aba;
  std::function<X(const X& q, const X& v)> nonlinear_effects;
  std::function<X(const X& q)> gravity;
  std::function<M(const X& q)> crba;
  std::function<M(const X& q)> mass_inverse;
  /// By q and by v.
  std::function<std::pair<M, M>(const X& q, const X& v, const X& a, int joint, const V6& F)> rnea_derivatives;
  std::function<std::pair<M, M>(const X& q, const X& v, const X& tau, int joint, const V6& F)>
      aba_derivatives;
  std::function<S(const X& q, const X& v)> kinetic_energy;
  std::function<S(const X& q)> potential_energy;
  std::function<V6(const X& q, const X& v)> momentum;  ///< at the centre of mass
  std::function<M(const X& q)> momentum_map;
  std::function<Pose<S>(const X& q)> frame;
  std::function<V6(const X& q, const X& v, Seen)> frame_velocity;
  std::function<V6(const X&q, const X&v, const X&a, Seen)> frame_acceleration, frame_classical_acceleration;
  std::function<M(const X& q, Seen)> frame_jacobian;
  std::function<M(const X& q, const X& v, Seen)> frame_jacobian_rate;
};

}  // namespace liecheck::properties
