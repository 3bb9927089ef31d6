#pragma once
// The list of observers. Adding one touches its file and this one. attitude_error is made by the run itself, which has
// the second robot that it needs.

#include <liecheck/scene/observers/energy.hpp>
#include <liecheck/scene/observers/flips.hpp>
#include <liecheck/scene/observers/frame_pose.hpp>
#include <liecheck/scene/observers/imu.hpp>
#include <liecheck/scene/observers/momentum.hpp>
#include <liecheck/scene/observers/quaternion_norm.hpp>

namespace liecheck::scene {

inline const PartInfo attitude_error_info{
    "attitude_error",
    "max over joints of the angle between this run and one by gauss12 in `refinement` times the steps",
    "",
    "a second run beside this one",
    {{"refinement", Kind::Positive, "1", "1", "a whole number"}}};

struct ObserverEntry {
  const PartInfo* info;
  std::unique_ptr<Observer> (*make)(const Parameters&, const Watched&);
};

namespace registry_detail {
template <class O>
ObserverEntry observer(const PartInfo& info) {
  return {&info, [](const Parameters& p, const Watched& watched) -> std::unique_ptr<Observer> {
            return std::make_unique<O>(p, watched);
          }};
}
}  // namespace registry_detail

inline const std::vector<ObserverEntry>& observerEntries() {
  using registry_detail::observer;
  static const std::vector<ObserverEntry> all = {observer<EnergyObserver>(energy_info),
                                                 observer<MomentumObserver>(momentum_info),
                                                 observer<QuaternionNormObserver>(quaternion_norm_info),
                                                 observer<FrameObserver>(frame_info),
                                                 observer<ImuObserver>(imu_info),
                                                 observer<FlipsObserver>(flips_info),
                                                 {&attitude_error_info, nullptr}};
  return all;
}

}  // namespace liecheck::scene
