#pragma once
// Observer: quantities of a motion that are recorded. One file each; the list is observers/registry.hpp. An observer does
// not change the motion.

#include <liecheck/scene/effects/effect.hpp>
#include <optional>

namespace liecheck::scene {

struct Column {
  std::string name, unit;
};
/// A number that summarises a run; no value where it is undefined.
struct Figure {
  std::string name, unit;
  std::optional<double> value;
};

/// Constants of a run: its robot with the gravity and armature that effects set, its effects, and the time between two
/// samples [s].
struct Watched {
  const Model<double>* model;
  const Effects<double>* effects;
  double interval;
};

class Observer {
 public:
  virtual ~Observer() = default;
  virtual Kinematics needs() const = 0;
  /// Is step() called after each step?
  virtual bool everyStep() const { return false; }
  virtual std::vector<Column> columns() const = 0;
  /// Called at the start, after each step (everyStep), and at samples, in that order.
  virtual void step(const Now<double>&) {}
  /// Fills one number for each column.
  virtual void sample(const Now<double>& now, std::span<double> row) = 0;
  virtual std::vector<Figure> figures() const { return {}; }
};

}  // namespace liecheck::scene
