#pragma once
// Effect: a force, or a constant of the equations of motion (gravity, armature). All are in registry.hpp.
//
// An effect declares which kinematics it reads, so that a step computes no others. An effect that the scene
// does not name is not in the system, so it costs no time and does not change the results.

#include <array>
#include <liecheck/multibody/model.hpp>
#include <liecheck/scene/parameters.hpp>
#include <liecheck/scene/switches.hpp>
#include <memory>
#include <span>
#include <vector>

namespace liecheck::scene {

/// The state that effects and observers read: time [s], a time in the piece of the forces that applies
/// (pieces.hpp), q [nq] and v [nv]. If needs() asks for them, also poses X_WJ, velocities V and spatial
/// accelerations A of the joints, in the joint's axes [njoints]. on(g) selects the branch of a force by a switching
/// function g (switches.hpp); an effect asks for each of its functions once in each evaluation.
template <Scalar S>
struct Now {
  S t, piece;
  std::span<const S> q, v;
  std::span<const SE3<S>> X_WJ;
  std::span<const Motion<S>> V, A;
  Switches<S>* switches = nullptr;
  bool on(const S& g) const { return switches ? switches->on(g) : g > S(0); }
};

/// The sums to which effects add their forces: generalised forces tau [nv; N, N m], and forces f on the
/// bodies [njoints], each in its joint's axes at the joint's origin.
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
  /// Sets gravity or armature, for effects that act on the model.
  virtual void prepare(Model<S>&) const {}
  virtual void add(const Now<S>&, const Load<S>&) const {}
  /// The times [s] at which the force or a derivative of it jumps. Between them add() selects by now.piece.
  virtual std::vector<S> events() const { return {}; }
  /// True if the sum of kinetic energy and potential() is constant under this effect alone.
  virtual bool conservative() const { return false; }
  /// The potential energy [J] of the force; zero for a force without potential. Reads poses.
  virtual S potential(const Now<S>&) const { return S(0); }
};

/// The surroundings that effects share: the ground, if the scene has one.
struct Surroundings {
  bool ground = false;
  double height = 0;                         ///< of the ground's plane above the origin, along z [m]
  std::array<double, 3> normal = {0, 0, 1};  ///< its unit normal
};

template <Scalar S>
using Effects = std::vector<std::shared_ptr<const Effect<S>>>;

}  // namespace liecheck::scene
