#pragma once
// The list of effects and actuations. A new one needs its own file and an entry here.

#include <liecheck/scene/effects/added_mass.hpp>
#include <liecheck/scene/effects/armature.hpp>
#include <liecheck/scene/effects/buoyancy.hpp>
#include <liecheck/scene/effects/closed_loops.hpp>
#include <liecheck/scene/effects/collisions.hpp>
#include <liecheck/scene/effects/constant_force.hpp>
#include <liecheck/scene/effects/contact.hpp>
#include <liecheck/scene/effects/drag.hpp>
#include <liecheck/scene/effects/force_table.hpp>
#include <liecheck/scene/effects/gravity.hpp>
#include <liecheck/scene/effects/joint_damping.hpp>
#include <liecheck/scene/effects/joint_friction.hpp>
#include <liecheck/scene/effects/joint_limits.hpp>
#include <liecheck/scene/effects/joint_spring.hpp>
#include <liecheck/scene/effects/motor.hpp>
#include <liecheck/scene/effects/pd_control.hpp>
#include <liecheck/scene/effects/thruster.hpp>
#include <liecheck/scene/effects/wrench.hpp>

namespace liecheck::scene {

template <Scalar S>
struct EffectEntry {
  const PartInfo* info;
  std::unique_ptr<const Effect<S>> (*make)(const Parameters&, const Model<S>&, const Surroundings&);
};

namespace registry_detail {
template <Scalar S, class E>
EffectEntry<S> entry(const PartInfo& info) {
  return {&info, [](const Parameters& p, const Model<S>& model, const Surroundings& around) {
            return std::unique_ptr<const Effect<S>>(new E(p, model, around));
          }};
}
}  // namespace registry_detail

template <Scalar S>
const std::vector<EffectEntry<S>>& effectEntries() {
  using registry_detail::entry;
  static const std::vector<EffectEntry<S>> all = {entry<S, Gravity<S>>(gravity_info),
                                                  entry<S, Wrench<S>>(wrench_info),
                                                  entry<S, JointDamping<S>>(joint_damping_info),
                                                  entry<S, JointFriction<S>>(joint_friction_info),
                                                  entry<S, JointSpring<S>>(joint_spring_info),
                                                  entry<S, JointLimits<S>>(joint_limits_info),
                                                  entry<S, Armature<S>>(armature_info),
                                                  entry<S, Drag<S>>(drag_info),
                                                  entry<S, Buoyancy<S>>(buoyancy_info),
                                                  entry<S, Thruster<S>>(thruster_info),
                                                  entry<S, Contact<S>>(contact_info),
                                                  entry<S, Collisions<S>>(collisions_info),
                                                  entry<S, AddedMass<S>>(added_mass_info),
                                                  entry<S, ClosedLoops<S>>(closed_loops_info)};
  return all;
}
template <Scalar S>
const std::vector<EffectEntry<S>>& actuationEntries() {
  using registry_detail::entry;
  static const std::vector<EffectEntry<S>> all = {
      entry<S, ConstantForce<S>>(constant_force_info), entry<S, PdControl<S>>(pd_control_info),
      entry<S, ForceTable<S>>(force_table_info), entry<S, Motor<S>>(motor_info)};
  return all;
}

/// The entry of an effect or actuation. Throws std::invalid_argument for an unknown name.
template <Scalar S>
const EffectEntry<S>& effectEntry(const std::string& name) {
  for (const auto* list : {&effectEntries<S>(), &actuationEntries<S>()})
    for (const EffectEntry<S>& e : *list)
      if (name == e.info->name) return e;
  throw std::invalid_argument("no effect is named '" + name + "'");
}
/// The effect of a checked request. Throws std::invalid_argument if the effect does not fit the robot.
template <Scalar S>
std::shared_ptr<const Effect<S>> makeEffect(const Request& request, const Model<S>& model,
                                            const Surroundings& around) {
  return effectEntry<S>(request.name).make(request.parameters, model, around);
}

// Explicit instantiation for double, in instantiations.cpp.
extern template const std::vector<EffectEntry<double>>& effectEntries<double>();
extern template const std::vector<EffectEntry<double>>& actuationEntries<double>();

}  // namespace liecheck::scene
