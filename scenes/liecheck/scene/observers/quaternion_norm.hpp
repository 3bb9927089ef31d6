#pragma once
// Norm defect of stored unit vectors (quaternions, and (cos, sin) of joints) at every step.

#include <liecheck/scene/observers/observer.hpp>

namespace liecheck::scene {

inline const PartInfo quaternion_norm_info{"quaternion_norm",
                                           "max over joints of | |Q| - 1 |",
                                           "",
                                           "a sum of squares for each such joint, every step",
                                           {}};

class QuaternionNormObserver final : public Observer {
 public:
  QuaternionNormObserver(const Parameters&, const Watched& watched) : watched_(watched) {}
  Kinematics needs() const override { return Kinematics::None; }
  bool everyStep() const override { return true; }
  std::vector<Column> columns() const override { return {{"norm_defect", "eps"}}; }
  void step(const Now<double>& now) override {
    current_ = 0;
    const Model<double>& model = *watched_.model;
    for (std::size_t i = 1; i < model.joints.size(); ++i) {
      const int n = model.nqs[i],
                unit = std::visit([](const auto&j) { return int(j.unit_begin); }, model.joints[i]);
      if (unit == n) continue;
      double square = -1;  // becomes |Q|^2 - 1, computed with twice the digits
      CompensatedSum<double> sum;
      sum.add(square);
      for (int k = unit; k < n; ++k) {
        const double x = now.q[std::size_t(model.idx_qs[i] + k)];
        sum.add_product(x, x);
      }
      square = sum.value();
      current_ = std::max(current_, std::abs(square / (1 + std::sqrt(1 + square))) / eps<double>());
    }
    largest_ = std::max(largest_, current_);
  }
  void sample(const Now<double>&, std::span<double> row) override { row[0] = current_; }
  std::vector<Figure> figures() const override { return {{"largest norm defect", "eps", largest_}}; }

 private:
  Watched watched_;
  double current_ = 0, largest_ = 0;
};

}  // namespace liecheck::scene
