#pragma once
// A robot as the text of a URDF, for subjects with a URDF reader of their own.

#include <memory>
#include <string>
#include <vector>

namespace liecheck::properties {

struct UrdfModel {
  std::string text;
  bool fixed = false;               ///< the root is welded to the world; otherwise it is a free-flyer
  bool coupled = false;             ///< mimic joints have no coordinates
  std::vector<std::string> joints;  ///< those that move, in the order of q and v
  int nq = 0, nv = 0;
};

/// Reads the text for the order of its joints, after whose primaries `coupled` mimics come. Throws what the URDF reader throws.
std::shared_ptr<const UrdfModel> urdf_model(const std::string& text, bool fixed, bool coupled = false);

}  // namespace liecheck::properties
