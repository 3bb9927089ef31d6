#pragma once
// Observer: records quantities of a motion without changing it. observers/registry.hpp lists all observers.

#include <liecheck/scene/effects/effect.hpp>
#include <optional>

namespace liecheck::scene {

struct Column {
  std::string name, unit;
};
/// A number that summarises a run; no value if it is undefined.
struct Figure {
  std::string name, unit;
  std::optional<double> value;
};

struct Scene;

/// Constants of a run: the robot with gravity and armature, all effects, the time between samples [s], and the scene,
/// whose requests of effects have the order of `effects`.
struct Watched {
  const Model<double>* model;
  const Effects<double>* effects;
  double interval;
  const Scene* scene;
};

class Observer {
 public:
  virtual ~Observer() = default;
  virtual Kinematics needs() const = 0;
  /// True if step() is to be called after each step.
  virtual bool everyStep() const { return false; }
  virtual std::vector<Column> columns() const = 0;
  /// Called at the start and after each step, if everyStep(). If that state is sampled too, before sample().
  virtual void step(const Now<double>&) {}
  /// Fills one number for each column.
  virtual void sample(const Now<double>& now, std::span<double> row) = 0;
  virtual std::vector<Figure> figures() const { return {}; }
};

}  // namespace liecheck::scene
