#pragma once
// Inertia of the motors, as seen at the output of their gears: it is added to the diagonal of M.

#include <liecheck/scene/effects/coordinates.hpp>

namespace liecheck::scene {

inline const PartInfo armature_info{
    "armature",
    "M += diag(I_m)",
    "conserves: T += 1/2 I_m v^2",
    "nothing: the articulated-body algorithm includes it",
    {{"joints", Kind::Joints, "", "all", "which joints"},
     {"inertia", Kind::NotNegative, "kg m^2|kg", nullptr, "I_m at the joint"}}};

template <Scalar S>
class Armature final : public Effect<S> {
 public:
  Armature(const Parameters& p, const Model<S>& model, const Surroundings&)
      : at_(coordinates(model, p.names("joints"))), inertia_(S(p.number("inertia"))) {}
  Acts acts() const override { return Acts::OnModel; }
  bool conservative() const override { return true; }
  void prepare(Model<S>& model) const override {
    for (const Coordinate& c : at_) model.armature[c.v] += inertia_;
  }

 private:
  std::vector<Coordinate> at_;
  S inertia_;
};

}  // namespace liecheck::scene
