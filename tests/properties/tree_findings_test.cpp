// Findings of libraries on trees: one cause is one finding, with the simplest operation first, and each says which numbers
// were compared of which call.

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <subjects/call_refused.hpp>
#include <subjects/tree.hpp>

#include "tree_faults.hpp"

namespace liecheck::properties {
namespace {

TEST(TreeFindings, ARefusalIsThatOfTheOperationThatRefused) {
  const auto all = findings_of_tree({"tree_momentum"}, [](auto& o, const auto&) {
    o[op::tree_aba] = [](const auto&...) -> VecX<double> { throw CallRefused("singular", "tree_aba"); };
  });
  ASSERT_EQ(all.size(), 1u);
  EXPECT_TRUE(says(all[0], "1  momentum_conserved (torque): refused")) << all[0];
  EXPECT_TRUE(says(all[0], "            singular\n")) << all[0];
}

TEST(TreeFindings, AWrongJacobianMakesItsRateNotWrong) {
  const auto all = findings_of_tree({"frame_jacobian"}, [](auto& o, const auto&) {
    change(o, op::frame_jacobian, [](auto& J, const auto&...) { J.col(0).setZero(); });
  });
  ASSERT_EQ(all.size(), 1u);
  EXPECT_TRUE(says(all[0], "1  frame_jacobian (")) << all[0];
  EXPECT_TRUE(says(all[0], "            (J v)[")) << all[0];
  EXPECT_TRUE(says(all[0], ", seen in ")) << all[0];
}

/// Doubles the numbers of every second call.
template <class X>
void flicker(X& x) {
  static int calls = 0;
  x *= ++calls % 2 + 1;
}

using Body = oracles::BodyOf<double>;
/// Adds times m (c^2 1 - c c^T) to an inertia.
void add_steiner(Body& body, double times) {
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      double square = 0;
      for (int n = 0; n < 3; ++n) square += i == k ? body.c(n, 0) * body.c(n, 0) : 0;
      body.I_C(i, k) += times * body.mass * (square - body.c(i, 0) * body.c(k, 0));
    }
}
template <class V>
void turn(const oracles::Quaternion<double>& by, V& v) {
  const Eigen::Vector3d u = Eigen::Quaterniond(by.x.data()) * Eigen::Vector3d(v.x.data());
  std::copy_n(u.data(), 3, v.x.begin());
}

TEST(TreeFindings, SayWhichOtherTreeARightLibraryWouldHaveToBeGiven) {
  using Joint = oracles::JointOf<double>;
  struct Fault {
    const char* words;
    void (*change)(Joint&);
  };
  constexpr double with_sign = -1;
  const Fault faults[] = {
      {"products of inertia of the opposite sign",
       [](Joint& j) {
         for (int i = 0; i < 3; ++i)
           for (int k = 0; k < 3; ++k) j.body.I_C(i, k) *= i == k ? 1 : with_sign;
       }},
      {"inertias about the centres of mass, not moved to the joints' origins,",
       [](Joint& j) { add_steiner(j.body, -1); }},
      {"inertias moved to the joints' origins twice", [](Joint& j) { add_steiner(j.body, 1); }},
      {"inertias moved to the joints' origins with the opposite sign",
       [](Joint& j) { add_steiner(j.body, -2); }},
      {"joints' shifts turned by the rotation of the joint's placement", [](Joint& j) { turn(j.Q, j.p); }},
      {"joints' axes turned by the rotation of the joint's placement", [](Joint& j) { turn(j.Q, j.axis); }},
      {"masses rounded to float", [](Joint& j) { j.body.mass = static_cast<float>(j.body.mass); }},
      {"centres of mass rounded to float", [](Joint& j) {
         for (double& x : j.body.c.x) x = static_cast<float>(x);
       }}};
  for (const Fault& fault : faults) {
    const auto all = findings_of_tree({"lagrange"}, [&](auto& o, const Tree<double>& tree) {
      Tree<double> other = tree;
      for (Joint& j : other.joints) fault.change(j);
      o[op::tree_rnea] = own_subject().operations.tree(other)[op::tree_rnea];
    });
    ASSERT_GE(all.size(), 1u) << fault.words;
    EXPECT_TRUE(says(all[0], std::string("the result is what ") + fault.words + " would give")) << all[0];
  }
}

TEST(TreeFindings, WhatBecomesOfASecondBodyOnAJoint) {
  using Bodies = decltype(Tree<double>::fixed);
  struct Fault {
    const char* words;
    void (*change)(Bodies&);
  };
  const Fault faults[] = {
      {"one body alone of those on a joint", [](Bodies& all) { all.clear(); }},
      {"a body that is not turned into the axes of its joint",
       [](Bodies& all) {
         for (auto& part : all) part.Q.x = {0, 0, 0, 1};
       }},
      {"a body that is not moved to its place on the joint",
       [](Bodies& all) {
         for (auto& part : all) part.p.x = {0, 0, 0};
       }},
      {"a body whose I_C is turned by R^T in place of R into the axes of its joint", [](Bodies& all) {
         for (auto& part : all) {  // R^T I R in place of R I R^T
           const Eigen::Matrix3d R = Eigen::Quaterniond(part.Q.x.data()).toRotationMatrix();
           Eigen::Matrix3d I;
           for (int i = 0; i < 3; ++i)
             for (int k = 0; k < 3; ++k) I(i, k) = part.body.I_C(i, k);
           I = (R.transpose() * R.transpose() * I * R * R).eval();
           for (int i = 0; i < 3; ++i)
             for (int k = 0; k < 3; ++k) part.body.I_C(i, k) = I(i, k);
         }
       }}};
  for (const Fault& fault : faults) {
    const auto all = findings_of_tree({"tree_invariance"}, [&](auto& o, const Tree<double>& tree) {
      Tree<double> other = tree;
      fault.change(other.fixed);
      o[op::tree_rnea] = own_subject().operations.tree(other)[op::tree_rnea];
    });
    ASSERT_GE(all.size(), 1u) << fault.words;
    EXPECT_TRUE(says(all[0], std::string("the result is what ") + fault.words + " would give")) << all[0];
  }
}

TEST(TreeFindings, AMatrixWithoutItsLowerTriangle) {
  const auto all = findings_of_tree({"lagrange"}, [](auto& o, const auto&) {
    change(o, op::tree_crba, [](auto& M, const auto&...) {
      M = M.template triangularView<Eigen::Upper>().toDenseMatrix().eval();
    });
  });
  ASSERT_GE(all.size(), 1u);
  EXPECT_TRUE(says(all[0], "right but for numbers that are 0 below the diagonal")) << all[0];
}

TEST(TreeFindings, AStepInFloat) {
  const auto all = findings_of_tree({"lagrange"}, [](auto& o, const auto&) {
    change(o, op::tree_gravity, [](auto& tau, const auto&...) {
      for (Eigen::Index i = 0; i < tau.size(); ++i)  // each by another share of a rounding
        tau[i] *= 1 + 3e-8 * std::sin(static_cast<double>(i) + 1e3 * tau[i]);
    });
  });
  ASSERT_GE(all.size(), 1u);
  EXPECT_TRUE(says(all[0], "a constant or a step of the calculation has too few digits")) << all[0];
}

TEST(TreeFindings, WhatIsKeptBetweenCallsIsOneFinding) {
  const auto all = findings_of_tree({"lagrange"}, [](auto& o, const auto&) {
    change(o, op::tree_gravity, [](auto& tau, const auto&...) { flicker(tau); });
    change(o, op::tree_crba, [](auto& M, const auto&...) { flicker(M); });
  });
  ASSERT_EQ(all.size(), 1u);
  EXPECT_TRUE(says(all[0], "found in ")) << all[0];
  EXPECT_TRUE(says(all[0], "something is kept from one call to the next")) << all[0];
}

TEST(TreeFindings, AWrenchInTheAxesOfTheWorld) {
  const auto all = findings_of_tree({"lagrange"}, [](auto& o, const Tree<double>& tree) {
    o[op::tree_rnea] = [right = o[op::tree_rnea], tree](const VecX<double>& q, const VecX<double>& v,
                                                        const VecX<double>& a, int joint,
                                                        Vec<double, 6> F) -> VecX<double> {
      if (joint >= 0) {
        Tree<double> of_joint = tree;
        of_joint.frame_joint = joint;
        of_joint.frame_Q.x = {0, 0, 0, 1}, of_joint.frame_p.x = {0, 0, 0};
        const Mat<double, 3> R = own_subject().operations.tree(of_joint)[op::frame_pose](q).R;
        F.head<3>() = (R.transpose() * F.head<3>()).eval(),
        F.tail<3>() = (R.transpose() * F.tail<3>()).eval();
      }
      return right(q, v, a, joint, F);
    };
  });
  ASSERT_GE(all.size(), 1u);
  EXPECT_TRUE(says(all[0], "the result is what the wrench in the world's axes would give")) << all[0];
}

TEST(TreeFindings, AProductHasItsName) {
  const auto rate = findings_of_tree({"frame_jacobian"}, [](auto& o, const auto&) {
    change(o, op::frame_jacobian_rate, [](auto& J, const auto&...) { J *= 2; });
  });
  ASSERT_EQ(rate.size(), 1u);
  EXPECT_TRUE(says(rate[0], "1  frame_jacobian_rate (")) << rate[0];
  EXPECT_TRUE(says(rate[0], "            (J a + dJ v)[")) << rate[0];
  const auto map = findings_of_tree({"tree_momentum"}, [](auto& o, const auto&) {
    change(o, op::tree_momentum_map, [](auto& A, const auto&...) { A.bottomRows(3) *= 2; });
  });
  ASSERT_EQ(map.size(), 1u);
  EXPECT_TRUE(says(map[0], "            (A_g v)[") && !says(map[0], "(A_g v)[0]")) << map[0];
}

TEST(TreeFindings, TheArgumentsAreThoseOfTheCall) {
  const auto all = findings_of_tree({"forward_dynamics"}, [](auto& o, const auto&) {
    change(o, op::tree_aba, [](auto& a, const auto&...) { a *= 1.5; });
  });
  ASSERT_EQ(all.size(), 1u);
  EXPECT_TRUE(says(all[0], "   so       rnea_of_aba fails in the same way\n")) << all[0];
  EXPECT_TRUE(says(all[0], "            tau = (")) << all[0];
  for (const char* none : {"\n            a = (", "increment", "frame on", "-0"})
    EXPECT_FALSE(says(all[0], none)) << none << all[0];
}

TEST(TreeFindings, LawsOfTheMassMatrixSayWhatTheyCompare) {
  const auto all = findings_of_tree({"mass_matrix"}, [](auto& o, const auto&) {
    o[op::tree_rnea] = nullptr;
    change(o, op::tree_crba, [](auto& M, const auto&...) {
      if (M.rows() > 1) M(0, 1) = M(0, 1) + M(0, 0);
    });
  });
  ASSERT_FALSE(all.empty());
  EXPECT_TRUE(says(all[0], "crba_symmetric")) << all[0];
  EXPECT_TRUE(says(all[0], "            M[0,1] is ") && says(all[0], ", and M[1,0] is ")) << all[0];
  const auto columns = findings_of_tree({"mass_matrix"}, [](auto& o, const auto&) {
    change(o, op::tree_crba, [](auto& M, const auto&...) { M *= 2; });
  });
  ASSERT_EQ(columns.size(), 1u);
  EXPECT_TRUE(says(columns[0], ", and tree_rnea gives ")) << columns[0];
  const auto base = findings_of_tree({"tree_momentum"}, [](auto& o, const auto&) {
    change(o, op::tree_aba, [](auto& a, const auto&...) { a[0] += 1; });
  });
  ASSERT_EQ(base.size(), 1u);
  EXPECT_TRUE(says(base[0], "            tau_base[") && says(base[0], ", and 0 is right")) << base[0];
}

TEST(TreeFindings, WhatFailsOnTheSameTreesIsOneFinding) {
  // Gravity is ignored on trees with a free-flyer, by all that needs it.
  const auto all = findings_of_tree({"lagrange", "tree_invariance", "power_balance"},
                                    [](auto& o, const Tree<double>& tree) {
                                      Tree<double> other = tree;
                                      for (const auto& j : tree.joints)
                                        if (j.kind == oracles::JointKind::free_flyer)
                                          other.gravity = {{0, 0, 1}};
                                      const auto wrong = own_subject().operations.tree(other);
                                      o[op::tree_potential_energy] = wrong[op::tree_potential_energy];
                                      o[op::tree_gravity] = wrong[op::tree_gravity];
                                      o[op::tree_nonlinear_effects] = wrong[op::tree_nonlinear_effects];
                                      o[op::tree_rnea] = wrong[op::tree_rnea];
                                    });
  ASSERT_EQ(all.size(), 1u);
  EXPECT_TRUE(says(all[0], "1  tree_potential_energy (energy): ")) << all[0];
  for (const char* name : {"tree_gravity", "tree_rnea", "tree_nonlinear_effects", "tree_power"})
    EXPECT_TRUE(says(all[0].substr(all[0].find("   so ")), name)) << name << all[0];
}

TEST(TreeFindings, WhatFailsOnOtherTreesIsAnotherFinding) {
  const auto all = findings_of_tree({"lagrange"}, [](auto& o, const Tree<double>& tree) {
    const bool first = tree.joints.size() > 2, second = tree.joints[0].body.mass > 1;
    change(o, op::tree_gravity, [first](auto& tau, const auto&...) { tau *= first ? 1.5 : 1; });
    change(o, op::tree_kinetic_energy, [second](auto& T, const auto&...) { T *= second ? 1.5 : 1; });
  });
  EXPECT_EQ(all.size(), 2u);
}

}  // namespace
}  // namespace liecheck::properties
