#pragma once
// The list of observers. Adding one touches its file and this one. attitude_error is computed by the run itself, which
// simulates the reference motion that it needs.

#include <liecheck/scene/observers/observer.hpp>

namespace liecheck::scene {

inline const PartInfo attitude_error_info{
    "attitude_error",
    "max over joints of the angle between this run and one by gauss12 in `refinement` times the steps",
    "",
    "a second run beside this one",
    {{"refinement", Kind::Positive, "1", "1", "a whole number"}}};

struct ObserverEntry {
  const PartInfo* info;
  std::unique_ptr<Observer> (*make)(const Parameters&, const Watched&);  ///< null of attitude_error
};

const std::vector<ObserverEntry>& observerEntries();
/// Throws std::invalid_argument for an unknown name.
const ObserverEntry& observerEntry(const std::string& name);

}  // namespace liecheck::scene
