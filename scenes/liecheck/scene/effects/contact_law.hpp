#pragma once
// The force between two bodies that touch, as a function of depth and relative velocity: Hunt and Crossley
// (1975) with regularised friction. The force acts on body A at the contact point; its reaction acts on B
// there.
//
//   x = depth, n = unit normal from B to A, u = velocity of A relative to B at the contact point, x_dot = -n . u
//   f = f_n n - mu f_n u_t / sqrt(|u_t|^2 + v_s^2),     f_n = k x^e (1 + c x_dot)_+,     u_t = u - (n . u) n
//   moment = -rho f_n w_t / sqrt(|w_t|^2 + w_s^2) - tau f_n w_n n / sqrt(w_n^2 + w_s^2)
//
// with the relative angular velocity w = w_t + w_n n. The force is continuous at first touch and never pulls.
// e = 3/2 is the exponent of Hertz (1882) for smooth elastic bodies, with k = 4/3 E* sqrt(R).

#include <algorithm>
#include <liecheck/multibody/nearest_names.hpp>
#include <liecheck/scene/effects/coordinates.hpp>
#include <optional>

namespace liecheck::scene {

/// The keys of effects with this law, after the keys in `own`.
inline std::vector<Key> contactKeys(std::vector<Key> own) {
  const std::vector<Key> keys = {
      {"stiffness", Kind::Positive, "N/m", nullptr, "k; with another exponent than 1 in N/m^e"},
      {"exponent", Kind::Positive, "1", "1", "e, at least 1; 1.5 is that of Hertz for smooth elastic bodies"},
      {"dissipation", Kind::NotNegative, "s/m", "0", "c"},
      {"friction", Kind::NotNegative, "1", "0", "mu"},
      {"slip", Kind::Positive, "m/s", "0.001", "v_s"},
      {"rolling", Kind::NotNegative, "m", "0",
       "rho: the moment rho f_n against the rotation w_t about axes in the tangent plane"},
      {"torsion", Kind::NotNegative, "m", "0",
       "tau: the moment tau f_n against the rotation w_n about the normal"},
      {"angular_slip", Kind::Positive, "rad/s", "0.01", "w_s, below which both moments decrease to 0"}};
  own.insert(own.end(), keys.begin(), keys.end());
  return own;
}

/// The z axis as a unit normal: a level plane needs no products with the others.
template <Scalar S>
struct Upward {
  [[gnu::always_inline]] S dot(const Vector3<S>& x) const { return x[2]; }
  [[gnu::always_inline]] friend Vector3<S> operator*(const S& s, const Upward&) {
    return Vector3<S>(S(0), S(0), s);
  }
  operator Vector3<S>() const { return Vector3<S>(S(0), S(0), S(1)); }
};

/// The velocity of the point p of a joint's body, and the body's angular velocity w, in the world.
template <Scalar S>
[[gnu::always_inline]] inline Vector3<S> velocityAt(const Now<S>& now, std::size_t joint, const Vector3<S>& p,
                                                    Vector3<S>& w) {
  const Motion<S> V = now.V.inWorld(joint);
  w = V.angular();
  return V.linear() + cross<S>(w, Vector3<S>(p - now.X_WJ[joint].translation()));
}
/// Adds a force f at p, and a moment, to a joint's body, both in the world.
template <Scalar S>
[[gnu::always_inline]] inline void pressAt(const Now<S>& now, const Load<S>& load, std::size_t joint,
                                           const Vector3<S>& p, const Vector3<S>& f,
                                           const Vector3<S>& moment) {
  const Vector3<S> arm = p - now.X_WJ[joint].translation();
  load.f[joint] = load.f[joint] + Force<S>(f, Vector3<S>(moment + cross<S>(arm, f)));
}

/// With more points or pairs that may touch, steps do not end where their contacts begin or end: each event
/// takes a few steps of the whole system. Methods then have the order that the exponent of the law leaves
/// them.
constexpr std::size_t most_contact_events = 64;

template <Scalar S>
class ContactLaw {
 public:
  explicit ContactLaw(const Parameters& p)
      : k_(S(p.number("stiffness"))),
        exponent_(S(p.number("exponent", 1))),
        c_(S(p.number("dissipation"))),
        mu_(S(p.number("friction"))),
        slip_(S(p.number("slip")) * S(p.number("slip"))),
        rolling_(S(p.number("rolling"))),
        torsion_(S(p.number("torsion"))),
        angular_slip_(S(p.number("angular_slip")) * S(p.number("angular_slip"))),
        linear_(exponent_ == S(1)),
        turns_(rolling_ > S(0) || torsion_ > S(0)) {
    if (exponent_ < S(1))
      throw std::invalid_argument("the exponent is below 1: the stiffness would be infinite at first touch");
  }
  bool conservative() const { return c_ == S(0) && mu_ == S(0) && !turns_; }
  /// The force acts while this is above 0: while A and B overlap and do not part faster than 1/c.
  S acts(const S& depth, const S& parting) const { return std::min(depth, S(S(1) - c_ * parting)); }
  /// The force f and the moment on body A. The normal is a Vector3 or Upward.
  template <class Normal>
  [[gnu::always_inline]] void force(const S& depth, const Normal& n, const Vector3<S>& u, const Vector3<S>& w,
                                    Vector3<S>& f, Vector3<S>& moment) const {
    using std::sqrt;
    const S parting = n.dot(u), normal = pressed(depth) * (S(1) - c_ * parting);
    const Vector3<S> u_t = u - Vector3<S>(parting * n);
    f = Vector3<S>(normal * n) - S(mu_ * normal / S(sqrt(u_t.squaredNorm() + slip_))) * u_t;
    moment.setZero();
    if (!turns_) return;
    const S spin = n.dot(w);
    const Vector3<S> w_t = w - Vector3<S>(spin * n);
    moment = -S(rolling_ * normal / S(sqrt(w_t.squaredNorm() + angular_slip_))) * w_t -
             Vector3<S>(S(torsion_ * normal * spin / S(sqrt(spin * spin + angular_slip_))) * n);
  }
  S potential(const S& depth) const {
    return depth > S(0) ? S(pressed(depth) * depth / (exponent_ + S(1))) : S(0);
  }
  /// n - mu t if A slides faster than v_s in the direction t while the force acts.
  std::optional<Vector3<S>> sliding(const S& depth, const Vector3<S>& n, const Vector3<S>& u) const {
    using std::sqrt;
    const S parting = n.dot(u);
    const Vector3<S> u_t = u - parting * n;
    const S u2 = u_t.squaredNorm();
    if (mu_ == S(0) || !(u2 > slip_) || !(acts(depth, parting) > S(0))) return {};
    return Vector3<S>(n - S(mu_ / S(sqrt(u2))) * u_t);
  }

 private:
  /// k x^e. Beyond the end of a contact whose branch is held, x < 0: the line goes on, and other powers are
  /// 0.
  S pressed(const S& depth) const {
    using std::pow;
    if (linear_) return k_ * depth;
    return depth > S(0) ? S(k_ * S(pow(depth, exponent_))) : S(0);
  }
  S k_, exponent_, c_, mu_, slip_, rolling_, torsion_, angular_slip_;
  bool linear_, turns_;
};

/// A shape of a body that moves with a joint, at X_JS in the joint's frame.
template <Scalar S>
struct PlacedShape {
  const Shape* shape;
  std::size_t joint;
  SE3<S> X_JS;
  /// A point of the shape's frame, in the joint's frame.
  Vector3<S> at(const S& x, const S& y, const S& z) const { return X_JS.act(Vector3<S>(x, y, z)); }
  S size(std::size_t i) const { return S(shape->size[i]); }
};

/// The shapes of the named bodies, or of all bodies for "all". Throws std::invalid_argument if a body has
/// none, or one that cannot be used. The result points into `around`.
template <Scalar S>
std::vector<PlacedShape<S>> placedShapes(const Model<S>& model, const Surroundings& around,
                                         const std::vector<std::string>& bodies) {
  std::vector<PlacedShape<S>> placed;
  std::vector<std::string> known;
  for (const Shape& shape : around.shapes) known.push_back(shape.body);
  if (known.empty())
    throw std::invalid_argument(
        "the robot has no collision shapes: write 'shapes: [{shape: sphere, on: FRAME, radius: 0.1}]' in the "
        "scene");
  const bool all = bodies.size() == 1 && bodies[0] == "all";
  for (const std::string& body : bodies)
    if (!all && std::find(known.begin(), known.end(), body) == known.end())
      throw std::invalid_argument("no body named '" + body + "' has a collision shape" +
                                  multibody_detail::nearestNames(body, known));
  for (const Shape& shape : around.shapes) {
    if (!all && std::find(bodies.begin(), bodies.end(), shape.body) == bodies.end()) continue;
    if (shape.type == Shape::Type::Unusable)
      throw std::invalid_argument("the collision shape of '" + shape.body + "' " + shape.why +
                                  ": name the bodies without it, or give the body other shapes: 'shapes: "
                                  "[{shape: box, on: " +
                                  shape.body + ", size: [1, 1, 1]}]'");
    const Frame<S>& frame = model.frames[std::size_t(shape.frame)];
    placed.push_back(
        {&shape, std::size_t(frame.parentJoint), frame.placement * shape.X_FS.template cast<S>()});
  }
  return placed;
}

}  // namespace liecheck::scene
