#pragma once
// Regularised dry friction at joints: a force against the motion that vanishes smoothly at v = 0.

#include <liecheck/scene/effects/coordinates.hpp>

namespace liecheck::scene {

inline const PartInfo joint_friction_info{
    "joint_friction",
    "tau -= f v / sqrt(v^2 + v_s^2)",
    "dissipates: power -f v^2 / sqrt(v^2 + v_s^2)",
    "a square root for each coordinate",
    {{"joints", Kind::Joints, "", "all", "which joints"},
     {"force", Kind::NotNegative, "N m|N", "", "f; taken from the URDF if missing"},
     {"slip", Kind::Positive, "rad/s|m/s", "0.001", "v_s: a joint at rest creeps at less than v_s"}}};

template <Scalar S>
class JointFriction final : public Effect<S> {
 public:
  JointFriction(const Parameters& p, const Model<S>& model, const Surroundings&)
      : slip_(S(p.number("slip")) * S(p.number("slip"))) {
    for (const Coordinate& c : coordinates(model, p.names("joints")))
      terms_.emplace_back(c.v, p.has("force") ? S(p.number("force")) : model.friction[c.v]);
  }
  Acts acts() const override { return Acts::OnJoints; }
  bool passive() const override { return true; }
  void add(const Now<S>& now, const Load<S>& load) const override {
    using std::sqrt;
    for (const auto& [k, f] : terms_) {
      const S& v = now.v[std::size_t(k)];
      load.tau[std::size_t(k)] -= f * v / S(sqrt(v * v + slip_));
    }
  }

 private:
  std::vector<std::pair<int, S>> terms_;
  S slip_;
};

}  // namespace liecheck::scene
