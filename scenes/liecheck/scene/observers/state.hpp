#pragma once
// The state itself, and its acceleration.

#include <algorithm>
#include <liecheck/scene/observers/coordinate_names.hpp>

namespace liecheck::scene {

inline const PartInfo state_info{"state", "q, v, a = v_dot", "", "accelerations at samples", {}};

class StateObserver final : public Observer {
 public:
  StateObserver(const Parameters&, const Watched& watched) : model_(*watched.model) {}
  Kinematics needs() const override { return Kinematics::Accelerations; }
  std::vector<Column> columns() const override {
    std::vector<Column> all = configurationColumns(model_, "q.");
    for (const auto& [name, angular] : velocityNames(model_))
      all.push_back({"v." + name, angular ? "rad/s" : "m/s"});
    for (const auto& [name, angular] : velocityNames(model_))
      all.push_back({"a." + name, angular ? "rad/s^2" : "m/s^2"});
    return all;
  }
  void sample(const Now<double>& now, std::span<double> row) override {
    std::ranges::copy(now.a, std::ranges::copy(now.v, std::ranges::copy(now.q, row.begin()).out).out);
  }

 private:
  const Model<double>& model_;
};

}  // namespace liecheck::scene
