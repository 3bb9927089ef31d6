#pragma once
// A constant generalised force at joints.

#include <liecheck/scene/effects/coordinates.hpp>

namespace liecheck::scene {

inline const PartInfo constant_force_info{
    "constant",
    "tau += tau_0",
    "adds or removes: power tau_0 v",
    "an addition for each coordinate",
    {{"joints", Kind::Joints, "", "all", "which joints"},
     {"force", Kind::Number, "N m|N", nullptr, "tau_0"}}};

template <Scalar S>
class ConstantForce final : public Effect<S> {
 public:
  ConstantForce(const Parameters& p, const Model<S>& model, const Surroundings&)
      : at_(coordinates(model, p.names("joints"))), force_(S(p.number("force"))) {}
  Acts acts() const override { return Acts::OnJoints; }
  void add(const Now<S>&, const Load<S>& load) const override {
    for (const Coordinate& c : at_) load.tau[std::size_t(c.v)] += force_;
  }

 private:
  std::vector<Coordinate> at_;
  S force_;
};

}  // namespace liecheck::scene
