#pragma once
// Gravity. The base of a tree gets the acceleration -g, which needs no loop over the bodies.

#include <liecheck/scene/effects/coordinates.hpp>

namespace liecheck::scene {

inline const PartInfo gravity_info{
    "gravity",
    "p_ddot += g",
    "conserves: V = -sum m g . c",
    "R^T g for a lone body; nothing for a tree, whose base accelerates",
    {{"acceleration", Kind::Vector, "m/s^2", "[0, 0, -9.81]", "g, in the world"}}};

template <Scalar S>
class Gravity final : public Effect<S> {
 public:
  Gravity(const Parameters& p, const Model<S>& model, const Surroundings&)
      : g_(vectorOf<S>(p.numbers("acceleration"))), inertias_(model.inertias) {}
  Acts acts() const override { return Acts::OnModel; }
  bool conservative() const override { return true; }
  void prepare(Model<S>& model) const override { model.gravity += g_; }
  S potential(const Now<S>& now) const override {
    S energy(0);
    for (std::size_t i = 1; i < inertias_.size(); ++i)
      energy -= inertias_[i].mass() * g_.dot(now.X_WJ[i].act(inertias_[i].lever()));
    return energy;
  }

 private:
  Vector3<S> g_;
  std::vector<Inertia<S>> inertias_;
};

}  // namespace liecheck::scene
