#pragma once
// Estimate of the error of a run, by runs of the same scene with other steps over the same time.
//
//   D = max over checkpoints of |difference(q_run, q_twin)|,  error = C h^p
//   a twin with steps of r h:   error of the run = D / (r^p - 1)
//
// Twins with steps of about 3 h and 9 h cost 44 % of the run, and their ratio shows the order p. If p is not
// that of the method, the error is taken to be D itself; if p is above it, only half the order is believed. They lose
// contacts that the run resolves by shorter steps (phase_check.hpp). Such a run has one twin with steps of 3 h and
// shorter phases, and its error is 4/3 D. Where this leaves open whether the error is accepted, the twin has every
// step half as long, also within phases, and then h/8 if the error is near the accepted one, or above 3 % of it where
// the order is not the method's: error = D / (1 - r^p). (Richardson 1911; Hairer, Norsett & Wanner 1993, II.4.)
// Methods with a tolerance get r^p times the tolerance and r times the longest step.
//
// The error covers the method and the amplified rounding errors. It does not cover what all runs share: the
// model, the parameters, and features of the motion between checkpoints that no twin meets.

#include <liecheck/scene/setup.hpp>

namespace liecheck::scene {

/// The largest element of a difference of states, by kind of coordinate.
struct StateError {
  double position = 0, angle = 0;                    ///< [m, rad]
  double linear_velocity = 0, angular_velocity = 0;  ///< [m/s, rad/s]
};

/// Why a result is not to be believed, and what helps.
struct Alarm {
  double t;  ///< of the first checkpoint that shows it [s]
  std::string what, cause, remedy;
  double step = 0;  ///< the step that the remedy advises [s], or 0
};

struct Estimate {
  /// An element of error is NaN if it was not measured: no twin reached the end, or the robot has no such coordinate.
  StateError error, accepted;   ///< accepted has no velocities
  std::optional<double> order;  ///< as observed; none if it was not
  std::string by;               ///< the twins, such as "steps of 3 h, 9 h"
  std::string finer;            ///< why twins with shorter steps were needed, or empty
  double cost = 0;              ///< steps of the twins / steps of the run
  double seconds = 0;           ///< wall time
  long checkpoints = 0;
  std::vector<Alarm> alarms;
  std::string notice;  ///< what the model leaves open although the run is right, or empty (painleve.hpp)
};

/// The checkpoints must begin with the start and end with the last state. Throws Interrupted if go_on returns
/// false, which is called every 256 steps.
template <class Sys>
Estimate estimateError(Setup<Sys>&, const std::vector<Checkpoint<Sys>>&, const Outcome&,
                       const std::function<bool()>& go_on);

extern template Estimate estimateError(Setup<LoneBody<double>>&,
                                       const std::vector<Checkpoint<LoneBody<double>>>&, const Outcome&,
                                       const std::function<bool()>&);
extern template Estimate estimateError(Setup<ThrownBody<double>>&,
                                       const std::vector<Checkpoint<ThrownBody<double>>>&, const Outcome&,
                                       const std::function<bool()>&);
extern template Estimate estimateError(Setup<LoneJoint<double>>&,
                                       const std::vector<Checkpoint<LoneJoint<double>>>&, const Outcome&,
                                       const std::function<bool()>&);
extern template Estimate estimateError(Setup<Tree<double>>&, const std::vector<Checkpoint<Tree<double>>>&,
                                       const Outcome&, const std::function<bool()>&);

}  // namespace liecheck::scene
