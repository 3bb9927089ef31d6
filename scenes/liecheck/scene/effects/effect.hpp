#pragma once
// Effect: a force, or a constant of the equations of motion (gravity, armature). All are in registry.hpp.
//
// An effect declares which kinematics it reads, so that a step computes no others. An effect that the scene
// does not name is not in the system, so it costs no time and does not change the results.

#include <array>
#include <liecheck/multibody/model.hpp>
#include <liecheck/scene/parameters.hpp>
#include <liecheck/scene/shapes.hpp>
#include <liecheck/scene/switches.hpp>
#include <memory>
#include <span>
#include <vector>

namespace liecheck::scene {

/// Twists of the joints at their origins. They are stored in one of two kinds of axes; the others are computed where
/// they are asked for.
template <Scalar S>
struct Twists {
  std::span<const Motion<S>> stored;
  std::span<const SE3<S>> X_WJ;
  bool stored_in_world = false;

  /// In the joint's axes.
  Motion<S> operator[](std::size_t i) const {
    if (!stored_in_world) return stored[i];
    const Matrix3<S>& R = X_WJ[i].rotation();
    return Motion<S>(transposed_product<S>(R, stored[i].linear()),
                     transposed_product<S>(R, stored[i].angular()));
  }
  /// In the world's axes.
  Motion<S> inWorld(std::size_t i) const {
    if (stored_in_world) return stored[i];
    const Matrix3<S>& R = X_WJ[i].rotation();
    return Motion<S>(product<S>(R, stored[i].linear()), product<S>(R, stored[i].angular()));
  }
};

/// The state that effects and observers read: time [s], a time in the piece of the forces that applies
/// (pieces.hpp), q [nq] and v [nv]. If needs() asks for them, also poses X_WJ, twists V and spatial accelerations A
/// of the joints [njoints], A in the joint's axes, and a = v_dot [nv] with A. on(g) selects the branch of a force by a
/// switching function g (switches.hpp); an effect asks for each of its functions once in each evaluation.
template <Scalar S>
struct Now {
  S t, piece;
  std::span<const S> q, v;
  std::span<const SE3<S>> X_WJ;
  Twists<S> V;
  std::span<const Motion<S>> A;
  Switches<S>* switches = nullptr;
  std::span<const S> a = {};
  [[gnu::always_inline]] bool on(const S& g) const { return next(1)(0, g); }
  /// The next `count` switching functions, for an effect that has many.
  typename Switches<S>::Next next(std::size_t count) const {
    return switches ? switches->next(count) : typename Switches<S>::Next();
  }
};

/// The sums to which effects add their forces: generalised forces tau [nv; N, N m], and forces f on the
/// bodies [njoints], each in the world's axes at its joint's origin.
template <Scalar S>
struct Load {
  std::span<S> tau;
  std::span<Force<S>> f;
};

/// Forces on a lone body that read neither its pose nor the time, at its centre of mass c: forces constant in world
/// axes or in body axes, and drag against c_dot and omega.
///
///   f = force_W + R force_B - (linear + quadratic |c_dot|) c_dot                 [N, world]
///   n = moment_B - (angular_linear + angular_quadratic |omega|) omega            [N m, about c, body]
template <Scalar S>
struct BodyTerms {
  Vector3<S> force_W = Vector3<S>::Zero(), force_B = Vector3<S>::Zero(), moment_B = Vector3<S>::Zero();
  S linear = S(0), quadratic = S(0), angular_linear = S(0), angular_quadratic = S(0);
  /// True if f is constant.
  bool thrown() const { return force_B.isZero(S(0)) && linear == S(0) && quadratic == S(0); }
};

/// A contact that slides with friction: f_n d acts on A at p and -f_n d on B, d = n - mu t, where n is the normal
/// from B to A and t the direction of A's velocity relative to B. In the world, which is joint 0.
template <Scalar S>
struct Sliding {
  std::size_t joint_A, joint_B;
  Vector3<S> p, n, d;
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
  /// If the force on a lone body with the centre of mass `centre` (in its axes) has this form, adds it to the terms
  /// and returns true. add() is then not called.
  virtual bool addConstant(const Vector3<S>& centre, BodyTerms<S>&) const {
    static_cast<void>(centre);
    return false;
  }
  /// True if the force depends on those of the other effects. It is then the last effect of a scene.
  virtual bool follows() const { return false; }
  /// The times [s] at which the force or a derivative of it jumps. Between them add() selects by now.piece.
  virtual std::vector<S> events() const { return {}; }
  /// True if the sum of kinetic energy and potential() is constant under this effect alone.
  virtual bool conservative() const { return false; }
  /// True if that sum never grows under this effect alone.
  virtual bool passive() const { return conservative(); }
  /// The potential energy [J] of the force; zero for a force without potential. Reads poses.
  virtual S potential(const Now<S>&) const { return S(0); }
  /// Its contacts that slide. Reads velocities.
  virtual std::vector<Sliding<S>> sliding(const Now<S>&) const { return {}; }
};

/// What effects share: the ground, if the scene has one, and the shapes of the bodies.
struct Surroundings {
  bool ground = false;
  double height = 0;                         ///< of the ground's plane above the origin, along z [m]
  std::array<double, 3> normal = {0, 0, 1};  ///< its unit normal
  std::shared_ptr<const TriangleMesh> mesh;  ///< the ground instead of the plane, or null
  std::vector<Shape> shapes;
};

template <Scalar S>
using Effects = std::vector<std::shared_ptr<const Effect<S>>>;

}  // namespace liecheck::scene
