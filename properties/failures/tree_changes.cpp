#include <failures/tree_changes.hpp>
#include <failures/tree_numbers.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <oracles/scalar.hpp>
#include <oracles/tree.hpp>

namespace liecheck::properties {

namespace {

using oracles::JointKind;
using Span = TreeNumbers::Span;

void to_zero(Span x) {
  std::ranges::fill(x, 0.0);
}
void opposite(Span x) {
  for (double& v : x) v = -v;
}
void conjugate(Span Q) {
  opposite(Q.first(3));
}
void to_identity(Span Q) {
  to_zero(Q), Q[3] = 1;
}
void to_absolute_w(Span Q) {
  Q[3] = std::fabs(Q[3]);
}
void to_float(Span x) {
  for (double& v : x) v = oracles::rounded_to_float(v);
}
/// v, turned by the quaternion Q or back.
void turn(Span v, const Eigen::Quaterniond& Q, bool back) {
  Eigen::Map<Eigen::Vector3d> u(v.data());
  u = back ? Eigen::Vector3d(Q.conjugate() * u) : Eigen::Vector3d(Q * u);
}
void to_nearly_zero(Span armature) {
  armature[0] *= 0x1p-30;  // a joint needs an inertia
}
void from_w(Span Q) {
  std::ranges::rotate(Q, Q.begin() + 1);
}

class Changes {
 public:
  using OfTree = std::function<void(const TreeNumbers&)>;
  std::vector<TreeChange> all;

  TreeChange& of_tree(std::string text, OfTree apply, std::string of_columns) {
    all.push_back({std::move(text), std::move(of_columns), false,
                   [apply = std::move(apply)](std::vector<double>& x) { apply(TreeNumbers(x)); }});
    return all.back();
  }
  /// One that changes the columns of a Jacobian as it changes all else.
  TreeChange& of_tree(const std::string& text, OfTree apply) { return of_tree(text, std::move(apply), text); }
  /// Of the numbers of some joints.
  template <class Which>
  void of_joints(const std::string& text, const std::string& of_columns, int from, int size,
                 void (*change)(Span), Which which) {
    of_tree(
        text,
        [=](const TreeNumbers& tree) {
          for (int i = 0; i < tree.joints(); ++i)
            if (which(tree, i)) change(tree.of_joint(i, from, size));
        },
        of_columns);
  }
  void of_joints(const std::string& text, int from, int size, void (*change)(Span)) {
    of_joints(text, text, from, size, change, [](const TreeNumbers&, int) { return true; });
  }
};

void add_gravity_and_wrench(Changes& c) {
  c.of_tree("gravity 0", [](const TreeNumbers& t) { to_zero(t.gravity()); });
  c.of_tree("gravity (0, 0, -9.81) in place of the model's",
            [](const TreeNumbers& t) { to_zero(t.gravity()), t.gravity()[2] = -9.81; });
  c.of_tree("gravity without its x and y", [](const TreeNumbers& t) { to_zero(t.gravity().first(2)); });
  c.of_tree("gravity in the opposite direction", [](const TreeNumbers& t) { opposite(t.gravity()); });
  c.of_tree("no wrench", [](const TreeNumbers& t) { to_zero(t.force()), to_zero(t.moment()); });
  c.of_tree("no force in the wrench", [](const TreeNumbers& t) { to_zero(t.force()); });
  c.of_tree("no moment in the wrench", [](const TreeNumbers& t) { to_zero(t.moment()); });
  c.of_tree("the opposite wrench", [](const TreeNumbers& t) { opposite(t.force()), opposite(t.moment()); });
  c.of_tree("the wrench with force and moment exchanged",
            [](const TreeNumbers& t) { std::ranges::swap_ranges(t.force(), t.moment()); });
  for (const bool back : {true, false})
    c.of_tree(back ? "the wrench in the world's axes" : "the wrench turned by the rotation of its body",
              [back](const TreeNumbers& t) {
                const auto joint = static_cast<int>(t.wrench_joint());
                if (joint < 0) return;
                turn(t.force(), t.in_world(joint), back), turn(t.moment(), t.in_world(joint), back);
              });
  const auto on = [](const TreeNumbers& t) { return static_cast<int>(t.wrench_joint()); };
  c.of_tree("the wrench on the joint before its own",
            [on](const TreeNumbers& t) { t.hang_wrench(on(t) - 1); });
  c.of_tree("the wrench on the joint after its own",
            [on](const TreeNumbers& t) { t.hang_wrench(on(t) + 1); });
  c.of_tree("the wrench on the first joint", [](const TreeNumbers& t) { t.hang_wrench(0); });
  c.of_tree("the wrench on the last joint", [](const TreeNumbers& t) { t.hang_wrench(t.joints() - 1); });
}

void add_rates(Changes& c) {
  using enum JointKind;
  const auto any = [](const TreeNumbers&, int) { return true; };
  const auto root = [](const TreeNumbers& t, int i) { return t.parent(i) < 0; };
  c.of_joints("v = 0", "", TreeSlot::v, 6, to_zero, any);
  c.of_joints("-v", "", TreeSlot::v, 6, opposite, any);
  c.of_joints("a = 0", "", TreeSlot::a, 6, to_zero, any);
  c.of_joints("-a", "", TreeSlot::a, 6, opposite, any);
  for (int k = 1; k <= 8; ++k)
    c.of_tree(
        fmt::format("velocities below {} taken as 0", std::pow(10.0, -k)),
        [least = std::pow(10.0, -k)](const TreeNumbers& t) {
          for (int i = 0; i < t.joints(); ++i)
            for (double& v : t.of_joint(i, TreeSlot::v, 6)) v = std::fabs(v) < least ? 0 : v;
        },
        "");
  c.of_joints("v = 0 of the joints without a parent", "columns 0 of the joints without a parent", TreeSlot::v,
              6, to_zero, root);
  c.of_joints("a = 0 of the joints without a parent", "", TreeSlot::a, 6, to_zero, root);
  for (int k = 0; k < oracles::joint_kinds; ++k) {
    const auto kind = static_cast<JointKind>(k);
    const auto has = [kind](const TreeNumbers& t, int i) { return t.kind(i) == kind; };
    const std::string joints = fmt::format("of {} joints", oracles::joint_names[static_cast<std::size_t>(k)]);
    c.of_joints("v = 0 " + joints, "columns 0 " + joints, TreeSlot::v, 6, to_zero, has);
    c.of_joints("-v " + joints, "columns of the opposite sign " + joints, TreeSlot::v, 6, opposite, has);
    c.of_joints("a = 0 " + joints, "", TreeSlot::a, 6, to_zero, has);
    if (kind == free_flyer)
      c.of_joints(
          "linear and angular velocity exchanged " + joints,
          "columns of linear and angular velocity exchanged " + joints, TreeSlot::v, 6,
          [](Span v) { std::ranges::swap_ranges(v.first(3), v.last(3)); }, has);
  }
  struct Half {
    const char* name;
    int from, to;
  };
  for (const Half& half :
       {Half{"v", 0, 6}, Half{"the linear velocity", 0, 3}, Half{"the angular velocity", 3, 6}})
    for (const char* how : {"taken in the axes of the joint's placement", "taken in the parent's axes",
                            "turned by the joint's rotation"})
      c.of_tree(fmt::format("{} of free-flyer joints {}", half.name, how),
                [how = std::string_view(how), half](const TreeNumbers& t) {
                  for (int i = 0; i < t.joints(); ++i) {
                    if (t.kind(i) != free_flyer) continue;
                    Eigen::Quaterniond Q(t.of_joint(i, TreeSlot::q_Q, 4).data());
                    if (how.ends_with("parent's axes"))
                      Q = Eigen::Quaterniond(t.of_joint(i, TreeSlot::Q, 4).data()) * Q;
                    for (int from = half.from; from < half.to; from += 3)
                      for (const int at : {TreeSlot::v + from, TreeSlot::a + from})
                        turn(t.of_joint(i, at, 3), Q, how.starts_with("taken"));
                  }
                });
  for (const bool back : {true, false})
    c.of_tree(fmt::format("the linear velocity of planar joints {}",
                          back ? "taken in the parent's axes" : "turned by the joint's rotation"),
              [back](const TreeNumbers& t) {
                for (int i = 0; i < t.joints(); ++i) {
                  if (t.kind(i) != planar) continue;
                  for (const int from : {TreeSlot::v + 0, TreeSlot::a + 0}) t.turn_in_plane(i, from, back);
                }
              });
}

void add_mimics(Changes& c) {
  c.of_joints("multipliers of mimics that are 1", TreeSlot::multiplier, 1, [](Span x) { x[0] = 1; });
  for (const bool by_cos : {false, true})
    c.of_tree(
        fmt::format("{} of continuous joints for their mimics", by_cos ? "acos(cos)" : "atan(sin / cos)"),
        [by_cos](const TreeNumbers& t) {
          for (int i = 0; i < t.joints(); ++i) {
            const int primary = t.primary(i);
            if (primary < 0 || t.kind(primary) != JointKind::continuous) continue;
            const Span q = t.of_joint(primary, TreeSlot::q_circle, 2);
            const double angle = std::atan2(q[1], q[0]),
                         other = by_cos ? std::fabs(angle) : std::atan(q[1] / q[0]);
            t.of_joint(i, TreeSlot::offset, 1)[0] +=
                t.of_joint(i, TreeSlot::multiplier, 1)[0] * (other - angle);
          }
        });
  c.of_tree("multiplier (q + offset) of mimics", [](const TreeNumbers& t) {
    for (int i = 0; i < t.joints(); ++i)
      if (t.primary(i) >= 0)
        t.of_joint(i, TreeSlot::offset, 1)[0] *= t.of_joint(i, TreeSlot::multiplier, 1)[0];
  });
  c.of_joints("offsets of mimics that are 0", TreeSlot::offset, 1, to_zero);
}

void add_joints(Changes& c) {
  using enum JointKind;
  const auto several = [](const TreeNumbers& t, int i) { return oracles::velocity_size(t.kind(i)) > 1; };
  c.of_joints("an armature of 0", TreeSlot::armature, 1, to_nearly_zero);
  c.of_joints("an armature of 0 of joints with several velocities", "", TreeSlot::armature, 1, to_nearly_zero,
              several);
  c.of_joints("twice the armature", TreeSlot::armature, 1, [](Span x) { x[0] *= 2; });
  c.of_joints("joints whose placements are not turned", TreeSlot::Q, 4, to_identity);
  c.of_joints("joints whose placements are turned in the opposite direction", TreeSlot::Q, 4, conjugate);
  c.of_joints("joints whose placements are not shifted", TreeSlot::p, 3, to_zero);
  for (const bool back : {false, true}) {
    const auto turned = [&c, back](const char* what, int from) {
      c.of_tree(
          fmt::format("{} turned {}by the rotation of the joint's placement", what, back ? "back " : ""),
          [back, from](const TreeNumbers& t) {
            for (int i = 0; i < t.joints(); ++i)
              turn(t.of_joint(i, from, 3), Eigen::Quaterniond(t.of_joint(i, TreeSlot::Q, 4).data()), back);
          });
    };
    turned("joints' shifts", TreeSlot::p), turned("joints' axes", TreeSlot::axis);
  }
  c.of_tree("the shift of prismatic joints in the parent's axes", [](const TreeNumbers& t) {
    for (int i = 0; i < t.joints(); ++i) {
      if (t.kind(i) != prismatic || t.primary(i) >= 0) continue;
      const Eigen::Vector3d shift =
          t.of_joint(i, TreeSlot::q_p, 1)[0] * Eigen::Vector3d(t.of_joint(i, TreeSlot::axis, 3).data());
      Eigen::Map<Eigen::Vector3d>(t.of_joint(i, TreeSlot::p, 3).data()) +=
          shift - Eigen::Quaterniond(t.of_joint(i, TreeSlot::Q, 4).data()) * shift;
    }
  });
  c.of_tree("each joint on the joint before it, in place of its parent,", [](const TreeNumbers& t) {
    for (int i = 0; i < t.joints(); ++i) t.hang(i, i - 1);
  });
  c.of_tree("each joint on the first one", [](const TreeNumbers& t) {
    for (int i = 1; i < t.joints(); ++i) t.hang(i, 0);
  });
  c.of_joints("axes of joints in the opposite direction", TreeSlot::axis, 3, opposite);
}

void add_configurations(Changes& c) {
  using enum JointKind;
  c.of_joints("the pitch 0 of helical joints", TreeSlot::pitch, 1, to_zero);
  c.of_joints("the pitch 0 of helical joints where it is negative", TreeSlot::pitch, 1,
              [](Span x) { x[0] = std::max(x[0], 0.0); });
  c.of_joints("|pitch| of helical joints", TreeSlot::pitch, 1, [](Span x) { x[0] = std::fabs(x[0]); });
  c.of_joints("the pitch divided by 2 pi of helical joints", TreeSlot::pitch, 1,
              [](Span x) { x[0] /= 2 * std::numbers::pi; });
  c.of_joints("-pitch of helical joints", TreeSlot::pitch, 1, opposite);
  c.of_joints("|w| in place of w in quaternions of q", TreeSlot::q_Q, 4, to_absolute_w);
  for (const JointKind kind : {spherical, free_flyer}) {  // where all w < 0, this is the conjugate
    const std::string text = fmt::format("|w| in place of w in the quaternion in q of {} joints",
                                         oracles::joint_names[static_cast<std::size_t>(kind)]);
    c.of_joints(text, text, TreeSlot::q_Q, 4, to_absolute_w,
                [kind](const TreeNumbers& t, int i) { return t.kind(i) == kind; });
  }
  c.of_joints("quaternions of q conjugated", TreeSlot::q_Q, 4, conjugate);
  c.of_joints("quaternions of q in the order w, x, y, z", TreeSlot::q_Q, 4, from_w);
  for (const JointKind kind : {spherical, free_flyer}) {
    const auto has = [kind](const TreeNumbers& t, int i) { return t.kind(i) == kind; };
    const std::string joints =
                          fmt::format(" of {} joints", oracles::joint_names[static_cast<std::size_t>(kind)]),
                      one = "the quaternion in q" + joints + " in the order w, x, y, z",
                      other = "the quaternion in q" + joints + " conjugated";
    c.of_joints(one, one, TreeSlot::q_Q, 4, from_w, has);
    c.of_joints(other, other, TreeSlot::q_Q, 4, conjugate, has);
  }
  c.of_joints("cos >= 0 of continuous and planar joints", TreeSlot::q_circle, 2,
              [](Span q) { q[0] = std::fabs(q[0]); });
  c.of_joints("atan(sin / cos) of continuous and planar joints, which is wrong by pi where cos < 0,",
              TreeSlot::q_circle, 2, [](Span q) {
                if (q[0] < 0) opposite(q);
              });
  c.of_joints("sin >= 0 of continuous and planar joints", TreeSlot::q_circle, 2,
              [](Span q) { q[1] = std::fabs(q[1]); });
  c.of_joints("continuous and planar joints turned in the opposite direction", TreeSlot::q_circle, 2,
              [](Span q) { q[1] = -q[1]; });
  c.of_tree("x and y of planar joints turned by the joint's angle", [](const TreeNumbers& t) {
    for (int i = 0; i < t.joints(); ++i)
      if (t.kind(i) == planar) t.turn_in_plane(i, TreeSlot::q_p, false);
  });
  c.of_joints("sin and cos of continuous and planar joints exchanged", TreeSlot::q_circle, 2,
              [](Span q) { std::swap(q[0], q[1]); });
  for (int k = 0; k < oracles::joint_kinds; ++k) {
    const auto has = [kind = static_cast<JointKind>(k)](const TreeNumbers& t, int i) {
      return t.kind(i) == kind;
    };
    const std::string joints = fmt::format("of {} joints", oracles::joint_names[static_cast<std::size_t>(k)]);
    c.of_joints("an armature of 0 " + joints, "", TreeSlot::armature, 1, to_nearly_zero, has);
    c.of_joints("axes in the opposite direction " + joints, "", TreeSlot::axis, 3, opposite, has);
    const auto kind = static_cast<JointKind>(k);
    if (kind != revolute && kind != prismatic && kind != helical) continue;
    c.of_joints("q = 0 " + joints, "q = 0 " + joints, TreeSlot::q_p, 1, to_zero, has);
    c.of_joints("-q " + joints, "-q " + joints, TreeSlot::q_p, 1, opposite, has);
  }
}

void add_bodies_and_frame(Changes& c) {
  c.of_joints("centres of mass in the origins of the joints", TreeSlot::c, 3, to_zero);
  c.of_joints("centres of mass on the opposite side of the joints", TreeSlot::c, 3, opposite);
  c.of_joints("inertias I_C = 0", TreeSlot::I, 6, to_zero);
  c.of_joints("inertias I_C without what is beside their diagonals", TreeSlot::I, 6,
              [](Span I) { I[1] = I[3] = I[4] = 0; });
  c.of_joints("inertias I_C in the order xx, xy, xz, yy, yz, zz", TreeSlot::I, 6,
              [](Span I) { std::swap(I[2], I[3]); });
  for (const auto& [text, one, other] :
       {std::tuple("xy and xz", 1u, 3u), std::tuple("xy and yz", 1u, 4u), std::tuple("xz and yz", 3u, 4u)})
    c.of_tree(fmt::format("inertias I_C with {} exchanged", text), [one = one,
                                                                    other = other](const TreeNumbers& t) {
       for (int i = 0; i < t.joints(); ++i) {
         const Span I = t.of_joint(i, TreeSlot::I, 6);
         std::swap(I[one], I[other]);
       }
     }).any_inertia = true;
  c.of_joints("products of inertia of the opposite sign", TreeSlot::I, 6,
              [](Span I) { I[1] = -I[1], I[3] = -I[3], I[4] = -I[4]; });
  for (const auto& [text, times] :
       {std::pair("inertias about the centres of mass, not moved to the joints' origins,", -1.0),
        std::pair("inertias moved to the joints' origins twice", 1.0),
        std::pair("inertias moved to the joints' origins with the opposite sign", -2.0)})
    c.of_tree(text, [times](const TreeNumbers& t) {
       for (int i = 0; i < t.joints(); ++i) {  // adds times m (c^2 1 - c c^T)
         const Eigen::Vector3d com(t.of_joint(i, TreeSlot::c, 3).data());
         const Eigen::Matrix3d more =
             times * t.mass(i) * (com.squaredNorm() * Eigen::Matrix3d::Identity() - com * com.transpose());
         const Span I = t.of_joint(i, TreeSlot::I, 6);
         I[0] += more(0, 0), I[1] += more(0, 1), I[2] += more(1, 1);
         I[3] += more(0, 2), I[4] += more(1, 2), I[5] += more(2, 2);
       }
     }).any_inertia = true;
  for (const bool first : {true, false})
    c.of_tree(fmt::format("no body on the {} joint", first ? "first" : "last"), [first](
                                                                                    const TreeNumbers& t) {
       const int i = first ? 0 : t.joints() - 1;
       t.mass(i) = 0, to_zero(t.of_joint(i, TreeSlot::I, 6));
     }).any_inertia = true;
  struct Rounded {
    const char* what;
    int from, size;
  };
  for (const Rounded& r :
       {Rounded{"inertias I_C", TreeSlot::I, 6}, Rounded{"centres of mass", TreeSlot::c, 3},
        Rounded{"placements of joints", TreeSlot::Q, 7}, Rounded{"axes of joints", TreeSlot::axis, 3},
        Rounded{"q", TreeSlot::q_p, 9}, Rounded{"v", TreeSlot::v, 6}, Rounded{"a", TreeSlot::a, 6}})
    c.of_joints(fmt::format("{} rounded to float", r.what), r.from, r.size, to_float);
  c.of_joints("angles of revolute and helical joints rounded to float",
              "angles of revolute and helical joints rounded to float", TreeSlot::q_p, 1, to_float,
              [](const TreeNumbers& t, int i) {
                return t.kind(i) == JointKind::revolute || t.kind(i) == JointKind::helical;
              });
  c.of_tree("masses rounded to float", [](const TreeNumbers& t) {
    for (int i = 0; i < t.joints(); ++i) t.mass(i) = oracles::rounded_to_float(t.mass(i));
  });
  c.of_tree("gravity rounded to float", [](const TreeNumbers& t) { to_float(t.gravity()); });
  for (const bool back : {false, true})
    c.of_tree(
        back ? "the frame's shift turned back by its rotation" : "the frame's shift turned by its rotation",
        [back](const TreeNumbers& t) { turn(t.frame_p(), Eigen::Quaterniond(t.frame_Q().data()), back); });
  c.of_tree("the frame not turned", [](const TreeNumbers& t) { to_identity(t.frame_Q()); });
  c.of_tree("the frame turned in the opposite direction",
            [](const TreeNumbers& t) { conjugate(t.frame_Q()); });
  c.of_tree("the frame in the origin of its joint", [](const TreeNumbers& t) { to_zero(t.frame_p()); });
  c.of_tree("the frame on the joint before its own",
            [](const TreeNumbers& t) { t.frame_joint() = std::max(0.0, t.frame_joint() - 1); });
}

/// Those after which terms of a right formula are 0.
constexpr std::string_view without_terms[]{"v = 0",
                                           "a = 0",
                                           "gravity 0",
                                           "no wrench",
                                           "an armature of 0",
                                           "joints whose placements are not turned",
                                           "joints whose placements are not shifted",
                                           "the pitch 0 of helical joints",
                                           "multipliers of mimics that are 1",
                                           "offsets of mimics that are 0",
                                           "centres of mass in the origins of the joints",
                                           "inertias I_C without what is beside their diagonals",
                                           "the frame not turned",
                                           "the frame in the origin of its joint"};

}  // namespace

const std::vector<TreeChange>& tree_changes() {
  static const std::vector<TreeChange> all = [] {
    Changes c;
    add_gravity_and_wrench(c), add_rates(c), add_joints(c), add_configurations(c), add_mimics(c),
        add_bodies_and_frame(c);
    for (TreeChange& change : c.all)
      change.leaves_out = std::ranges::find(without_terms, change.text) != std::end(without_terms) ||
                          change.text.starts_with("v = 0 of ");
    return std::move(c.all);
  }();
  return all;
}

}  // namespace liecheck::properties
