#pragma once
// SavedRun: a run that was stopped, with all that its continuation needs to give the same bits as the whole run.
//
// It holds the last state with its compensated rounding errors, what the method takes from the steps before
// (Method::memory), and the states at samples, from which the observers record the same rows again.

#include <cstdint>
#include <functional>
#include <liecheck/scene/integrators/method.hpp>
#include <liecheck/scene/scene.hpp>

namespace liecheck::scene {

/// A state after `step` steps.
struct SavedState {
  long step = 0;
  double t = 0;
  VectorX<double> q, v, q_low, v_low;

  SavedState() = default;
  template <class Sys>
  SavedState(long n, const State<Sys>& s) : step(n), t(s.t), q(s.q), v(s.v), q_low(s.q_low), v_low(s.v_low) {}
  template <class Sys>
  void restore(State<Sys>& s) const {
    s.t = t, s.q = q, s.v = v, s.q_low = q_low, s.v_low = v_low;
  }
};

struct SavedRun {
  std::uint64_t digest = 0;  ///< of the scene
  SavedState last;
  std::vector<double> memory;   ///< of the method at the last state
  std::vector<double> history;  ///< of the switching functions there
  MethodCounts counts;
  double largest_turn = 0;                    ///< as in Run
  std::vector<SavedState> samples, sections;  ///< at samples; for the estimate of the error
};

/// A digest of all that determines the motion and the samples: robot, start, effects with their tables, integrator,
/// time and observers.
std::uint64_t digestOf(const Scene&);

/// As text. Numbers are hexadecimal, so that they are read back with the same bits.
std::string textOf(const SavedRun&);
/// Throws std::invalid_argument if the text is not that of a run of this scene.
SavedRun savedRunOf(const std::string& text, const Scene&);

/// Whether a run is saved, and whether it continues a saved one. save is called about once in `seconds`, and at the
/// end or the stop of the run, with the last state that can be resumed.
struct Saving {
  std::function<void(const SavedRun&)> save = {};
  const SavedRun* from = nullptr;
  double seconds = 1;
};

}  // namespace liecheck::scene
