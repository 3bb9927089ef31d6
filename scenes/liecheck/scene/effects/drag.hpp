#pragma once
// Drag of a fluid at rest or in a uniform current. It acts at a frame's origin; u and omega are its velocities
// relative to the fluid.

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
                                 {"angular_quadratic", Kind::NotNegative, "N m s^2/rad^2", "0", "k2"},
                                 {"current", Kind::Vector, "m/s", "[0, 0, 0]",
                                  "velocity of the fluid, in the world; it can add energy"}}};

template <Scalar S>
class Drag final : public Effect<S> {
 public:
  Drag(const Parameters& p, const Model<S>& model, const Surroundings&)
      : spot_(model, p.word("frame")),
        c1_(S(p.number("linear"))),
        c2_(S(p.number("quadratic"))),
        k1_(S(p.number("angular_linear"))),
        k2_(S(p.number("angular_quadratic"))),
        current_(vectorOf<S>(p.numbers("current"))),
        flows_(!current_.isZero(S(0))) {}
  Acts acts() const override { return Acts::OnBodies; }
  bool passive() const override { return !flows_; }
  Kinematics needs() const override { return Kinematics::Velocities; }
  void add(const Now<S>& now, const Load<S>& load) const override {
    Motion<S> V = spot_.velocity(now);
    if (flows_)
      V = V - Motion<S>(transposed_product<S>(spot_.pose(now).rotation(), current_), Vector3<S>::Zero());
    using std::sqrt;
    const S f = c1_ + c2_ * S(sqrt(V.linear().squaredNorm())),
            n = k1_ + k2_ * S(sqrt(V.angular().squaredNorm()));
    spot_.add(now, load, Force<S>(Vector3<S>(-f * V.linear()), Vector3<S>(-n * V.angular())));
  }
  bool addConstant(const Vector3<S>& centre, BodyTerms<S>& terms) const override {
    if (flows_) return false;
    if (spot_.X_JF.translation() != centre && !(c1_ == S(0) && c2_ == S(0))) return false;
    terms.linear += c1_, terms.quadratic += c2_;
    terms.angular_linear += k1_, terms.angular_quadratic += k2_;
    return true;
  }

 private:
  Spot<S> spot_;
  S c1_, c2_, k1_, k2_;
  Vector3<S> current_;
  bool flows_;
};

}  // namespace liecheck::scene
