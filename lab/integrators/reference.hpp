#pragma once
// The motion with which a sweep compares all runs of a scene.
//
// It is the exact motion (truth.hpp) if one is known. Otherwise it is a run that a second run confirms:
//   - gauss12 in float128 with steps that are halved until two runs agree to 1e-20, or for about a minute;
//   - if they agree to less than 1e-13, or the scene has contact, joint limits or limited controllers: rkmk6 in
//     double with steps that are halved as long as that helps, and dopri5 or radau5 with the tolerance that
//     agrees best.
// A second formulation confirms either (confirm.hpp). The disagreement of all is measured for each error. An
// error below ten times the disagreement is not known, and is not compared.

#include <scenes/runner.hpp>
#include <scenes/truth.hpp>

namespace liecheck::properties {

struct Reference {
  std::string name;
  bool closed = false;         ///< a closed form
  MotionError disagreement{};  ///< of the two runs, the largest over all parts; 0 for a closed form
  std::vector<Moment> at;      ///< at the start and after each of `parts` equal parts of the duration
};

/// Throws Stopped, and Diverged if no run reaches the end. progress(what) tells what is computed.
Reference reference_of(const Benchmark& scene, long parts, const std::atomic<bool>* stop,
                       const std::function<void(const std::string&)>& progress);

}  // namespace liecheck::properties
