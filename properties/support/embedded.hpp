#pragma once
// Data compiled into the program.

namespace liecheck::properties {
extern const char* const budgets_csv;          ///< properties/budgets/budgets.csv
extern const char* const built_in_robot_urdf;  ///< fixtures/robots/mixed_joints.urdf
extern const char* const quadruped_urdf;       ///< fixtures/robots/quadruped.urdf

struct EmbeddedFile {
  const char* name;  ///< null at the end of a list
  const char* text;
};
extern const EmbeddedFile hard_case_files[];  ///< fixtures/hard_cases/*.txt
extern const EmbeddedFile rules_files[];      ///< fixtures/rules/*.txt
}  // namespace liecheck::properties
