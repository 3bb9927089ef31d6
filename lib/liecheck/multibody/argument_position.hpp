#pragma once
// Which argument of f(a, b) a derivative is taken by. Pinocchio's names.

namespace liecheck {

enum class ArgumentPosition {
  ARG0,  ///< by the first argument: the configuration it starts from
  ARG1   ///< by the second: the increment of integrate, the end of difference
};

}  // namespace liecheck
