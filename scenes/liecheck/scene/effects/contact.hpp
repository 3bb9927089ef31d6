#pragma once
// Compliant contact of bodies with the ground, by the law of contact_law.hpp, B = the ground. The ground is
// the plane with the unit normal n through (0, 0, height), or a surface of triangles (terrain.hpp).
//
// Bodies touch it by points and spheres of the radius r about p:
//
//   x = r - distance of p from the ground, contact point p - r n
//
// A capsule has the spheres at its ends, and a box its corners: on a plane, no other point of them can be
// deeper. A cylinder has two rims of radius R with the centre c and the axis a:
//
//   x = R s - n . (c - (0, 0, height)),  s = sqrt(|d|^2 + b^2),  d = n - (n . a) a,  contact point c - R d/s
//
// This is the depth of the rim's lowest point but for b = 1/1000: each end of the cylinder bulges by up to b
// R, so that the contact point moves smoothly across the end where a cylinder stands upright. The force is
// conservative for any b, since grad x is that of a point fixed to the body at the contact point.
//
// Creep: a body at rest on a slope, which friction must hold by the force T < mu N, does not rest, but creeps
// with |u_t| = v_s s / sqrt(1 - s^2), s = T/(mu N): this solves the law of friction for u_t.

#include <liecheck/scene/effects/contact_law.hpp>
#include <liecheck/scene/effects/terrain.hpp>

namespace liecheck::scene {

inline const PartInfo contact_info{
    "contact",
    "f_n = k x^e (1 + c x_dot)_+,  f_t = -mu f_n u_t / sqrt(|u_t|^2 + v_s^2),  x = depth below the ground",
    "conserves with c = mu = rho = tau = 0: V = k x^(e+1)/(e+1); otherwise dissipates",
    "velocities; a comparison for each point, a square root for each point in contact",
    contactKeys(
        {{"frames", Kind::Frames, "", "",
          "the frames whose origins are the contact points, or the centres of spheres"},
         {"radius", Kind::NotNegative, "m", "0", "r, of the spheres about these frames; 0 for points"},
         {"bodies", Kind::Bodies, "", "",
          "the bodies whose collision shapes touch the ground, or all; instead of or beside frames"}})};

template <Scalar S>
class Contact final : public Effect<S> {
 public:
  Contact(const Parameters& p, const Model<S>& model, const Surroundings& around)
      : law_(p),
        n_(S(around.normal[0]), S(around.normal[1]), S(around.normal[2])),
        offset_(n_[2] * S(around.height)) {
    if (!around.ground)
      throw std::invalid_argument("contact without a ground: write 'ground: {height: 0}' in the scene");
    if (!p.has("frames") && !p.has("bodies"))
      throw std::invalid_argument("contact needs 'bodies: all', or 'frames' whose origins touch the ground");
    if (around.mesh) terrain_.emplace(*around.mesh);
    if (p.has("frames"))
      for (const std::string& frame : p.names("frames")) {
        const Spot<S> spot(model, frame);
        balls_.push_back({spot.joint, spot.X_JF.translation(), S(p.number("radius"))});
      }
    if (p.has("bodies"))
      for (const PlacedShape<S>& shape : placedShapes(model, around, p.names("bodies")))
        if (shape.joint != 0) add(shape);
    if (balls_.empty() && rims_.empty())
      throw std::invalid_argument("contact acts on bodies that do not move: name others");
    if (terrain_ && !rims_.empty())
      throw std::invalid_argument(
          "contact of a cylinder needs a plane as the ground: on heights and meshes take a capsule instead");
    located_ = balls_.size() + rims_.size() <= most_contact_events;
    level_ = !terrain_ && n_[0] == S(0) && n_[1] == S(0) && n_[2] == S(1);
  }
  Acts acts() const override { return Acts::OnBodies; }
  bool conservative() const override { return law_.conservative(); }
  bool passive() const override { return true; }
  Kinematics needs() const override { return Kinematics::Velocities; }
  void add(const Now<S>& now, const Load<S>& load) const override {
    const auto within = now.next(located_ ? balls_.size() + rims_.size() : 0);
    std::size_t k = 0;
    forEachTouch(now, [&](std::size_t joint, const S& distance, const auto& n, const Vector3<S>& p) {
      press(now, load, joint, S(-distance), n, p,
            [&](const S& g) { return located_ ? within(k++, g) : g > S(0); });
    });
  }
  S potential(const Now<S>& now) const override {
    S energy(0);
    forEachTouch(now, [&](std::size_t, const S& distance, const auto&, const Vector3<S>&) {
      energy += law_.potential(S(-distance));
    });
    return energy;
  }
  std::vector<Sliding<S>> sliding(const Now<S>& now) const override {
    std::vector<Sliding<S>> all;
    forEachTouch(now, [&](std::size_t joint, const S& distance, const Vector3<S>& n, const Vector3<S>& p) {
      Vector3<S> w;
      if (const auto d = law_.sliding(S(-distance), n, velocityAt(now, joint, p, w)))
        all.push_back({joint, 0, p, n, *d});
    });
    return all;
  }

 private:
  struct Ball {
    std::size_t joint;
    Vector3<S> p_J;
    S r;
  };
  struct Rim {
    std::size_t joint;
    Vector3<S> c_J, a_J;
    S R;
  };

  void add(const PlacedShape<S>& placed) {
    using Type = Shape::Type;
    const auto size = [&](std::size_t i) { return placed.size(i); };
    const std::size_t joint = placed.joint;
    const Type type = placed.shape->type;
    if (type == Type::Sphere) {
      balls_.push_back({joint, placed.X_JS.translation(), size(0)});
    } else if (type == Type::Box) {
      for (const int x : {-1, 1})
        for (const int y : {-1, 1})
          for (const int z : {-1, 1}) {
            const std::array<int, 3> sign = {x, y, z};
            bool again = false;  // the opposite corner of a side of length 0
            for (std::size_t i = 0; i < 3; ++i) again = again || (sign[i] > 0 && !(size(i) > S(0)));
            if (!again)
              balls_.push_back(
                  {joint,
                   placed.at(S(S(x) * size(0) / S(2)), S(S(y) * size(1) / S(2)), S(S(z) * size(2) / S(2))),
                   S(0)});
          }
    } else {
      for (const int side : {-1, 1}) {
        const Vector3<S> end = placed.at(S(0), S(0), S(S(side) * size(1) / S(2)));
        if (type == Type::Capsule)
          balls_.push_back({joint, end, size(0)});
        else
          rims_.push_back({joint, end, placed.X_JS.rotation().col(2), size(0)});
      }
    }
  }

  /// Calls f(joint, distance of the lowest point, normal of the ground, contact point in the world). The normal is
  /// Upward for balls on a level plane.
  template <class F>
  [[gnu::always_inline]] void forEachTouch(const Now<S>& now, F f) const {
    if (level_) {
      for (const Ball& ball : balls_) {
        Vector3<S> p = now.X_WJ[ball.joint].act(ball.p_J);
        p[2] -= ball.r;
        f(ball.joint, S(p[2] - offset_), Upward<S>(), p);
      }
    } else {
      for (const Ball& ball : balls_) {
        const Vector3<S> p = now.X_WJ[ball.joint].act(ball.p_J);
        const Near<S> at = terrain_ ? terrain_->near(p, ball.r) : Near<S>{S(n_.dot(p) - offset_), n_};
        f(ball.joint, S(at.distance - ball.r), at.n, Vector3<S>(p - ball.r * at.n));
      }
    }
    using std::sqrt;
    for (const Rim& rim : rims_) {
      const SE3<S>& X = now.X_WJ[rim.joint];
      const Vector3<S> c = X.act(rim.c_J), a = product<S>(X.rotation(), rim.a_J), d = n_ - S(n_.dot(a)) * a;
      const S s = sqrt(S(d.squaredNorm() + S(1) / S(1000000)));
      f(rim.joint, S(n_.dot(c) - offset_ - rim.R * s), n_, Vector3<S>(c - S(rim.R / s) * d));
    }
  }
  template <class Normal, class Within>
  [[gnu::always_inline]] void press(const Now<S>& now, const Load<S>& load, std::size_t joint, const S& depth,
                                    const Normal& n, const Vector3<S>& p, Within within) const {
    const bool deep = depth > S(0);
    Vector3<S> u = Vector3<S>::Zero(), w = Vector3<S>::Zero(), f, moment;
    if (deep) u = velocityAt(now, joint, p, w);
    if (!within(deep ? law_.acts(depth, n.dot(u)) : depth)) return;
    if (!deep) u = velocityAt(now, joint, p, w);
    law_.force(depth, n, u, w, f, moment);
    pressAt(now, load, joint, p, f, moment);
  }

  ContactLaw<S> law_;
  std::vector<Ball> balls_;
  std::vector<Rim> rims_;
  std::optional<Terrain<S>> terrain_;
  Vector3<S> n_;
  S offset_;
  bool located_;  ///< whether each contact is a switching function
  bool level_;    ///< the ground is a plane with the normal z
};

}  // namespace liecheck::scene
