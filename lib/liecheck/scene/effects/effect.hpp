#pragma once
// Effect: what acts on a robot besides its own inertia. One file each; the list is effects/registry.hpp.
//
// An effect adds its forces to a load, or changes a constant of the equations of motion (gravity, armature). It says
// which kinematics it reads, so that a plan holds only those that somebody needs. What a scene does not call for is
// not in the list: it costs nothing and cannot disturb a bit.

#include <liecheck/multibody/model.hpp>
#include <liecheck/scene/parameters.hpp>
#include <memory>
#include <span>

namespace liecheck::scene {

/// What is known when an effect adds its forces, or an observer looks: time [s], q [nq], v [nv], and, where needs()
/// asks for them, poses X_WJ, velocities V and spatial accelerations A of the joints in their own axes [njoints].
template <Scalar S>
struct Now {
  S t;
  std::span<const S> q, v;
  std::span<const SE3<S>> X_WJ;
  std::span<const Motion<S>> V, A;
};

/// Where forces are added: generalized ones tau [nv; N, N m], and those on the bodies [njoints], each in its joint's
/// axes at its origin.
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
  /// Does the force depend on velocities? Then a step that is implicit in them iterates.
  virtual bool dependsOnVelocity() const { return false; }
  /// Of those that act on the model: gravity, armature.
  virtual void prepare(Model<S>&) const {}
  virtual void add(const Now<S>&, const Load<S>&) const {}
  /// The potential energy [J] of its force; zero where it has none. Needs poses.
  virtual S potential(const Now<S>&) const { return S(0); }
};

/// What effects share: the ground, if a scene has one.
struct Surroundings {
  bool ground = false;
  double height = 0;  ///< of the ground: the plane z = height [m]
};

template <Scalar S>
using Effects = std::vector<std::shared_ptr<const Effect<S>>>;

}  // namespace liecheck::scene
