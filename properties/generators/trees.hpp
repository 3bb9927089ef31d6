#pragma once
// Random trees, as lists of numbers, valid by construction: mostly of up to five bodies. Of trees with every joint type
// one in 300 has 6 to 40 bodies, because the time of some laws grows with the third power of their number. Trees for a
// subject that takes some types only have these, and one in twelve has 8 to 20 bodies, half of those up to 12 deep.

#include <generators/rotations.hpp>
#include <generators/tree_layout.hpp>
#include <oracles/tree.hpp>

namespace liecheck::properties {

namespace tree_detail {

inline constexpr int reach = 8;       // lengths, speeds and forces are between 2^-reach and 2^reach
inline constexpr int far_reach = 24;  // those of some states: up to 1e7

/// Sets the numbers of an absent joint.
template <class S>
void clear_slot(S* slot) {
  std::fill_n(slot, +TreeSlot::size, S(0));
  slot[TreeSlot::Q + 3] = slot[TreeSlot::q_Q + 3] = slot[TreeSlot::q_circle] = S(1);
}
/// Makes joint i absent.
template <class S>
void clear_joint(TreeLayout at, std::vector<S>& x, int i) {
  const auto number = [&](int k) -> S& { return x[static_cast<std::size_t>(k)]; };
  number(at.parent(i)) = number(at.kind(i)) = S(absent_joint);
  number(at.primary(i)) = S(-1), number(at.mass(i)) = S(0);
  clear_slot(&number(at.slot(i)));
}
/// Copies all numbers of a joint to another one.
template <class S>
void copy_joint(TreeLayout at, std::vector<S>& x, int from, int to) {
  const auto number = [&](int k) -> S& { return x[static_cast<std::size_t>(k)]; };
  number(at.parent(to)) = number(at.parent(from)), number(at.kind(to)) = number(at.kind(from));
  number(at.primary(to)) = number(at.primary(from)), number(at.mass(to)) = number(at.mass(from));
  std::copy_n(&number(at.slot(from)), +TreeSlot::size, &number(at.slot(to)));
}
/// 6 to 40, in three steps that double the number; fewer trees have many joints.
inline int many_joints(Source& source) {
  const std::uint64_t kind = source.below(10);
  return kind < 7   ? source.between(6, 10)
         : kind < 9 ? source.between(11, 20)
                    : source.between(21, most_joints);
}

/// The parent of joint i in a large tree of some joint types. In shape 0 and 1 the first twelve are a chain; in shape 2
/// each is near the last.
inline int deep_parent(Source& source, int shape, int i) {
  if (shape < 2 && i < 12) return i - 1;
  return source.between(shape == 2 && i > 3 ? i - 3 : -1, i - 1);
}
/// One of the kinds of joints in the set.
inline oracles::JointKind kind_in(Source& source, const oracles::JointSet& set) {
  std::array<oracles::JointKind, oracles::joint_kinds> kinds{};
  std::uint64_t n = 0;
  for (int k = 0; k < oracles::joint_kinds; ++k)
    if (const auto kind = static_cast<oracles::JointKind>(k); set.has(kind)) kinds[n++] = kind;
  return kinds[source.below(n)];
}

/// m sum a_k^2 (1 - e_k e_k^T) for random radii of gyration a_k and axes e_k, as xx xy yy xz yz zz.
/// `degenerate` also allows points, needles and plates, for which the joint may need an armature.
template <class S>
Eigen::Matrix<S, 6, 1> inertia(Source& source, const S& mass, bool degenerate) {
  using V3 = Eigen::Matrix<S, 3, 1>;
  const auto length = [&] { return binade_uniform<S>(source, -4, 1); };
  V3 a;
  for (const int k : {2, 1, 0}) a[k] = length();
  switch (degenerate ? source.below(6) : 3 + source.below(3)) {
    case 0:
      return Eigen::Matrix<S, 6, 1>::Zero();
    case 1:
      a[1] = a[2] = S(0);
      break;
    case 2:
      a[2] = S(0);
      break;
    case 3:
      a[1] = a[2] = a[0];
      break;
    case 4:  // nearly equal moments
      for (int k = 1; k < 3; ++k) {
        const S part = binade_uniform<S>(source, -40, -6);
        a[k] = source.chance(1, 2) ? S(a[0] * (S(1) + part)) : S(a[0] * (S(1) - part));
      }
      break;
    default:;
  }
  const Eigen::Matrix<S, 3, 3> R = source.chance(1, 4)
                                       ? Eigen::Matrix<S, 3, 3>(Eigen::Matrix<S, 3, 3>::Identity())
                                       : rotation_matrix<S>(unit_quaternion<S>(source));
  Eigen::Matrix<S, 6, 1> I = Eigen::Matrix<S, 6, 1>::Zero();
  for (int k = 0; k < 3; ++k) {
    const V3 r = a[k] * R.col(k);
    const S xx = r[0] * r[0], yy = r[1] * r[1], zz = r[2] * r[2];
    I[0] += mass * S(yy + zz), I[2] += mass * S(xx + zz), I[5] += mass * S(xx + yy);
    I[1] -= mass * S(r[0] * r[1]), I[3] -= mass * S(r[0] * r[2]), I[4] -= mass * S(r[1] * r[2]);
  }
  return I;
}
template <class S, class Derived>
void put(S* to, const Eigen::MatrixBase<Derived>& v) {
  for (int i = 0; i < v.size(); ++i) to[i] = v[i];
}

}  // namespace tree_detail

/// The largest exponents of positions, and of v, a and the direction d. Each is far in one of 32 states:
/// balls decide fewer of these cases, and digits take longer.
struct StateReach {
  int q, v, a, d;
  explicit StateReach(Source& source) : q(one(source)), v(one(source)), a(one(source)), d(one(source)) {}

 private:
  static int one(Source& source) {
    return source.chance(1, 32) ? tree_detail::far_reach : tree_detail::reach;
  }
};

/// Sets a joint's numbers of q, v, a and the direction d. Coordinates that its kind does not have stay zero.
template <class S>
void random_joint_state(Source& source, oracles::JointKind kind, bool mimics, const StateReach& reach,
                        S* slot) {
  using oracles::JointKind;
  using tree_detail::put;
  if (mimics) return;
  const bool three =
      kind == JointKind::free_flyer || kind == JointKind::translation || kind == JointKind::planar;
  if (three) {
    put(slot + TreeSlot::q_p, vector3<S>(source, reach.q));
    if (kind == JointKind::planar) slot[TreeSlot::q_p + 2] = S(0);
  } else if (kind != JointKind::continuous && kind != JointKind::spherical) {
    S& q = slot[TreeSlot::q_p];
    q = S(4) * magnitude<S>(source, 2);
    if (reach.q == tree_detail::far_reach && source.chance(1, 2)) q *= binade_uniform<S>(source, 0, reach.q);
  }
  if (kind == JointKind::free_flyer || kind == JointKind::spherical)
    put(slot + TreeSlot::q_Q, unit_quaternion<S>(source));
  if (kind == JointKind::continuous || kind == JointKind::planar) {
    using std::sqrt;
    const S s = source.chance(1, 2) ? source.symmetric<S>()
                                    : binade_uniform<S>(source, -std::numeric_limits<S>::digits, 0);
    S c = S(sqrt((S(1) - s) * (S(1) + s)));
    if (source.chance(1, 2)) c = -c;
    slot[TreeSlot::q_circle] = c, slot[TreeSlot::q_circle + 1] = s;
  }
  const int n = velocity_size(kind);
  for (const auto& [to, exponent] :
       {std::pair(TreeSlot::v, reach.v), std::pair(TreeSlot::a, reach.a), std::pair(TreeSlot::d, reach.d)})
    for (int k = 0; k < n; k += 3) {
      const Eigen::Matrix<S, 3, 1> x = vector3<S>(source, exponent);
      for (int i = k; i < n && i < k + 3; ++i) slot[to + i] = x[i - k];
    }
}

/// Writes a frame: its joint, then its pose relative to this joint.
template <class S>
void random_frame(Source& source, int joints, S* to) {
  to[0] = S(source.between(0, joints - 1));
  tree_detail::put(to + 1, unit_quaternion<S>(source));
  tree_detail::put(to + 5, vector3<S>(source, tree_detail::reach));
}
/// Writes a wrench: its joint (-1 for no wrench), then its force and its moment.
template <class S>
void random_wrench(Source& source, int joints, S* to) {
  to[0] = source.chance(1, 4) ? S(-1) : S(source.between(0, joints - 1));
  tree_detail::put(to + 1, vector3<S>(source, tree_detail::reach));
  tree_detail::put(to + 4, vector3<S>(source, tree_detail::reach));
}

/// A tree and a state. With `floating` the first joint is a free-flyer and the only child of the world. What the subject
/// takes has a kind of joint, and a free-flyer if `floating`.
template <class S>
std::vector<S> random_tree(Source& source, bool floating, const oracles::JointSet& taken = {}) {
  using oracles::JointKind;
  using std::ldexp;
  using tree_detail::put;
  const bool every = taken.everything(), large = source.chance(1, every ? 300 : 12);
  const int joints = large && every        ? tree_detail::many_joints(source)
                     : large               ? source.between(8, 20)
                     : source.chance(1, 8) ? tree_slots
                                           : source.between(1, tree_slots);
  const TreeLayout at = TreeLayout::of_joints(joints);
  const StateReach far(source);
  std::vector<S> x(at.size(), S(0));
  const auto number = [&](int i) -> S& { return x[static_cast<std::size_t>(i)]; };
  const int shape = source.between(0, 3);  // a chain, a star, all joints on the world, random parents
  int ratio = 0;
  if (source.chance(1, 2)) ratio = std::is_same_v<S, float> ? 4 : 21;
  put(&number(at.gravity()), source.chance(1, 8) ? vector3<S>(source, tree_detail::reach)
                                                 : Eigen::Matrix<S, 3, 1>(S(0), S(0), S(-981) / S(100)));
  for (int i = 0; i < at.slots; ++i) {
    tree_detail::clear_joint(at, x, i);
    if (i >= joints) continue;
    S* slot = &number(at.slot(i));
    int parent = large && !every ? tree_detail::deep_parent(source, shape, i)
                 : shape == 0    ? i - 1
                 : shape == 1    ? (i > 0 ? 0 : -1)
                 : shape == 2    ? -1
                                 : source.between(-1, i - 1);
    if (floating && i > 0) parent = std::max(parent, 0);
    number(at.parent(i)) = S(parent);
    // Most joints of a large tree have one coordinate, as those of robots.
    auto kind = every ? static_cast<JointKind>(source.below(large && source.chance(3, 4) ? 3 : 8))
                      : tree_detail::kind_in(source, taken);
    if (i == 0 && (floating || source.chance(1, 4)) && taken.has(JointKind::free_flyer))
      kind = JointKind::free_flyer;
    int primary = -1;
    const bool simple =
        kind == JointKind::revolute || kind == JointKind::prismatic || kind == JointKind::helical;
    if (simple && taken.mimics() && source.chance(1, 3))
      for (int k = 0; k < i; ++k) {
        const auto other = static_cast<JointKind>(static_cast<int>(number(at.kind(k))));
        if (number(at.primary(k)) < S(0) && velocity_size(other) == 1) primary = k;
      }
    number(at.kind(i)) = S(static_cast<int>(kind));
    number(at.primary(i)) = S(primary);
    put(slot + TreeSlot::Q, unit_quaternion<S>(source));
    put(slot + TreeSlot::p, vector3<S>(source, tree_detail::reach));
    put(slot + TreeSlot::axis, direction<S>(source));
    if (kind == JointKind::helical) slot[TreeSlot::pitch] = magnitude<S>(source, 4);
    if (primary >= 0) {
      slot[TreeSlot::multiplier] = S(source.between(1, 8)) / S(4);
      if (source.chance(1, 2)) slot[TreeSlot::multiplier] *= S(-1);
      slot[TreeSlot::offset] = magnitude<S>(source, 2);
    }
    S scale = ratio ? binade_uniform<S>(source, -ratio, ratio) : S(1);
    if (ratio && source.chance(1, 4)) scale = S(ldexp(S(1), source.chance(1, 2) ? ratio : -ratio));
    const S mass = (S(1) + source.unit<S>()) * scale;
    number(at.mass(i)) = mass;
    if (source.chance(1, 2) && primary < 0 && taken.armatures())
      slot[TreeSlot::armature] = mass * binade_uniform<S>(source, -8, 2);
    put(slot + TreeSlot::c, vector3<S>(source, 2));
    put(slot + TreeSlot::I, tree_detail::inertia<S>(source, mass, slot[TreeSlot::armature] > S(0)));
    random_joint_state(source, kind, primary >= 0, far, slot);
  }
  random_frame(source, joints, &number(at.frame()));
  random_wrench(source, joints, &number(at.wrench()));
  return x;
}

}  // namespace liecheck::properties
