#include <invariants/tree_law.hpp>

#include <liecheck/urdf/urdf.hpp>
#include <set>

namespace liecheck::properties {

namespace {

using oracles::JointKind;

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};

std::set<std::string>& tree_laws() {
  static std::set<std::string> all;
  return all;
}

}  // namespace

bool is_tree_law(const std::string& property) {
  return tree_laws().contains(property);
}
void add_tree_law(const std::string& property) {
  tree_laws().insert(property);
}

RobotNumbers robot_numbers(const Robot& robot) {
  const Model<double> m =
      buildModelFromUrdfText(robot.urdf, robot.fixed ? RootJoint::Fixed : RootJoint::FreeFlyer, robot.name);
  RobotNumbers r;
  r.at = {m.njoints - 1};
  r.numbers.assign(r.at.size(), 0);
  const auto put = [&](int to, const auto& v) {
    tree_detail::put(&r.numbers[static_cast<std::size_t>(to)], v);
  };
  const auto one = [&](int to, double x) { r.numbers[static_cast<std::size_t>(to)] = x; };
  put(r.at.gravity(), m.gravity);
  one(r.at.frame() + 4, 1), one(r.at.wrench(), -1);
  for (int i = 0; i < r.at.slots; ++i) {
    const auto j = static_cast<std::size_t>(i) + 1;
    const int slot = r.at.slot(i);
    const Inertia<double>& I = m.inertias[j];
    one(r.at.parents() + i, m.parents[j] - 1), one(r.at.primaries() + i, -1);
    one(r.at.masses() + i, I.mass()), put(slot + TreeSlot::c, I.lever());
    const Mat<double, 3>& I_C = I.inertia();
    put(slot + TreeSlot::I,
        (Vec<double, 6>() << I_C(0, 0), I_C(1, 0), I_C(1, 1), I_C(2, 0), I_C(2, 1), I_C(2, 2)).finished());
    const Eigen::Quaterniond Q(m.jointPlacements[j].rotation());
    put(slot + TreeSlot::Q, Q.normalized().coeffs()),
        put(slot + TreeSlot::p, m.jointPlacements[j].translation());
    put(slot + TreeSlot::axis, Vec<double, 3>(Vec<double, 3>::UnitX()));
    one(slot + TreeSlot::q_Q + 3, 1), one(slot + TreeSlot::q_circle, 1);
    if (m.nvs[j] > 0) one(slot + TreeSlot::armature, m.armature[m.idx_vs[j]]);
    JointKind kind{};
    const auto turning = [&](JointKind k, const liecheck::Axis<double>& axis) {
      kind = k;
      put(slot + TreeSlot::axis, axis.to_vector());
    };
    const Overloaded visitor{[&](const Revolute<double>& x) { turning(JointKind::revolute, x.axis); },
                             [&](const Continuous<double>& x) { turning(JointKind::continuous, x.axis); },
                             [&](const Prismatic<double>& x) { turning(JointKind::prismatic, x.axis); },
                             [&](const Helical<double>& x) {
                               turning(JointKind::helical, x.axis);
                               one(slot + TreeSlot::pitch, x.pitch);
                             },
                             [&](const Spherical<double>&) { kind = JointKind::spherical; },
                             [&](const Planar<double>&) { kind = JointKind::planar; },
                             [&](const Translation<double>&) { kind = JointKind::translation; },
                             [&](const FreeFlyer<double>&) { kind = JointKind::free_flyer; },
                             [](const Universe<double>&) {},
                             [](const Mimic<double>&) {}};
    if (const auto* mimic = std::get_if<Mimic<double>>(&m.joints[j])) {
      std::visit(visitor, mimic->moved);
      one(r.at.primaries() + i, mimic->primary - 1);
      one(slot + TreeSlot::multiplier, mimic->multiplier), one(slot + TreeSlot::offset, mimic->offset);
    } else {
      std::visit(visitor, m.joints[j]);
    }
    one(r.at.kinds() + i, static_cast<int>(kind));
  }
  return r;
}

}  // namespace liecheck::properties
