// An operation on a frame is asked about in three references: a failure shows the one that fails, and a library may lack
// some.

#include <gtest/gtest.h>
#include <adapters/trees.hpp>
#include <failures/description.hpp>
#include <subjects/tree.hpp>

#include "../campaigns.hpp"
#include "../own_subject.hpp"

namespace liecheck::properties {
namespace {

using V6 = TypedOperations<double>::V6;

/// liecheck's frame_velocity, changed by f(seen, V).
template <class F>
Registered<double> velocities(const std::string& name, F f) {
  TypedSubject<double> s;
  s.name = name;
  s.operations.tree = [f](const Tree<double>& tree) {
    TreeOperations<double> few;
    few[op::frame_velocity] = [f, right = own_subject().operations.tree(tree)[op::frame_velocity]](
                                  const auto& q, const auto& v, Seen seen) -> V6 {
      return f(seen, V6(right(q, v, seen)));
    };
    return few;
  };
  return Registered<double>(s);
}
const Registered<double> of_world = velocities(
                             "frames:world_wrong",
                             [](Seen seen, const V6&V) -> V6 { return (seen == Seen::world ? 1.5 : 1) * V; }),
                         of_local = velocities("frames:local", [](Seen seen, const V6&V) {
                           if (seen != Seen::local)
                             throw CallFailed("no such reference", "frame_velocity", Outcome::outside_domain);
                           return V;
                         });

TEST(ReferenceFrames, AFailureShowsTheOneThatFails) {
  const CampaignResult r = run_quietly({{"frames:world_wrong"}, {"frame_motion"}, {"double"}}, 40);
  ASSERT_TRUE(r.failed);
  const auto& [series, tally] = r.series.at(0);
  for (const auto& [cell, row] : tally.rows) {
    if (!row.failed) continue;
    const std::string text = describe_failure(*series, 42, cell.first, cell.second, row, built_in_robot());
    const std::string block(series->outputs[std::size_t(cell.first)].block);
    EXPECT_NE(text.find("  result    V of frame_velocity in WORLD\n    " + block + "["), text.npos) << text;
    EXPECT_EQ(text.find("the exact result, rounded"), text.npos) << text;
  }
}

TEST(ReferenceFrames, OfALibraryThatHasOneTheOthersAreOutsideItsDomain) {
  const CampaignResult r = run_quietly({{"frames:local"}, {"frame_motion"}, {"double"}}, 1000, 2);
  EXPECT_FALSE(r.failed);
  EXPECT_TRUE(r.measured);
  for (const auto& [cell, row] : r.series.at(0).tally.rows) {
    EXPECT_EQ(row.outside_domain, 0u);
    EXPECT_EQ(row.count, 1000u);
  }
}

TEST(ReferenceFrames, AnAdapterIsNotAskedInOneThatItLacks) {
  Tree<double> tree;
  tree.joints.emplace_back();
  tree.joints[0].parent = tree.joints[0].primary = -1;
  tree.index();
  adapters::Description local;
  local.references = {"local"};
  const adapters::Model model(tree, local, oracles::scalar_of<double>, nullptr);
  std::vector<double> arguments{0, 0, 0}, V(6);  // q, v, WORLD
  try {
    model.call(op::frame_velocity, arguments.data(), V.data());
    FAIL();
  } catch (const CallFailed& e) {
    EXPECT_EQ(e.outcome, Outcome::outside_domain);
    EXPECT_EQ(std::string(e.what()), "the adapter sees no frame in: world");
  }
}

}  // namespace
}  // namespace liecheck::properties
