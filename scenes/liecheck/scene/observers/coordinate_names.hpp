#pragma once
// Names and units of the numbers of q and v: that of the joint, and the part if a joint has several.

#include <liecheck/scene/observers/observer.hpp>

namespace liecheck::scene {

/// A number of v: `hinge1` or `root_joint.wx`, and whether it is an angular velocity [rad/s] or a velocity [m/s].
struct VelocityName {
  std::string name;
  bool angular;
};

/// The names of all numbers of v [nv].
inline std::vector<VelocityName> velocityNames(const Model<double>& model) {
  std::vector<VelocityName> all;
  for (std::size_t i = 1; i < model.joints.size(); ++i) {
    const auto& joint = model.joints[i];
    const int n = model.nvs[i], turning = std::holds_alternative<FreeFlyer<double>>(joint)   ? 3
                                          : std::holds_alternative<Planar<double>>(joint)    ? 1
                                          : std::holds_alternative<Spherical<double>>(joint) ? 3
                                                                                             : 0;
    static const char* const parts[] = {"x", "y", "z", "wx", "wy", "wz"};
    for (int k = 0; k < n; ++k) {
      const bool angular = n == 1 ? !std::holds_alternative<Prismatic<double>>(joint) : k >= n - turning;
      const char* part = !angular ? parts[k] : turning == 1 ? "wz" : parts[6 - n + k];
      all.push_back({model.names[i] + (n == 1 ? "" : std::string(".") + part), angular});
    }
  }
  return all;
}

/// The names and units of all numbers of q [nq], each with `prefix`. Unit vectors are qx, qy, qz, qw or cos, sin.
inline std::vector<Column> configurationColumns(const Model<double>& model, const std::string& prefix) {
  std::vector<Column> all;
  for (std::size_t i = 1; i < model.joints.size(); ++i) {
    const int n = model.nqs[i],
              unit = std::visit([](const auto&j) { return int(j.unit_begin); }, model.joints[i]);
    static const char *const position[] = {"x", "y", "z"}, *const quaternion[] = {"qx", "qy", "qz", "qw"},
                             *const circle[] = {"cos", "sin"};
    for (int k = 0; k < n; ++k) {
      const char* part = k < unit ? position[k] : n - unit == 4 ? quaternion[k - unit] : circle[k - unit];
      const bool angle = n == 1 && !std::holds_alternative<Prismatic<double>>(model.joints[i]);
      all.push_back({prefix + model.names[i] + (n == 1 ? "" : std::string(".") + part), k >= unit ? "1"
                                                                                        : angle   ? "rad"
                                                                                                  : "m"});
    }
  }
  return all;
}

}  // namespace liecheck::scene
