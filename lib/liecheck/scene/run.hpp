#pragma once
// A scene, run in double: its plan, its samples, and what each stage of it costs.

#include <functional>
#include <liecheck/scene/observers/observer.hpp>
#include <liecheck/scene/scene.hpp>

namespace liecheck::scene {

/// A part of what a run computes, and how often.
struct Stage {
  std::string name, equation, when;   ///< when: "evaluation", "step" or "sample"
  std::string why;                    ///< it is there
  std::optional<double> nanoseconds;  ///< each time; what it takes on this machine now
};
struct LeftOut {
  std::string name, why;
};
/// The stages that a scene needs and nothing else.
struct Plan {
  bool lone_body = false;
  std::vector<Stage> stages;
  std::vector<LeftOut> left_out;
};
/// measured: with the time of each stage, about a millisecond each. Throws std::invalid_argument naming the part that
/// makes no sense for this robot, SingularInertia for one that no force accelerates.
Plan plan(const Scene& scene, bool measured = false);

/// All observers that there are.
std::vector<const PartInfo*> observerInfos();
/// What a run would write down at each sample. Throws as plan().
std::vector<Column> columnsOf(const Scene& scene);

/// What came of it. Rows of columns.size() numbers each.
struct Run {
  Outcome outcome;
  std::vector<Column> columns;
  std::vector<double> rows;
  std::vector<Figure> figures;
  MethodCounts counts;
  double seconds = 0;  ///< it took
  /// |h v| of one step, angular [rad]: beyond pi no method of increments means anything. 0 of an adaptive method, whose
  /// own steps are held to its tolerance.
  double largest_turn = 0;
};

/// on: asked about ten times a second with the share that is done; false stops it. Throws as plan(), and
/// std::invalid_argument where something watched is not finite at the start.
Run run(const Scene& scene, const std::function<bool(double share)>& on = {});

}  // namespace liecheck::scene
