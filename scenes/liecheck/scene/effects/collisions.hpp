#pragma once
// Compliant contact between bodies, by the law of contact_law.hpp. The collision shapes are spheres and
// capsules, which are spheres about the points of a segment, and boxes against spheres.
//
//   x = r_A + r_B - |a - b|,  n = (a - b)/|a - b|,  contact point a - (r_A - x/2) n
//
// a and b: the closest points of both segments (Ericson 2005, 5.1.9), or of a sphere's centre and a box with
// r_B = 0, whose surface is meant where the centre is inside. Of parallel capsules one pair of closest points
// is taken, so that the contact point can jump between them. Shapes of one body, or of two bodies that a
// joint connects, do not collide; a free-flyer connects nothing.
//
// Up to 64 pairs are all computed in a fixed order, and each is a switching function, so that steps end where
// a contact begins or ends. More pairs are found by a sweep over the shapes' intervals along x (sweep and
// prune; Cohen et al. 1995), and no step ends at their contacts, whose number and order change with the
// motion.

#include <liecheck/scene/effects/contact_law.hpp>

namespace liecheck::scene {

inline const PartInfo collisions_info{
    "collisions",
    "f_n = k x^e (1 + c x_dot)_+,  f_t = -mu f_n u_t / sqrt(|u_t|^2 + v_s^2),  x = overlap of two bodies",
    "conserves with c = mu = rho = tau = 0: V = k x^(e+1)/(e+1); otherwise dissipates",
    "velocities; a comparison for each pair that is close, a few square roots for each pair in contact",
    contactKeys(
        {{"bodies", Kind::Bodies, "", "all",
          "the bodies whose collision shapes touch each other: spheres, capsules, boxes against spheres"}})};

/// One system uses it at a time, since it keeps the buffers of the sweep.
template <Scalar S>
class Collisions final : public Effect<S> {
 public:
  Collisions(const Parameters& p, const Model<S>& model, const Surroundings& around) : law_(p) {
    for (const PlacedShape<S>& placed : placedShapes(model, around, p.names("bodies"))) add(placed);
    connected_.assign(model.joints.size(), 0);
    for (std::size_t i = 1; i < model.joints.size(); ++i)
      connected_[i] = model.nvs[i] == 6 ? i : std::size_t(model.parents[i]);
    std::size_t count = 0;
    for (std::size_t i = 0; i < solids_.size(); ++i)
      for (std::size_t j = i + 1; j < solids_.size(); ++j) {
        const Solid &a = solids_[i], &b = solids_[j];
        if (!collide(a, b)) continue;
        if ((a.box && !b.sphere()) || (b.box && !a.sphere()))
          throw std::invalid_argument(
              "collisions of '" + a.body + "' with '" + b.body +
              "' need a sphere, since one of them has a box: name other bodies, or give "
              "one of them spheres in 'shapes'");
        if (++count <= most_contact_events) pairs_.emplace_back(i, j);
      }
    if (count == 0) throw std::invalid_argument("no two of these bodies can collide: name others");
    if (count <= most_contact_events) return;
    pairs_.clear();
    intervals_.resize(solids_.size());
    for (std::size_t i = 0; i < solids_.size(); ++i) intervals_[i].solid = i;
  }
  Acts acts() const override { return Acts::OnBodies; }
  bool conservative() const override { return law_.conservative(); }
  bool passive() const override { return true; }
  Kinematics needs() const override { return Kinematics::Velocities; }
  void add(const Now<S>& now, const Load<S>& load) const override {
    forEachPair(now, [&](const Solid& a, const Solid& b) { press(now, load, a, b); });
  }
  S potential(const Now<S>& now) const override {
    S energy(0);
    forEachPair(now,
                [&](const Solid& a, const Solid& b) { energy += law_.potential(overlap(now, a, b).depth); });
    return energy;
  }
  std::vector<Sliding<S>> sliding(const Now<S>& now) const override {
    std::vector<Sliding<S>> all;
    forEachPair(now, [&](const Solid& a, const Solid& b) {
      const Overlap o = overlap(now, a, b);
      Vector3<S> w;
      if (const auto d = law_.sliding(o.depth, o.n, relative(now, a, b, o.p, w)))
        all.push_back({a.joint, b.joint, o.p, o.n, *d});
    });
    return all;
  }

 private:
  /// A sphere about each point of a segment along z_S, or a box with r = 0.
  struct Solid {
    std::size_t joint;
    SE3<S> X_JS;
    S r, half;         ///< radius, half of the segment's length
    Vector3<S> sides;  ///< half of a box's sides
    bool box;
    S reach;  ///< radius of a sphere about the centre that contains it
    std::string body;
    bool sphere() const { return !box && half == S(0); }
  };
  struct Overlap {
    S depth;
    Vector3<S> n, p;  ///< from B to A; contact point, in the world
  };
  struct Interval {
    S low, high;
    Vector3<S> centre;
    std::size_t solid;
  };

  void add(const PlacedShape<S>& placed) {
    using Type = Shape::Type;
    const Type type = placed.shape->type;
    if (type == Type::Cylinder)
      throw std::invalid_argument("collisions of the cylinder of '" + placed.shape->body +
                                  "' are not supported: name other bodies, or give it a capsule in 'shapes'");
    const bool box = type == Type::Box;
    Solid s{placed.joint, placed.X_JS, S(0), S(0), Vector3<S>::Zero(), box, S(0), placed.shape->body};
    if (box)
      s.sides = Vector3<S>(placed.size(0), placed.size(1), placed.size(2)) / S(2);
    else
      s.r = placed.size(0);
    if (type == Type::Capsule) s.half = placed.size(1) / S(2);
    using std::sqrt;
    s.reach = s.r + s.half + S(sqrt(s.sides.squaredNorm()));
    solids_.push_back(s);
  }
  bool collide(const Solid& a, const Solid& b) const {
    return a.joint != b.joint && connected_[a.joint] != b.joint && connected_[b.joint] != a.joint;
  }

  /// Calls f(a, b) for all pairs that may overlap.
  template <class F>
  void forEachPair(const Now<S>& now, F f) const {
    for (const auto& [i, j] : pairs_) f(solids_[i], solids_[j]);
    if (!pairs_.empty()) return;
    for (Interval& x : intervals_) {
      const Solid& s = solids_[x.solid];
      x.centre = now.X_WJ[s.joint].act(s.X_JS.translation());
      x.low = x.centre[0] - s.reach, x.high = x.centre[0] + s.reach;
    }
    sort();
    using std::abs;
    for (std::size_t k = 0; k < intervals_.size(); ++k) {
      const Interval& x = intervals_[k];
      const Solid& a = solids_[x.solid];
      for (std::size_t l = k + 1; l < intervals_.size() && intervals_[l].low < x.high; ++l) {
        const Interval& y = intervals_[l];
        const Solid& b = solids_[y.solid];
        const S reach = a.reach + b.reach;
        if (S(abs(S(x.centre[1] - y.centre[1]))) < reach && S(abs(S(x.centre[2] - y.centre[2]))) < reach &&
            collide(a, b))
          f(a, b);
      }
    }
  }
  /// By insertion, since the order hardly changes from one evaluation to the next. The result is the same for
  /// any order before, so that a motion does not depend on the evaluations before.
  void sort() const {
    const auto before = [](const Interval& a, const Interval& b) {
      return a.low < b.low || (a.low == b.low && a.solid < b.solid);
    };
    for (std::size_t k = 1; k < intervals_.size(); ++k)
      for (std::size_t l = k; l > 0 && before(intervals_[l], intervals_[l - 1]); --l)
        std::swap(intervals_[l], intervals_[l - 1]);
  }

  /// The velocity of A relative to B at the contact point, and their relative angular velocity w.
  static Vector3<S> relative(const Now<S>& now, const Solid& a, const Solid& b, const Vector3<S>& p,
                             Vector3<S>& w) {
    Vector3<S> w_B;
    const Vector3<S> u = velocityAt(now, a.joint, p, w) - velocityAt(now, b.joint, p, w_B);
    w -= w_B;
    return u;
  }
  /// Adds the force between a pair.
  void press(const Now<S>& now, const Load<S>& load, const Solid& a, const Solid& b) const {
    const Overlap o = overlap(now, a, b);
    const bool deep = o.depth > S(0);
    Vector3<S> u = Vector3<S>::Zero(), w = Vector3<S>::Zero(), f, moment;
    if (deep) u = relative(now, a, b, o.p, w);
    const S g = deep ? law_.acts(o.depth, o.n.dot(u)) : o.depth;
    if (!(pairs_.empty() ? g > S(0) : now.on(g))) return;
    if (!deep) u = relative(now, a, b, o.p, w);
    law_.force(o.depth, o.n, u, w, f, moment);
    if (a.joint != 0) pressAt(now, load, a.joint, o.p, f, moment);
    if (b.joint != 0) pressAt(now, load, b.joint, o.p, Vector3<S>(-f), Vector3<S>(-moment));
  }

  Overlap overlap(const Now<S>& now, const Solid& a, const Solid& b) const {
    if (a.box) {
      Overlap o = overlap(now, b, a);
      o.n = -o.n;
      return o;
    }
    const SE3<S>& X = now.X_WJ[a.joint];
    Vector3<S> p = X.act(a.X_JS.translation()), n;
    S distance;
    if (b.box) {
      const SE3<S> X_WS = now.X_WJ[b.joint] * b.X_JS;
      n = product<S>(X_WS.rotation(), fromBox(b.sides, X_WS.actInv(p), distance));
    } else {
      const SE3<S>& Y = now.X_WJ[b.joint];
      n = p - Y.act(b.X_JS.translation());
      if (a.half > S(0) || b.half > S(0)) {
        const Vector3<S> d = a.half * product<S>(X.rotation(), Vector3<S>(a.X_JS.rotation().col(2))),
                         e = b.half * product<S>(Y.rotation(), Vector3<S>(b.X_JS.rotation().col(2)));
        const auto [s, t] = closest(n, d, e);
        p += s * d, n += s * d - t * e;
      }
      using std::sqrt;
      distance = sqrt(n.squaredNorm());
      n = distance > S(0) ? Vector3<S>(n / distance) : Vector3<S>(S(0), S(0), S(1));
    }
    const S depth = a.r + b.r - distance;
    return {depth, n, p - S(a.r - depth / S(2)) * n};
  }
  /// s and t in [-1, 1] with the least |r + s d - t e|.
  static std::pair<S, S> closest(const Vector3<S>& r, const Vector3<S>& d, const Vector3<S>& e) {
    const S dd = d.squaredNorm(), ee = e.squaredNorm(), de = d.dot(e), rd = r.dot(d), re = r.dot(e);
    const auto part = [](const S& x, const S& of) {
      return of > S(0) ? std::clamp(S(x / of), S(-1), S(1)) : S(0);
    };
    S s = part(S(de * re - ee * rd), S(dd * ee - de * de));
    const S t = part(S(de * s + re), ee);
    s = part(S(de * t - rd), dd);
    return {s, t};
  }
  /// The distance of a point from a box, below 0 inside, and its gradient, in the box's frame.
  static Vector3<S> fromBox(const Vector3<S>& sides, const Vector3<S>& p, S& distance) {
    using std::sqrt, std::abs;
    Vector3<S> out;
    int nearest = 0;
    for (int i = 0; i < 3; ++i) {
      out[i] = p[i] - std::clamp(p[i], S(-sides[i]), sides[i]);
      if (S(abs(p[i])) - sides[i] > S(abs(p[nearest])) - sides[nearest]) nearest = i;
    }
    distance = sqrt(out.squaredNorm());
    if (distance > S(0)) return out / distance;
    distance = S(abs(p[nearest])) - sides[nearest];
    return Vector3<S>(Vector3<S>::Unit(nearest) * S(p[nearest] < S(0) ? -1 : 1));
  }

  ContactLaw<S> law_;
  std::vector<Solid> solids_;
  std::vector<std::size_t> connected_;  ///< the joint to whose body a joint connects its own
  std::vector<std::pair<std::size_t, std::size_t>> pairs_;  ///< empty if there are too many
  mutable std::vector<Interval> intervals_;                 ///< in order of their low ends
};

}  // namespace liecheck::scene
