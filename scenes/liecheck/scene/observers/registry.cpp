#include <liecheck/scene/observers/centre_of_mass.hpp>
#include <liecheck/scene/observers/contact_forces.hpp>
#include <liecheck/scene/observers/energy.hpp>
#include <liecheck/scene/observers/flips.hpp>
#include <liecheck/scene/observers/frame_pose.hpp>
#include <liecheck/scene/observers/imu.hpp>
#include <liecheck/scene/observers/joint_forces.hpp>
#include <liecheck/scene/observers/loop_gaps.hpp>
#include <liecheck/scene/observers/momentum.hpp>
#include <liecheck/scene/observers/power.hpp>
#include <liecheck/scene/observers/quaternion_norm.hpp>
#include <liecheck/scene/observers/registry.hpp>
#include <liecheck/scene/observers/state.hpp>

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
                                                 observer<StateObserver>(state_info),
                                                 observer<CentreOfMassObserver>(centre_of_mass_info),
                                                 observer<JointForcesObserver>(joint_forces_info),
                                                 observer<ContactForcesObserver>(contact_forces_info),
                                                 observer<LoopGapsObserver>(loop_gaps_info),
                                                 observer<PowerObserver>(power_info),
                                                 {&attitude_error_info, nullptr}};
  return all;
}

const ObserverEntry& observerEntry(const std::string& name) {
  for (const ObserverEntry& e : observerEntries())
    if (name == e.info->name) return e;
  throw std::invalid_argument("no observer is named '" + name + "'");
}

}  // namespace liecheck::scene
