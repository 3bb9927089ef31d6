#pragma once
// A tree of bodies or a robot, as the C interface gives it to open_model.

#include <adapters/liecheck_adapter.h>
#include <string>
#include <string_view>
#include <vector>

namespace liecheck::properties::adapters {

/// Holds what the pointers of a liecheck_model point to.
class FlatModel {
 public:
  /// `text` is the line of JSON that a Model (trees.hpp) writes.
  explicit FlatModel(std::string_view text);
  FlatModel(const FlatModel&) = delete;
  FlatModel& operator=(const FlatModel&) = delete;
  const liecheck_model& model() const { return model_; }

 private:
  std::vector<liecheck_joint> joints_;
  std::vector<liecheck_body> bodies_;
  std::string urdf_;
  std::vector<std::string> order_;
  std::vector<const char*> names_;
  liecheck_model model_{};
};

}  // namespace liecheck::properties::adapters
