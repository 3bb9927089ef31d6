#pragma once
// Scene: the description of a simulation. scene_file/ reads it from text.

#include <liecheck/multibody/configuration.hpp>
#include <liecheck/scene/effects/registry.hpp>
#include <liecheck/scene/integrators/registry.hpp>
#include <liecheck/scene/simulate.hpp>
#include <liecheck/scene/lone_joint.hpp>

namespace liecheck::scene {

struct Scene {
  std::string name, reason;
  std::string source;   ///< name of the scene in messages, such as the file
  Model<double> model;  ///< gravity and armature are unset; effects set them
  VectorX<double> q, v;
  Surroundings around;
  std::vector<Request> effects;  ///< effects and actuations, in the order of summation
  std::string integrator;
  MethodOptions options;
  Span span;
  std::vector<Request> observers;
  /// The largest accepted error of a position [m] and of an angle [rad]; 0 means 1 % of the motion's extent.
  double accepted_position = 0, accepted_angle = 0;
  std::string truth;  ///< name of the closed form of this motion, or empty
  std::string csv, json;
  std::vector<std::string> files;  ///< that it names and that were read
};

/// The scene's effects on `model`, which is the scene's model cast to S.
template <Scalar S>
Effects<S> makeEffects(const Scene& scene, const Model<S>& model) {
  Effects<S> all;
  for (const Request& r : scene.effects) all.push_back(makeEffect<S>(r, model, scene.around));
  return all;
}

/// The simplest system that has the equations of a scene: a tree, one revolute or prismatic joint, a free body without
/// armature, or one of which the centre of mass has a constant acceleration.
enum class SystemKind { Tree, LoneJoint, LoneBody, ThrownBody };
/// The effects must be those of the model. An integrator may need more than the equations.
SystemKind kindOf(Model<double> model, const Effects<double>& effects, const std::string& integrator);
/// Throws like makeEffects.
SystemKind kindOf(const Scene& scene);
inline bool isLoneBody(const Scene& scene) { return kindOf(scene) >= SystemKind::LoneBody; }

/// The scene's robot and effects as a Sys: Tree<S>, or one that kindOf(scene) allows.
template <System Sys>
Sys makeSystem(const Scene& scene) {
  const auto model = scene.model.template cast<typename Sys::Scalar>();
  return Sys(model, makeEffects(scene, model));
}
/// The scene's start. Throws InvalidConfiguration if q or v is not finite, or a quaternion or (cos, sin) in q
/// is not unit up to rounding.
template <System Sys>
State<Sys> startOf(const Scene& scene, const Sys& system) {
  using S = typename Sys::Scalar;
  State<Sys> start(system, checkedConfiguration(scene.model, scene.q).template cast<S>(),
                   checkedTangent(scene.model, scene.v).template cast<S>());
  start.compensate(scene.options.compensated.value_or(compensates(methodInfo(scene.integrator))));
  return start;
}

}  // namespace liecheck::scene
