#pragma once
// The motion of a frame of a tree, expressed in each of the three reference frames.

#include <invariants/tree_law.hpp>
#include <optional>

namespace liecheck::properties {

inline constexpr Seen every_view[] = {Seen::world, Seen::local, Seen::aligned};

/// Calls f(view) for each reference. A call in one that the subject does not have is outside its domain and ends f alone;
/// throws if it has none.
template <class F>
void for_each_view(const F& f) {
  std::optional<CallFailed> outside;
  bool any = false;
  for (const Seen view : every_view) try {
      f(view);
      any = true;
    } catch (const CallFailed& e) {
      if (e.outcome != Outcome::outside_domain) throw;
      outside = e;
    }
  if (!any && outside) throw CallFailed(*outside);
}

template <class T>
struct FrameViews {
  oracles::Vec6<T> velocity, acceleration, classical;
};

/// Velocity, spatial and classical acceleration from p', p'', w and w' of a frame at (R, p):
///   aligned: (p', w), (p'' - w x p', w'), (p'', w');   local: R^T times these;
///   world: (u, w), (s, w'), (s + w x u, w') with u = p' + p x w and s = p'' + p' x w + p x w'.
template <class T>
FrameViews<T> seen_from(Seen view, const oracles::FrameMotion<T>& f) {
  using namespace oracles;
  const Vec3<T> spatial = f.p2 - cross(f.w, f.p1);
  if (view == Seen::aligned) return {stack(f.p1, f.w), stack(spatial, f.w1), stack(f.p2, f.w1)};
  if (view == Seen::local) {
    const Mat3<T> Rt = transpose(f.R);
    const auto turned = [&](const Vec3<T>& a, const Vec3<T>& b) { return stack(Rt * a, Rt * b); };
    return {turned(f.p1, f.w), turned(spatial, f.w1), turned(f.p2, f.w1)};
  }
  const Vec3<T> u = f.p1 + cross(f.p, f.w), a = spatial + cross(f.p, f.w1);
  return {stack(u, f.w), stack(a, f.w1), stack(a + cross(f.w, u), f.w1)};
}
/// The sizes of the terms of these vectors. They are the same in each reference frame, with one exception:
/// `world` has more terms, for the lever arm from the world's origin. Ordinary code may compute the other two from
/// `world`, and then has those terms there, too.
struct FrameSizes {
  bool from_world;
  double position, w, u, al, ac;
  template <class Case>
  FrameSizes(const Case& c, bool ordinary) : from_world(ordinary) {
    oracles::TreeOf<double> tree = c.stored.tree;
    tree.gravity = {{0, 0, 0}};
    const auto j = oracles::TreeSizes<double>(tree, c.stored.q, c.stored.v, c.stored.a)
                       .joints[static_cast<std::size_t>(c.stored.frame_joint)];
    const double r = approximate(norm(c.exact.frame_p));
    position = j.position + r, w = j.w, u = j.u + w * r, al = j.al, ac = j.ac + al * r;
  }
  double velocity(Seen view) const { return u + (has_lever(view) ? position * w : 0); }
  double acceleration(Seen view) const {
    return ac + w * u + (has_lever(view) ? (u + position * w) * w + position * al : 0);
  }

 private:
  bool has_lever(Seen view) const { return from_world || view == Seen::world; }
};

/// The exact motion of a case's frame, and the sizes of its terms.
template <class T>
struct ExactFrame {
  oracles::FrameMotion<T> motion;
  bool resolved;
  FrameSizes sizes;

  template <class Case>
  ExactFrame(const Case& c, bool ordinary)
      : motion(c.dynamics(c.exact.v, c.exact.a).motion(), static_cast<std::size_t>(c.exact.frame_joint),
               c.exact.frame_Q, c.exact.frame_p),
        resolved(c.resolved()),
        sizes(c, ordinary) {}
};

}  // namespace liecheck::properties
