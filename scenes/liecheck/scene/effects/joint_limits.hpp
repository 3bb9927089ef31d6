#pragma once
// Position limits as Hunt-Crossley springs. They act beyond the limit and never pull.

#include <algorithm>
#include <liecheck/scene/effects/coordinates.hpp>

namespace liecheck::scene {

inline const PartInfo joint_limits_info{
    "joint_limits",
    "tau += k x (1 + c x_dot)_+ inwards, x = depth beyond the robot's position limit",
    "conserves with c = 0: V = 1/2 k x^2; dissipates with c > 0",
    "two comparisons for each coordinate that has limits",
    {{"joints", Kind::Joints, "", "all", "which of the joints with a scalar position"},
     {"stiffness", Kind::Positive, "N m/rad|N/m", nullptr, "k"},
     {"dissipation", Kind::NotNegative, "s/rad|s/m", "0", "c of Hunt and Crossley (1975)"}}};

template <Scalar S>
class JointLimits final : public Effect<S> {
 public:
  JointLimits(const Parameters& p, const Model<S>& model, const Surroundings&)
      : k_(S(p.number("stiffness"))), c_(S(p.number("dissipation"))) {
    for (const Coordinate& x : positions(model, p.names("joints"))) {
      const S low = model.lowerPositionLimit[x.q], high = model.upperPositionLimit[x.q];
      if (finite<S>(low) || finite<S>(high)) at_.push_back({x, low, high});
    }
  }
  Acts acts() const override { return Acts::OnJoints; }
  bool conservative() const override { return c_ == S(0); }
  bool passive() const override { return true; }
  void add(const Now<S>& now, const Load<S>& load) const override {
    for (const Limited& j : at_) {
      const S& q = now.q[std::size_t(j.at.q)];
      const S& v = now.v[std::size_t(j.at.v)];
      if (finite<S>(j.low)) load.tau[std::size_t(j.at.v)] += force(now, S(j.low - q), S(-v));
      if (finite<S>(j.high)) load.tau[std::size_t(j.at.v)] -= force(now, S(q - j.high), v);
    }
  }
  S potential(const Now<S>& now) const override {
    S energy(0);
    for (const Limited& j : at_) {
      const S& q = now.q[std::size_t(j.at.q)];
      const S x = q < j.low ? S(j.low - q) : q > j.high ? S(q - j.high) : S(0);
      energy += k_ * x * x / S(2);
    }
    return energy;
  }

 private:
  struct Limited {
    Coordinate at;
    S low, high;
  };
  /// The force at depth x, where `rate` is the time derivative of x.
  S force(const Now<S>& now, const S& x, const S& rate) const {
    const S factor = S(1) + c_ * rate;
    return now.on(x > S(0) ? std::min(x, factor) : x) ? S(k_ * x * factor) : S(0);
  }
  S k_, c_;
  std::vector<Limited> at_;
};

}  // namespace liecheck::scene
