#pragma once
// Effect: a force, or a constant of the equations of motion (gravity, armature). One file each; the list is
// effects/registry.hpp.
//
// An effect declares which kinematics it reads, so that a plan computes no others. An effect that the scene does not name
// is not in the system: it costs no instruction and changes no bit.

#include <liecheck/multibody/model.hpp>
#include <liecheck/scene/parameters.hpp>
#include <memory>
#include <span>

namespace liecheck::scene {

/// The state that effects and observers read: time [s], q [nq], v [nv], and, where needs() asks for them, poses X_WJ,
/// velocities V and spatial accelerations A of the joints in their own axes [njoints].
template <Scalar S>
struct Now {
  S t;
  std::span<const S> q, v;
  std::span<const SE3<S>> X_WJ;
  std::span<const Motion<S>> V, A;
};

/// The sum of forces that effects add to: generalised forces tau [nv; N, N m], and forces f on the bodies [njoints], each in
/// its joint's axes at its origin.
template <Scalar S>
struct Load {
  std::span<S> tau;
  std::span<Force<S>> f;
};

enum class Kinematics { None, Poses, Velocities, Accelerations };
enum class Acts { OnModel, OnJoints, OnBodies };

template <Scalar S>
class Effect {
 public:
  virtual ~Effect() = default;
  virtual Acts acts() const = 0;
  virtual Kinematics needs() const { return Kinematics::None; }
  /// Does the force depend on velocities? Then a step that is implicit in the velocity iterates.
  virtual bool dependsOnVelocity() const { return false; }
  /// Sets gravity or armature; of effects that act on the model.
  virtual void prepare(Model<S>&) const {}
  virtual void add(const Now<S>&, const Load<S>&) const {}
  /// The potential energy [J] of its force; zero for a force without potential. Reads poses.
  virtual S potential(const Now<S>&) const { return S(0); }
};

/// The surroundings that effects share: the ground, if a scene has one.
struct Surroundings {
  bool ground = false;
  double height = 0;  ///< of the ground: the plane z = height [m]
};

template <Scalar S>
using Effects = std::vector<std::shared_ptr<const Effect<S>>>;

}  // namespace liecheck::scene
