#pragma once
// Data compiled into the program.

namespace liecheck::properties {
extern const char* const budgets_csv;          ///< properties/budgets.csv
extern const char* const built_in_robot_urdf;  ///< fixtures/robots/mixed_joints.urdf
}  // namespace liecheck::properties
