#pragma once
// Flips of a body: the times at which its angular velocity about a body-fixed axis changes sign, from the
// cubic Hermite interpolant of omega over a step. Error h^4/384 |omega^(4)| / |omega_dot| [s], plus the
// method's error.

#include <liecheck/scene/effects/coordinates.hpp>
#include <liecheck/scene/observers/observer.hpp>

namespace liecheck::scene {

inline const PartInfo flips_info{
    "flips",
    "t with omega(t) . axis = 0, the axis fixed to the frame",
    "",
    "accelerations, every step",
    {{"frame", Kind::Frame, "", nullptr, "a frame fixed to the body"},
     {"axis", Kind::Direction, "1", "[0, 1, 0]", "in the frame; any length but 0"}}};

class FlipsObserver final : public Observer {
 public:
  FlipsObserver(const Parameters& p, const Watched& watched)
      : spot_(*watched.model, p.word("frame")),
        axis_(Axis<double>(vectorOf<double>(p.numbers("axis"))).to_vector()) {
    times_.reserve(1 << 16);
  }
  Kinematics needs() const override { return Kinematics::Accelerations; }
  bool everyStep() const override { return true; }
  std::vector<Column> columns() const override { return {{"flips", "1"}}; }
  void step(const Now<double>& now) override {
    const double w = axis_.dot(spot_.velocity(now).angular());
    const double rate = axis_.dot(spot_.X_JF.actInv(now.A[spot_.joint]).angular());
    if (begun_ && ((w_ < 0 && w >= 0) || (w_ > 0 && w <= 0))) times_.push_back(crossing(now.t, w, rate));
    if (w != 0 || !begun_) t_ = now.t, w_ = w, rate_ = rate;
    begun_ = true;
  }
  void sample(const Now<double>&, std::span<double> row) override { row[0] = double(times_.size()); }
  std::vector<Figure> figures() const override {
    std::vector<Figure> all{{"flips", "1", double(times_.size())}};
    for (std::size_t i = 0; i < times_.size() && i < 100; ++i)
      all.push_back({"flip " + std::to_string(i + 1), "s", times_[i]});
    return all;
  }
  const std::vector<double>& times() const { return times_; }

 private:
  /// The root of the cubic. 60 bisections reduce its interval below half an ulp of the step.
  double crossing(double t1, double w1, double rate1) const {
    const double h = t1 - t_;
    double low = 0, high = 1;
    const auto value = [&](double s) {
      const double r = 1 - s;
      return r * r * ((1 + 2 * s) * w_ + s * h * rate_) + s * s * ((3 - 2 * s) * w1 - r * h * rate1);
    };
    for (int k = 0; k < 60; ++k) {
      const double middle = (low + high) / 2;
      ((value(middle) < 0) == (w_ < 0) ? low : high) = middle;
    }
    return t_ + h * (low + high) / 2;
  }
  Spot<double> spot_;
  Vector3<double> axis_;
  std::vector<double> times_;
  double t_ = 0, w_ = 0, rate_ = 0;
  bool begun_ = false;
};

}  // namespace liecheck::scene
