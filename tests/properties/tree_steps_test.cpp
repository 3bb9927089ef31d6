// The recursions that name a wrong step of an algorithm on trees are right without one, and such steps are recognised.

#include <gtest/gtest.h>
#include <failures/spatial_tree.hpp>
#include <generators/trees.hpp>
#include <invariants/tree_law.hpp>

#include "tree_faults.hpp"

namespace liecheck::properties {
namespace {

using spatial::Step;
using spatial::Vector;
using spatial::Vector3;
using Real = oracles::Real;

void expect_near(const Vector& computed, const std::vector<Real>& exact, double relative, const char* what) {
  const Vector right = eigen(rough_list(exact));
  ASSERT_EQ(computed.size(), right.size()) << what;
  EXPECT_LE((computed - right).norm(), relative * right.norm() + 1e-12) << what;
}

TEST(TreeSteps, WithoutAWrongStepTheRecursionsAreRight) {
  int compared = 0;
  for (std::uint64_t index = 0; index < 100; ++index) {
    Source source(Source::Key{21, 22, 23, index});
    const std::vector<double> x = random_tree<double>(source, false);
    const CaseAt<Real> c(TreeLayout::of_size(x.size()), x);
    const spatial::Tree t(x);
    const oracles::TreeDynamics<Real> exact = c.dynamics(c.exact.v, c.exact.a);
    const Vector tau = spatial::torque(t, t.at, t.gravity, true, Step::right);
    const double size =
        weighted_size(c.sizes(c.stored.v, c.stored.a, true).tau, std::vector<double>(c.nv(), 1)) /
        std::max(tau.norm(), 1e-300);
    if (!(size < 1e4)) continue;  // what cancels in double tells nothing of a step
    ++compared;
    expect_near(tau, exact.torque(c.exact.wrench), 1e-10 * size, "tau");
    const spatial::Matrix M = spatial::mass_matrix(t, Step::right);
    expect_near(Vector(M.reshaped()), exact.mass(), 1e-10, "M");
    const oracles::Vec6<Real> h = exact.momentum();
    Vector3 l = Vector3::Zero();
    for (const spatial::MovingBody& b : spatial::bodies_of(t)) l += b.link.mass * b.x1;
    expect_near(l, {h[0], h[1], h[2]}, 1e-9, "momentum");
    if (t.has_mimics) continue;
    const Vector back = spatial::acceleration(t, t.at, tau, t.gravity, true, Step::right);
    EXPECT_LE((M * (back - t.at.a)).norm(), 1e-7 * size * tau.norm() + 1e-12) << index;
  }
  EXPECT_GT(compared, 60);
}

TEST(TreeSteps, NameTheStep) {
  struct Fault {
    const char *law, *words;
    Plant plant;
  };
  const auto without_v = [](VecX<double> v) {
    for (double& x : v) x = std::fabs(x) < 0.1 ? 0 : x;
    return v;
  };
  const std::vector<Fault> faults{
      {"lagrange", "M without what couples joints",
       [](auto& o, const Tree<double>& tree) {
         change(o, op::tree_crba, [tree](auto& M, const auto&...) {
           const MatX<double> all = M;
           M.setZero();
           for (std::size_t i = 0; i < tree.joints.size(); ++i) {
             const int k = tree.idx_v[i], n = oracles::velocity_size(tree.joints[i].kind);
             M.block(k, k, n, n) = all.block(k, k, n, n);
           }
         });
       }},
      {"forward_dynamics", "M with 1e-4 on its diagonal",
       [](auto& o, const Tree<double>&) {
         o[op::tree_mass_inverse] = [crba = o[op::tree_crba]](const VecX<double>& q) -> MatX<double> {
           const MatX<double> M = crba(q);
           return (M + 1e-4 * MatX<double>::Identity(M.rows(), M.cols())).inverse();
         };
       }},
      {"dynamics_derivatives", "derivatives of inverse dynamics at a = 0",
       [](auto& o, const Tree<double>&) {
         o[op::aba_derivatives] = [d = o[op::rnea_derivatives], inverse = o[op::tree_mass_inverse]](
                                      const VecX<double>& q, const VecX<double>& v, const VecX<double>& tau,
                                      int joint, const Vec<double, 6>& F) {
           auto result = d(q, v, VecX<double>(0 * tau), joint, F);
           const MatX<double> solve = -inverse(q);
           result.first = (solve * result.first).eval(), result.second = (solve * result.second).eval();
           return result;
         };
       }},
      {"tree_momentum", "the angular momentum about the world's origin",
       [](auto& o, const Tree<double>& tree) {
         Tree<double> other = tree;
         Vec<double, 3> centre;
         double mass = 0;
         for (const auto& j : tree.joints) mass += j.body.mass;
         std::array<std::function<double(const VecX<double>&)>, 3> height;
         for (std::size_t k = 0; k < 3; ++k) {
           other.gravity.x = {0, 0, 0}, other.gravity.x[k] = -1 / mass;
           height[k] = own_subject().operations.tree(other)[op::tree_potential_energy];
         }
         change(o, op::tree_momentum, [height](auto& h, const VecX<double>& q, const auto&) {
           const Vec<double, 3> c(height[0](q), height[1](q), height[2](q));
           h.template tail<3>() += c.cross(Vec<double, 3>(h.template head<3>()));
         });
       }},
      {"lagrange", "velocities below 0.1 taken as 0",
       [=](auto& o, const Tree<double>&) {
         o[op::tree_nonlinear_effects] = [right = o[op::tree_nonlinear_effects], without_v](
                                             const VecX<double>& q, const VecX<double>& v) {
           return right(q, without_v(v));
         };
       }},
      {"frame_motion", "each joint on the joint before it, in place of its parent,",
       [](auto& o, const Tree<double>& tree) {
         Tree<double> other = tree;
         for (std::size_t i = 0; i < other.joints.size(); ++i)
           other.joints[i].parent = static_cast<int>(i) - 1;
         o[op::frame_pose] = own_subject().operations.tree(other)[op::frame_pose];
       }},
      {"frame_motion", "the shift of prismatic joints in the parent's axes",
       [](auto& o, const Tree<double>& tree) {
         o[op::frame_pose] = [tree](const VecX<double>& q) {
           Tree<double> other = tree;
           for (std::size_t i = 0; i < other.joints.size(); ++i) {
             auto& j = other.joints[i];
             if (j.kind != oracles::JointKind::prismatic || j.primary >= 0) continue;
             const Vec<double, 3> shift = q[tree.idx_q[i]] * Vec<double, 3>(j.axis.x.data());
             Eigen::Map<Vec<double, 3>>(j.p.x.data()) += shift - Eigen::Quaterniond(j.Q.x.data()) * shift;
           }
           return own_subject().operations.tree(other)[op::frame_pose](q);
         };
       }},
      {"frame_motion", "atan(sin / cos) of continuous and planar joints, which is wrong by pi where cos < 0,",
       [](auto& o, const Tree<double>& tree) {
         o[op::frame_pose] = [tree, right = o[op::frame_pose]](VecX<double> q) {
           for (std::size_t i = 0; i < tree.joints.size(); ++i) {
             const bool planar = tree.joints[i].kind == oracles::JointKind::planar;
             if ((!planar && tree.joints[i].kind != oracles::JointKind::continuous) ||
                 tree.joints[i].primary >= 0)
               continue;
             auto circle = q.segment<2>(tree.idx_q[i] + (planar ? 2 : 0));
             if (circle[0] < 0) circle = -circle;
           }
           return right(q);
         };
       }},
      {"frame_motion", "the linear velocity of free-flyer joints taken in the axes of the joint's placement",
       [](auto& o, const Tree<double>& tree) {
         o[op::frame_velocity] = [tree, right = o[op::frame_velocity]](const VecX<double>& q, VecX<double> v,
                                                                       Seen seen) {
           for (std::size_t i = 0; i < tree.joints.size(); ++i)
             if (tree.joints[i].kind == oracles::JointKind::free_flyer) {
               auto u = v.segment<3>(tree.idx_v[i]);
               u = Eigen::Quaterniond(q.data() + tree.idx_q[i] + 3).conjugate() * Vec<double, 3>(u);
             }
           return right(q, v, seen);
         };
       }},
      {"lagrange", "no body on the last joint", [](auto& o, const Tree<double>& tree) {
         Tree<double> other = tree;
         other.joints.back().body.mass = 0;
         std::ranges::fill(other.joints.back().body.I_C.x, 0.0);
         o[op::tree_gravity] = own_subject().operations.tree(other)[op::tree_gravity];
       }}};
  for (const Fault& fault : faults) {
    const auto all = findings_of_tree({fault.law}, fault.plant, 400);
    ASSERT_GE(all.size(), 1u) << fault.words;
    EXPECT_TRUE(says(all[0], std::string("the result is what ") + fault.words + " would give")) << all[0];
  }
}

}  // namespace
}  // namespace liecheck::properties
