#pragma once
// Drag of a fluid at rest. It acts at a frame's origin.

#include <liecheck/scene/effects/coordinates.hpp>

namespace liecheck::scene {

inline const PartInfo drag_info{"drag",
                                "f = -(c1 + c2 |u|) u,  n = -(k1 + k2 |omega|) omega",
                                "dissipates: power -(c1 + c2 |u|) |u|^2 - (k1 + k2 |omega|) |omega|^2",
                                "velocities; two square roots",
                                {{"frame", Kind::Frame, "", nullptr, "where it acts"},
                                 {"linear", Kind::NotNegative, "N s/m", "0", "c1"},
                                 {"quadratic", Kind::NotNegative, "N s^2/m^2", "0", "c2 = 1/2 rho C_d A"},
                                 {"angular_linear", Kind::NotNegative, "N m s/rad", "0", "k1"},
                                 {"angular_quadratic", Kind::NotNegative, "N m s^2/rad^2", "0", "k2"}}};

template <Scalar S>
class Drag final : public Effect<S> {
 public:
  Drag(const Parameters& p, const Model<S>& model, const Surroundings&)
      : spot_(model, p.word("frame")),
        c1_(S(p.number("linear"))),
        c2_(S(p.number("quadratic"))),
        k1_(S(p.number("angular_linear"))),
        k2_(S(p.number("angular_quadratic"))) {}
  Acts acts() const override { return Acts::OnBodies; }
  Kinematics needs() const override { return Kinematics::Velocities; }
  void add(const Now<S>& now, const Load<S>& load) const override {
    const Motion<S> V = spot_.velocity(now);
    using std::sqrt;
    const S f = c1_ + c2_ * S(sqrt(V.linear().squaredNorm())),
            n = k1_ + k2_ * S(sqrt(V.angular().squaredNorm()));
    spot_.add(now, load, Force<S>(Vector3<S>(-f * V.linear()), Vector3<S>(-n * V.angular())));
  }
  bool addConstant(const Vector3<S>& centre, BodyTerms<S>& terms) const override {
    if (spot_.X_JF.translation() != centre && !(c1_ == S(0) && c2_ == S(0))) return false;
    terms.linear += c1_, terms.quadratic += c2_;
    terms.angular_linear += k1_, terms.angular_quadratic += k2_;
    return true;
  }

 private:
  Spot<S> spot_;
  S c1_, c2_, k1_, k2_;
};

}  // namespace liecheck::scene
