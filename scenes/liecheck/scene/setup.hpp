#pragma once
// Setup: the robot, effects and observers of a scene, ready for a plan or a run in double.

#include <liecheck/scene/attitude_error.hpp>
#include <liecheck/scene/observers/observer.hpp>
#include <liecheck/scene/observers/registry.hpp>
#include <liecheck/scene/scene.hpp>

namespace liecheck::scene {

/// A state of the run to which twins are compared.
template <class Sys>
struct Checkpoint {
  long step;
  State<Sys> state;
};

template <class Sys>
class Setup {
 public:
  const Scene& scene;
  const Effects<double> effects;  ///< all effects, including those that act on the model
  Sys system;
  State<Sys> start;
  const Watched watched;
  std::vector<std::unique_ptr<Observer>> observers;
  std::optional<AttitudeError<Sys>> attitude_error;
  Kinematics needs = Kinematics::None, every_step_needs = Kinematics::None;  ///< of the observers
  bool every_step = false;  ///< true if an observer reads every step

  explicit Setup(const Scene&);
  Setup(const Setup&) = delete;
  Setup& operator=(const Setup&) = delete;

  /// The step size [s].
  double step() const { return scene.span.duration / double(scene.span.steps); }

  std::vector<Column> columns() const;
  /// The state as observers read it. Valid until the next call.
  Now<double> look(const State<Sys>&, Kinematics);

 private:
  typename Sys::Tangent a_;
};

extern template class Setup<LoneBody<double>>;
extern template class Setup<ThrownBody<double>>;
extern template class Setup<LoneJoint<double>>;
extern template class Setup<Tree<double>>;
extern template class AttitudeError<LoneBody<double>>;
extern template class AttitudeError<ThrownBody<double>>;
extern template class AttitudeError<LoneJoint<double>>;
extern template class AttitudeError<Tree<double>>;

/// Returns f(setup), with the system that fits the scene.
template <class F>
auto withSetup(const Scene& scene, F f) {
  const auto with = [&]<class Sys>(std::type_identity<Sys>) {
    Setup<Sys> setup(scene);
    return f(setup);
  };
  switch (kindOf(scene)) {
    case SystemKind::ThrownBody:
      return with(std::type_identity<ThrownBody<double>>());
    case SystemKind::LoneJoint:
      return with(std::type_identity<LoneJoint<double>>());
    case SystemKind::LoneBody:
      return with(std::type_identity<LoneBody<double>>());
    default:
      return with(std::type_identity<Tree<double>>());
  }
}

}  // namespace liecheck::scene
