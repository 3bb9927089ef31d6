#pragma once
// The list of observers. A new one needs its own file and an entry here. attitude_error has no Observer:
// Setup creates an AttitudeError, since it must simulate a reference motion.

#include <liecheck/scene/observers/observer.hpp>

namespace liecheck::scene {

inline const PartInfo attitude_error_info{
    "attitude_error",
    "max over joints of the angle to a reference run: gauss12 with `refinement` times as many steps",
    "",
    "a second run",
    {{"refinement", Kind::Positive, "1", "1", "a whole number"}}};

struct ObserverEntry {
  const PartInfo* info;
  std::unique_ptr<Observer> (*make)(const Parameters&, const Watched&);  ///< null for attitude_error
};

const std::vector<ObserverEntry>& observerEntries();
/// Throws std::invalid_argument for an unknown name.
const ObserverEntry& observerEntry(const std::string& name);

}  // namespace liecheck::scene
