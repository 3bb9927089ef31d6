#pragma once
// What a subject takes where the inputs of a law differ in kind: they are drawn from it. By default everything.

#include <cstdint>
#include <functional>
#include <map>
#include <oracles/joint_set.hpp>
#include <string>

namespace liecheck::properties {

struct Taken {
  static constexpr std::uint32_t every_order = (1u << 24) - 1;
  oracles::JointSet joints;            ///< of its trees
  std::uint32_t orders = every_order;  ///< of its Euler angles: bit k for order k
  std::uint32_t fractions = 15;        ///< of t, and of axes: the bits of operations/argument_kinds.hpp
  std::uint32_t axes = 15;
  /// The bits of one operation, by its name, that takes less than all of them together.
  std::map<std::string, std::uint32_t, std::less<>> of_operation = {};
  bool quaternion_poses = false;  ///< its poses are (p, Q): operations/quaternion_poses.hpp
  bool reads_urdf = false;        ///< with a reader of its own
  bool mimics = false;            ///< this reader couples mimic joints
};

}  // namespace liecheck::properties
