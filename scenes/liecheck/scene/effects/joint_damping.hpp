#pragma once
// Viscous damping at joints.

#include <liecheck/scene/effects/coordinates.hpp>

namespace liecheck::scene {

inline const PartInfo joint_damping_info{
    "joint_damping",
    "tau -= d v",
    "dissipates: power -d v^2",
    "a product for each coordinate",
    {{"joints", Kind::Joints, "", "all", "which joints"},
     {"coefficient", Kind::NotNegative, "N m s/rad|N s/m", "", "d; taken from the URDF if missing"}}};

template <Scalar S>
class JointDamping final : public Effect<S> {
 public:
  JointDamping(const Parameters& p, const Model<S>& model, const Surroundings&) {
    for (const Coordinate& c : coordinates(model, p.names("joints")))
      terms_.emplace_back(c.v, p.has("coefficient") ? S(p.number("coefficient")) : model.damping[c.v]);
  }
  Acts acts() const override { return Acts::OnJoints; }
  bool passive() const override { return true; }
  void add(const Now<S>& now, const Load<S>& load) const override {
    const S* const v = now.v.data();
    S* const tau = load.tau.data();
    for (const auto& [k, d] : terms_) tau[k] -= d * v[k];
  }

 private:
  std::vector<std::pair<int, S>> terms_;
};

}  // namespace liecheck::scene
