#pragma once
// Compliant contact of spheres, or of points if their radius r is 0, with the ground (Hunt and Crossley 1975), and
// regularised friction. The ground is the plane with the unit normal n through (0, 0, height).
//
//   x = r - n . (p - (0, 0, height))                         depth below the ground, p = centre of the sphere
//   u = velocity of the body at the contact point p - r n,   u_t = u - (n . u) n,   x_dot = -n . u
//   f = f_n n - mu f_n u_t / sqrt(|u_t|^2 + v_s^2),          f_n = k x (1 + c x_dot)_+
//   moment about p = -r n x f - rho f_n w_t / sqrt(|w_t|^2 + w_s^2) - tau f_n w_n n / sqrt(w_n^2 + w_s^2)
//
// with the angular velocity w = w_t + w_n n. The force is continuous at first touch and never pulls.
//
// Creep: a body at rest on a slope, which friction must hold by the force T < mu N, does not rest, but creeps with
// |u_t| = v_s s / sqrt(1 - s^2), s = T/(mu N): this solves the law of friction for u_t.

#include <algorithm>
#include <liecheck/scene/effects/coordinates.hpp>

namespace liecheck::scene {

inline const PartInfo contact_info{
    "contact",
    "f_n = k x (1 + c x_dot)_+,  f_t = -mu f_n u_t / sqrt(|u_t|^2 + v_s^2),  x = depth below the ground",
    "conserves with c = mu = rho = tau = 0: V = 1/2 k x^2; otherwise dissipates",
    "velocities; a comparison for each point, a square root for each point in contact",
    {{"frames", Kind::Frames, "", nullptr,
      "the frames whose origins are the contact points, or the centres of spheres"},
     {"radius", Kind::NotNegative, "m", "0", "r, of the spheres about these frames; 0 for points"},
     {"stiffness", Kind::Positive, "N/m", nullptr, "k"},
     {"dissipation", Kind::NotNegative, "s/m", "0", "c"},
     {"friction", Kind::NotNegative, "1", "0", "mu"},
     {"slip", Kind::Positive, "m/s", "0.001", "v_s"},
     {"rolling", Kind::NotNegative, "m", "0",
      "rho: the moment rho f_n against the rotation w_t in the ground's plane"},
     {"torsion", Kind::NotNegative, "m", "0",
      "tau: the moment tau f_n against the rotation w_n about the normal"},
     {"angular_slip", Kind::Positive, "rad/s", "0.01", "w_s, below which both moments decrease to 0"}}};

template <Scalar S>
class Contact final : public Effect<S> {
 public:
  Contact(const Parameters& p, const Model<S>& model, const Surroundings& around)
      : n_(S(around.normal[0]), S(around.normal[1]), S(around.normal[2])),
        offset_(n_[2] * S(around.height)),
        r_(S(p.number("radius"))),
        k_(S(p.number("stiffness"))),
        c_(S(p.number("dissipation"))),
        mu_(S(p.number("friction"))),
        slip_(S(p.number("slip")) * S(p.number("slip"))),
        rolling_(S(p.number("rolling"))),
        torsion_(S(p.number("torsion"))),
        angular_slip_(S(p.number("angular_slip")) * S(p.number("angular_slip"))),
        turns_(r_ > S(0) || rolling_ > S(0) || torsion_ > S(0)) {
    if (!around.ground)
      throw std::invalid_argument("contact without a ground: write 'ground: {height: 0}' in the scene");
    for (const std::string& frame : p.names("frames")) points_.emplace_back(model, frame);
  }
  Acts acts() const override { return Acts::OnBodies; }
  bool conservative() const override {
    return c_ == S(0) && mu_ == S(0) && rolling_ == S(0) && torsion_ == S(0);
  }
  Kinematics needs() const override { return Kinematics::Velocities; }
  void add(const Now<S>& now, const Load<S>& load) const override {
    for (const Spot<S>& point : points_) {
      const SE3<S>& X = now.X_WJ[point.joint];
      const S depth = depthOf(X.act(point.X_JF.translation()));
      const bool deep = depth > S(0);
      Vector3<S> u = Vector3<S>::Zero(), w = Vector3<S>::Zero();
      if (deep) velocity(now, point, u, w);
      // The force acts while the point is below the ground and does not leave it faster than 1/c.
      if (!now.on(deep ? std::min(depth, S(S(1) - c_ * n_.dot(u))) : depth)) continue;
      if (!deep) velocity(now, point, u, w);
      const S rising = n_.dot(u), normal = k_ * depth * (S(1) - c_ * rising);
      using std::sqrt;
      const Vector3<S> u_t = u - rising * n_;
      const S drag = mu_ * normal / S(sqrt(u_t.squaredNorm() + slip_));
      const Vector3<S> f = normal * n_ - drag * u_t;
      Vector3<S> moment = Vector3<S>::Zero();
      if (turns_) {
        const S spin = n_.dot(w);
        const Vector3<S> w_t = w - spin * n_;
        moment = -r_ * cross<S>(n_, f) -
                 S(rolling_ * normal / S(sqrt(w_t.squaredNorm() + angular_slip_))) * w_t -
                 S(torsion_ * normal * spin / S(sqrt(spin * spin + angular_slip_))) * n_;
      }
      point.addWorld(now, load, f, moment);
    }
  }
  S potential(const Now<S>& now) const override {
    S energy(0);
    for (const Spot<S>& point : points_) {
      const S x = std::max(depthOf(point.pose(now).translation()), S(0));
      energy += k_ * x * x / S(2);
    }
    return energy;
  }

 private:
  S depthOf(const Vector3<S>& centre) const { return offset_ + r_ - n_.dot(centre); }
  /// Velocity of the body at the contact point and its angular velocity, in the world's axes.
  void velocity(const Now<S>& now, const Spot<S>& point, Vector3<S>& u, Vector3<S>& w) const {
    const Motion<S> V = now.V.inWorld(point.joint);
    u = V.linear() + cross<S>(V.angular(), point.arm(now));
    if (!turns_) return;
    w = V.angular();
    u -= r_ * cross<S>(w, n_);
  }
  std::vector<Spot<S>> points_;
  Vector3<S> n_;
  S offset_, r_, k_, c_, mu_, slip_, rolling_, torsion_, angular_slip_;
  bool turns_;
};

}  // namespace liecheck::scene
