#pragma once
// Springs at joints.

#include <liecheck/scene/effects/coordinates.hpp>

namespace liecheck::scene {

inline const PartInfo joint_spring_info{
    "joint_spring",
    "tau -= k (q - q_rest)",
    "conserves: V = 1/2 k (q - q_rest)^2",
    "a product for each coordinate",
    {{"joints", Kind::Joints, "", "all", "which of the joints with a scalar position"},
     {"stiffness", Kind::NotNegative, "N m/rad|N/m", nullptr, "k"},
     {"rest", Kind::Number, "rad|m", "0", "q_rest"}}};

template <Scalar S>
class JointSpring final : public Effect<S> {
 public:
  JointSpring(const Parameters& p, const Model<S>& model, const Surroundings&)
      : at_(positions(model, p.names("joints"))), k_(S(p.number("stiffness"))), rest_(S(p.number("rest"))) {}
  Acts acts() const override { return Acts::OnJoints; }
  bool conservative() const override { return true; }
  void add(const Now<S>& now, const Load<S>& load) const override {
    for (const Coordinate& c : at_) load.tau[std::size_t(c.v)] -= k_ * (now.q[std::size_t(c.q)] - rest_);
  }
  S potential(const Now<S>& now) const override {
    S energy(0);
    for (const Coordinate& c : at_) {
      const S x = now.q[std::size_t(c.q)] - rest_;
      energy += k_ * x * x / S(2);
    }
    return energy;
  }

 private:
  std::vector<Coordinate> at_;
  S k_, rest_;
};

}  // namespace liecheck::scene
