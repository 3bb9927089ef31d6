#pragma once
// Compliant contact of points with the ground z = height (Hunt and Crossley 1975), and regularised friction.
//
//   x = height - z,  f_n = k x (1 + c x_dot)_+,  f_t = -mu f_n u_t / sqrt(|u_t|^2 + v_s^2)
//
// The force is continuous at first touch and never pulls. A point at rest on a slope creeps at less than v_s.

#include <algorithm>
#include <liecheck/scene/effects/coordinates.hpp>

namespace liecheck::scene {

inline const PartInfo contact_info{
    "contact",
    "f_n = k x (1 + c x_dot)_+,  f_t = -mu f_n u_t / sqrt(|u_t|^2 + v_s^2),  x = depth below the ground",
    "conserves with c = mu = 0: V = 1/2 k x^2; otherwise dissipates",
    "velocities; a comparison for each point, a square root for each point in contact",
    {{"frames", Kind::Frames, "", nullptr, "the frames whose origins are the contact points"},
     {"stiffness", Kind::Positive, "N/m", nullptr, "k"},
     {"dissipation", Kind::NotNegative, "s/m", "0", "c"},
     {"friction", Kind::NotNegative, "1", "0", "mu"},
     {"slip", Kind::Positive, "m/s", "0.001", "v_s"}}};

template <Scalar S>
class Contact final : public Effect<S> {
 public:
  Contact(const Parameters& p, const Model<S>& model, const Surroundings& around)
      : height_(S(around.height)),
        k_(S(p.number("stiffness"))),
        c_(S(p.number("dissipation"))),
        mu_(S(p.number("friction"))),
        slip_(S(p.number("slip")) * S(p.number("slip"))) {
    if (!around.ground)
      throw std::invalid_argument("contact without a ground: write 'ground: {height: 0}' in the scene");
    for (const std::string& frame : p.names("frames")) points_.emplace_back(model, frame);
  }
  Acts acts() const override { return Acts::OnBodies; }
  bool conservative() const override { return c_ == S(0) && mu_ == S(0); }
  Kinematics needs() const override { return Kinematics::Velocities; }
  void add(const Now<S>& now, const Load<S>& load) const override {
    for (const Spot<S>& point : points_) {
      const SE3<S>& X = now.X_WJ[point.joint];
      const S depth = height_ - X.act(point.X_JF.translation())[2];
      if (!(depth > S(0))) continue;
      const Motion<S>& V = now.V[point.joint];
      const Vector3<S> u_J = V.linear() + cross<S>(V.angular(), point.X_JF.translation());
      const Vector3<S> u = product<S>(X.rotation(), u_J);
      const S normal = std::max(S(k_ * depth * (S(1) - c_ * u[2])), S(0));
      using std::sqrt;
      const S drag = mu_ * normal / S(sqrt(u[0] * u[0] + u[1] * u[1] + slip_));
      point.addWorld(now, load, Vector3<S>(-drag * u[0], -drag * u[1], normal), Vector3<S>::Zero());
    }
  }
  S potential(const Now<S>& now) const override {
    S energy(0);
    for (const Spot<S>& point : points_) {
      const S x = std::max(S(height_ - point.pose(now).translation()[2]), S(0));
      energy += k_ * x * x / S(2);
    }
    return energy;
  }

 private:
  std::vector<Spot<S>> points_;
  S height_, k_, c_, mu_, slip_;
};

}  // namespace liecheck::scene
