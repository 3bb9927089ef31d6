// Findings of libraries on trees: one cause is one finding, with the simplest operation first, and each says which numbers
// were compared of which call.

#include <gtest/gtest.h>
#include <functional>
#include <subjects/call_refused.hpp>
#include <subjects/tree.hpp>

#include "../own_subject.hpp"
#include "finding_texts.hpp"

namespace liecheck::properties {
namespace {

using Plant = std::function<void(TreeOperations<double>&, const Tree<double>&)>;

/// The findings of liecheck's functions on trees that `plant` changes, in one law or more.
std::vector<std::string> findings_of_tree(const std::vector<std::string>& laws, const Plant& plant,
                                          std::uint64_t cases = 150) {
  static int number = 0;
  TypedSubject<double> s;
  s.name = "tree_fault_" + std::to_string(++number);
  s.operations.tree = [plant](const Tree<double>& tree) {
    TreeOperations<double> o = own_subject().operations.tree(tree);
    plant(o, tree);
    return o;
  };
  const Registered<double> registered(s);
  return finding_texts(s.name, laws, cases);
}
/// Changes one function of a tree.
template <class O, class F>
void change(TreeOperations<double>& o, const O& operation, const F& f) {
  o[operation] = [right = o[operation], f](const auto&... arguments) {
    auto result = right(arguments...);
    f(result, arguments...);
    return result;
  };
}

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
