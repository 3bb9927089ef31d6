// A subject that takes some kinds of joints, or some orders of Euler angles, gets its cases of those.

#include <gtest/gtest.h>
#include <adapters/subjects.hpp>
#include <campaign/coverage_report.hpp>
#include <campaign/digest.hpp>
#include <invariants/property.hpp>
#include <invariants/tree_case.hpp>
#include <set>

#include "../campaigns.hpp"
#include "../own_subject.hpp"

namespace liecheck::properties {
namespace {

using oracles::JointKind;
using oracles::JointSet;

/// liecheck's dynamics of trees, half of tau in trees with an arm of two joints, for these joints only.
Subject halved(const std::string& name, const std::vector<std::string>& joints) {
  TypedSubject<double> s;
  s.name = name;
  s.operations.tree = [](const Tree<double>& tree) {
    auto t = own_subject().operations.tree(tree);
    TreeOperations<double> few;
    const bool arm = std::ranges::any_of(tree.joints, [](const auto& j) { return j.parent >= 0; });
    few[op::tree_rnea] = [rnea = t[op::tree_rnea], arm](const auto&... x) -> VecX<double> {
      return (arm ? 0.5 : 1.0) * rnea(x...);
    };
    return few;
  };
  Subject all = erased(s);
  all.takes.joints = JointSet(joints);
  return all;
}

/// liecheck's forward dynamics of trees of revolute joints alone.
Subject without_free_flyers() {
  TypedSubject<double> s;
  s.name = "kinds:fixed";
  s.operations.tree = [](const Tree<double>& tree) {
    TreeOperations<double> few;
    few[op::tree_aba] = own_subject().operations.tree(tree)[op::tree_aba];
    return few;
  };
  Subject all = erased(s);
  all.takes.joints = JointSet(std::vector<std::string>{"revolute"});
  return all;
}

const bool are_registered = [] {
  register_subject(without_free_flyers());
  register_subject(halved("kinds:revolute", {"revolute"}));
  register_subject(halved("kinds:every", {}));
  Subject euler{"kinds:euler", "1", "", &oracles::scalar_of<double>};
  euler.operations[op::euler_to_matrix] = erased(own_subject()).operations[op::euler_to_matrix];
  euler.takes.orders = 1u << 11 | 1u;
  register_subject(euler);
  return true;
}();

std::unique_ptr<Series> series(const std::string& subject, const std::string& law) {
  auto all = select({{subject}, {law}, {"double"}}, built_in_robot());
  return all.empty() ? nullptr : std::move(all.at(0));
}

TEST(OwnKinds, AnArmOfTwoJointsIsTriedOnALibraryOfRevoluteJointsAlone) {
  const CampaignResult r = run_quietly({{"kinds:revolute"}, {"lagrange"}, {"double"}}, 40);
  EXPECT_TRUE(r.failed);
  const auto s = series("kinds:revolute", "lagrange");
  EXPECT_EQ(s->robot, "revolute");
  const std::string id = s->id(42, 7).text();
  EXPECT_EQ(id, "g4.42.lagrange.kinds:revolute.double.revolute.7");
  EXPECT_EQ(s->numbers(CaseId::parse(id)), s->numbers(s->id(42, 7)));
  EXPECT_EQ(series("kinds:revolute", "tree_momentum"), nullptr);  // needs a free-flyer
}

TEST(OwnKinds, TheMomentumOfFloatingTreesIsNoLawForALibraryWithoutFreeFlyers) {
  const std::unique_ptr<Series> s = series("kinds:fixed", "tree_momentum");
  EXPECT_TRUE(!s || s->outputs.empty());
  EXPECT_NE(series("kinds:fixed", "forward_dynamics"), nullptr);
}

TEST(OwnKinds, WhoTakesEveryKindGetsTheInputsOfAll) {
  const auto every = series("kinds:every", "lagrange"), own = series("liecheck", "lagrange");
  EXPECT_EQ(every->robot, "none");
  EXPECT_EQ(
      JointSet(std::vector<std::string>(oracles::joint_names.begin(), oracles::joint_names.end())).text(),
      JointSet().text());
  for (std::uint64_t i = 0; i < 50; ++i)
    EXPECT_EQ(every->numbers(every->id(1, i)), own->numbers(own->id(1, i)));
}

TEST(OwnKinds, TreesHaveThemInEveryOrderAndAreDeepAndLarge) {
  for (const std::vector<std::string>& joints : {std::vector<std::string>{"revolute"},
                                                 {"revolute", "prismatic", "free-flyer"},
                                                 {"helical", "spherical", "mimic", "armature"},
                                                 {"free-flyer", "armature"}}) {
    Subject tested{"x", "1", "", &oracles::scalar_of<double>};
    tested.takes.joints = JointSet(joints);
    constexpr int n = 4000;
    for (auto& law : make_properties(oracles::scalar_of<double>)) {
      if (law->name() != "lagrange") continue;
      law->prepare(built_in_robot());
      EXPECT_EQ(law->draw_for(tested), tested.takes.joints.text());
      int deep = 0, large = 0, deepest = 0, most = 0;
      std::set<std::pair<JointKind, JointKind>> follows;
      std::set<std::string> used;
      Coverage coverage;
      const auto fields = law->fields();
      for (int i = 0; i < n; ++i) {
        Source source(sha256("own kinds" + std::to_string(i)));
        const std::vector<double> x = law->generate(source);
        ASSERT_TRUE(law->valid(x)) << i;
        coverage.add(fields, x, law->scalar());
        const TreeCase<double> c(TreeLayout::of_size(x.size()), x, x);
        std::vector<int> depth;
        for (const auto& j : c.tree.joints) {
          depth.push_back(j.parent < 0 ? 1 : depth[std::size_t(j.parent)] + 1);
          used.emplace(oracles::joint_names[std::size_t(j.kind)]);
          if (j.primary >= 0) used.insert("mimic");
          if (j.armature > 0) used.insert("armature");
          if (j.parent >= 0) follows.emplace(c.tree.joints[std::size_t(j.parent)].kind, j.kind);
        }
        const int deepest_here = *std::ranges::max_element(depth), bodies = int(depth.size());
        deep += deepest_here > 4, large += bodies > 8;
        deepest = std::max(deepest, deepest_here), most = std::max(most, bodies);
      }
      std::size_t kinds = 0;
      for (int k = 0; k < oracles::joint_kinds; ++k) kinds += tested.takes.joints.has(JointKind(k));
      EXPECT_EQ(used, std::set<std::string>(joints.begin(), joints.end()));
      EXPECT_EQ(follows.size(), kinds * kinds);
      EXPECT_GE(deep, n / 20);
      EXPECT_GE(large, n / 20);
      EXPECT_GE(deepest, 12);
      EXPECT_EQ(most, 20);
      for (std::size_t f = 0; f < fields.size(); ++f) {
        const auto& classes = classes_of(fields[f].kind);
        for (std::size_t c = 0; c < classes.size(); ++c) {
          if (!requires_class(fields[f], classes[c])) continue;
          const double expected = n / double(classes[c].one_in);
          EXPECT_GE(double(coverage.count(f, c)), expected - 4 * std::sqrt(expected))
              << law->name() << " " << fields[f].name << ": " << classes[c].name;
        }
      }
    }
  }
}

TEST(OwnKinds, MostCasesOfAnAdapterWithTwoKindsOfJointsAreMeasured) {
  const std::string name = adapters::register_adapter("in-process:" LIECHECK_HINGES, "hinges_of_own_kinds");
  const CampaignResult r = run_quietly({{name}, {}, {"double"}}, 1000, 2);
  EXPECT_FALSE(r.failed);
  EXPECT_TRUE(r.measured);
  for (const auto& [series, tally] : r.series) {
    EXPECT_EQ(series->robot, "revolute_prismatic_armature");
    for (std::size_t i = 0; i < series->outputs.size(); ++i)
      if (series->due >> i & 1) {
        EXPECT_EQ(tally.coverage.cases(&MeasuredOutputs::outside, i), 0u);
        EXPECT_GE(tally.coverage.cases(&MeasuredOutputs::measured, i), 900u)
            << series->property << " " << series->outputs[i].operation;
      }
  }
}

TEST(OwnKinds, EulerAnglesAreInTheOrdersOfTheLibrary) {
  const auto s = series("kinds:euler", "euler_angles");
  EXPECT_EQ(s->robot, "orders_0_11");
  std::set<double> orders;
  for (std::uint64_t i = 0; i < 100; ++i) orders.insert(s->numbers(s->id(42, i)).at(0));
  EXPECT_EQ(orders, (std::set<double>{0, 11}));
  EXPECT_EQ(series("liecheck", "euler_angles")->robot, "none");
}

}  // namespace
}  // namespace liecheck::properties
