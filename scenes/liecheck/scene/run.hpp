#pragma once
// Plans and runs of scenes in double.

#include <functional>
#include <liecheck/scene/estimate.hpp>
#include <liecheck/scene/observers/observer.hpp>
#include <liecheck/scene/saved_run.hpp>
#include <liecheck/scene/scene.hpp>

namespace liecheck::scene {

/// The largest count of numbers in the samples of a run: 400 MB, and while they grow twice that.
constexpr double max_sample_numbers = 5e7;
/// "1e+09 samples of 3 numbers ..." if the samples of a run would be more than that; otherwise "".
std::string tooManySamples(const Span& span, double numbers);

/// A computation of a run, and how often it is done.
struct Stage {
  std::string name, equation, when;   ///< when: "evaluation", "step" or "sample"
  std::string why;                    ///< why it is part of the plan
  std::optional<double> nanoseconds;  ///< per call, measured on this machine
  std::optional<long> instructions;   ///< per call, counted (count_instructions.hpp)
};
struct LeftOut {
  std::string name, why;
};
/// The computations that a scene needs, and those that it does not need.
struct Plan {
  SystemKind kind = SystemKind::Tree;
  /// Evaluations of the acceleration in a step, counted over the first steps; of an adaptive method, in the time
  /// between two samples. 0 if nothing was measured.
  double evaluations = 0;
  std::vector<Stage> stages;  ///< the last one of a step is the whole step
  std::vector<LeftOut> left_out;
};
/// What is measured of a plan: every stage is timed, which takes about a millisecond each, and then its instructions are
/// counted (count_instructions.hpp).
struct Measuring {
  bool every = false;  ///< count each instruction instead of a sample
  double seconds = 2;  ///< for counting; a stage that they do not suffice for has no count
  std::function<void(const Plan&)> timed = {};    ///< called before anything is counted
  std::function<void(const Stage&)> counts = {};  ///< called before the instructions of a stage are counted
};
/// Throws std::invalid_argument if a part does not fit the robot, SingularInertia for a joint without inertia, and, if
/// measured, StepFailed if a step from the start fails.
Plan plan(const Scene& scene, const std::optional<Measuring>& measuring = {});

/// The columns of the samples of a run. Throws like plan().
std::vector<Column> columnsOf(const Scene& scene);

/// The results of a run. rows holds columns.size() numbers per sample.
struct Run {
  Outcome outcome;
  std::vector<Column> columns;
  std::vector<double> rows;
  std::vector<Figure> figures;
  MethodCounts counts;
  double seconds = 0;    ///< wall time
  VectorX<double> q, v;  ///< the state at outcome.t
  /// The largest rotation |h omega| of a step [rad]. Methods require that it is below pi. It is 0 for
  /// adaptive methods, since the tolerance limits their steps.
  double largest_turn = 0;
  std::optional<Estimate> estimate;  ///< if it was asked for and the run reached its end
};

/// Calls on(share) about ten times a second with the completed share; if it returns false, the run stops.
/// Throws like plan(), and std::invalid_argument if an observed number is not finite at the start.
/// If `estimated` is true, the error is estimated after the run (estimate.hpp). A run that continues a saved one gives
/// the same rows, figures and state as the whole run; `seconds` and `events` are those of its own part. Throws
/// std::invalid_argument if an observer reads every step of a run that is saved or resumed.
Run run(const Scene& scene, const std::function<bool(double share)>& on = {}, bool estimated = false,
        const Saving& saving = {});

}  // namespace liecheck::scene
