#include <liecheck/scene/observers/energy.hpp>
#include <liecheck/scene/observers/flips.hpp>
#include <liecheck/scene/observers/frame_pose.hpp>
#include <liecheck/scene/observers/imu.hpp>
#include <liecheck/scene/observers/momentum.hpp>
#include <liecheck/scene/observers/quaternion_norm.hpp>
#include <liecheck/scene/observers/registry.hpp>

namespace liecheck::scene {
namespace {

template <class O>
ObserverEntry observer(const PartInfo& info) {
  return {&info, [](const Parameters& p, const Watched& watched) -> std::unique_ptr<Observer> {
            return std::make_unique<O>(p, watched);
          }};
}

}  // namespace

const std::vector<ObserverEntry>& observerEntries() {
  static const std::vector<ObserverEntry> all = {observer<EnergyObserver>(energy_info),
                                                 observer<MomentumObserver>(momentum_info),
                                                 observer<QuaternionNormObserver>(quaternion_norm_info),
                                                 observer<FrameObserver>(frame_info),
                                                 observer<ImuObserver>(imu_info),
                                                 observer<FlipsObserver>(flips_info),
                                                 {&attitude_error_info, nullptr}};
  return all;
}

const ObserverEntry& observerEntry(const std::string& name) {
  for (const ObserverEntry& e : observerEntries())
    if (name == e.info->name) return e;
  throw std::invalid_argument("no observer is named '" + name + "'");
}

}  // namespace liecheck::scene
