#pragma once
// Selects the argument of f(a, b) with respect to which a derivative is taken. The names are Pinocchio's.

namespace liecheck {

enum class ArgumentPosition {
  ARG0,  ///< the first: the configuration q of integrate, the first configuration of difference
  ARG1   ///< the second: the increment of integrate, the second configuration of difference
};

}  // namespace liecheck
