#include <operations/operations.hpp>

namespace liecheck::properties {

const std::vector<const Operation*>& all_operations() {
  static const std::vector<const Operation*> all = [] {
    std::vector<const Operation*> list;
    const auto add = [&](const Operation& o) { list.push_back(&o); };
    SpatialSlots<double>::for_each(add);
    RobotOperations<double>::for_each(add);
    TreeOperations<double>::for_each(add);
    for (const Operation* formed :
         {&op::difference_of_integrate, &op::integrate_of_difference, &op::power, &op::energy_frames,
          &op::rnea_of_aba, &op::crba_symmetric, &op::crba_positive, &op::crba_columns, &op::tree_power,
          &op::momentum_conserved, &op::rnea_of_a_moved_world, &op::rnea_of_reordered_joints,
          &op::rnea_of_split_bodies})
      list.push_back(formed);
    return list;
  }();
  return all;
}

}  // namespace liecheck::properties
