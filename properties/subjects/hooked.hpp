#pragma once
// A subject's operations as the harness calls them, each call of which goes through a hook: to note the calls.

#include <subjects/tree.hpp>

namespace liecheck::properties {

template <class Number, class Hook, const auto&... all>
void hook_slots(Slots<Number, all...>& slots, const Hook& hook) {
  const auto one = [&hook](const auto& operation, auto& slot) {
    if (slot)
      slot = [hook, &operation, function = slot](const auto&... arguments) {
        return hook(operation, function, arguments...);
      };
  };
  (one(all, slots[all]), ...);
}

/// The operations of `base`, whose calls become hook(operation, function, arguments...), where `function` is the
/// function of the base. What the hook returns is the result. A hook is const callable and copied.
template <class Hook>
Operations hooked(Operations base, const Hook& hook) {
  hook_slots(static_cast<SpatialSlots<Doubles>&>(base), hook);
  if (base.robot)
    base.robot = [robot = base.robot, hook](const std::string& urdf, bool fixed) {
      RobotOperations<double> o = robot(urdf, fixed);
      hook_slots(o, hook);
      return o;
    };
  if (base.tree)
    base.tree = [build = base.tree, hook](const Tree<double>& tree) {
      TreeOperations<double> o = build(tree);
      hook_slots(o, hook);
      return o;
    };
  return base;
}

}  // namespace liecheck::properties
