#pragma once
// Plans and runs of scenes in double.

#include <functional>
#include <liecheck/scene/observers/observer.hpp>
#include <liecheck/scene/scene.hpp>

namespace liecheck::scene {

/// A computation of a run, and how often it is made.
struct Stage {
  std::string name, equation, when;   ///< when: "evaluation", "step" or "sample"
  std::string why;                    ///< it is part of the plan
  std::optional<double> nanoseconds;  ///< per call, measured on this machine
};
struct LeftOut {
  std::string name, why;
};
/// The computations that a scene needs, and those that it does not.
struct Plan {
  bool lone_body = false;
  std::vector<Stage> stages;
  std::vector<LeftOut> left_out;
};
/// measured: with the time of each stage, about a millisecond each. Throws std::invalid_argument that names a part which
/// does not fit the robot, and SingularInertia for a joint without inertia.
Plan plan(const Scene& scene, bool measured = false);

/// All observers that there are.
std::vector<const PartInfo*> observerInfos();
/// The columns of the samples of a run. Throws as plan().
std::vector<Column> columnsOf(const Scene& scene);

/// The results of a run. rows holds columns.size() numbers per sample.
struct Run {
  Outcome outcome;
  std::vector<Column> columns;
  std::vector<double> rows;
  std::vector<Figure> figures;
  MethodCounts counts;
  double seconds = 0;  ///< wall time
  /// The largest rotation |h omega| of a step [rad]: beyond pi the increments of a step are not defined. 0 for adaptive
  /// methods, whose tolerance limits their steps.
  double largest_turn = 0;
};

/// on: called about ten times a second with the share that is done; false stops the run. Throws as plan(), and
/// std::invalid_argument where an observed number is not finite at the start.
Run run(const Scene& scene, const std::function<bool(double share)>& on = {});

}  // namespace liecheck::scene
