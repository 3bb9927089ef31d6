#pragma once
// Buoyancy of a fully immersed body: a force opposite to gravity, at the centre of the body's volume.

#include <liecheck/scene/effects/coordinates.hpp>

namespace liecheck::scene {

inline const PartInfo buoyancy_info{
    "buoyancy",
    "f = -rho V g at the frame's origin",
    "conserves: V = rho V g . p",
    "poses",
    {{"frame", Kind::Frame, "", nullptr, "the frame whose origin is the centre of the volume"},
     {"volume", Kind::Positive, "m^3", nullptr, "V"},
     {"density", Kind::Positive, "kg/m^3", "1000", "rho of the fluid"},
     {"acceleration", Kind::Vector, "m/s^2", "[0, 0, -9.81]", "g; use the value of the effect gravity"}}};

template <Scalar S>
class Buoyancy final : public Effect<S> {
 public:
  Buoyancy(const Parameters& p, const Model<S>& model, const Surroundings&)
      : spot_(model, p.word("frame")),
        f_(-S(p.number("density")) * S(p.number("volume")) * vectorOf<S>(p.numbers("acceleration"))) {}
  Acts acts() const override { return Acts::OnBodies; }
  bool conservative() const override { return true; }
  Kinematics needs() const override { return Kinematics::Poses; }
  void add(const Now<S>& now, const Load<S>& load) const override {
    spot_.addWorld(now, load, f_, Vector3<S>::Zero());
  }
  S potential(const Now<S>& now) const override { return -f_.dot(spot_.pose(now).translation()); }
  bool addConstant(const Vector3<S>& centre, BodyTerms<S>& terms) const override {
    if (spot_.X_JF.translation() != centre) return false;
    terms.force_W += f_;
    return true;
  }

 private:
  Spot<S> spot_;
  Vector3<S> f_;
};

}  // namespace liecheck::scene
