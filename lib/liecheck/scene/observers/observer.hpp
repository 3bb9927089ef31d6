#pragma once
// Observer: what is watched of a motion. One file each; the list is observers/registry.hpp. It changes nothing.

#include <liecheck/scene/effects/effect.hpp>
#include <optional>

namespace liecheck::scene {

struct Column {
  std::string name, unit;
};
/// A number that a whole run has, or none where nothing was to be seen.
struct Figure {
  std::string name, unit;
  std::optional<double> value;
};

/// Fixed for a run: its robot with the constants that effects changed, those effects that have a potential, its ground,
/// and the time between two looks [s].
struct Watched {
  const Model<double>* model;
  const Effects<double>* effects;
  double interval;
};

class Observer {
 public:
  virtual ~Observer() = default;
  virtual Kinematics needs() const = 0;
  /// After each step, not only at samples.
  virtual bool everyStep() const { return false; }
  virtual std::vector<Column> columns() const = 0;
  /// Called at the start, after each step (everyStep), and at samples, in that order.
  virtual void step(const Now<double>&) {}
  /// Fills one number for each column.
  virtual void sample(const Now<double>& now, std::span<double> row) = 0;
  virtual std::vector<Figure> figures() const { return {}; }
};

}  // namespace liecheck::scene
