#include <gtest/gtest.h>
#include <algorithm>
#include <bugs/causes.hpp>
#include <bugs/known_bugs.hpp>
#include <bugs/weak_tests.hpp>
#include <map>
#include <set>

#include "../own_subject.hpp"
#include "../sample.hpp"
#include "../shell.hpp"

namespace liecheck::properties {
namespace {

bool is_alike(const KnownBug& b) {
  return b.name.rfind("alike:", 0) == 0;
}

TEST(KnownBugs, AreAtLeastFortyWithTenLookAlikesAndAllStateTheirOrigin) {
  std::set<std::string> names;
  for (const KnownBug& b : known_bug_table()) {
    EXPECT_TRUE(names.insert(b.name).second) << b.name;
    EXPECT_FALSE(b.fault.empty() || b.origin.empty()) << b.name;
  }
  const auto alikes = std::count_if(known_bug_table().begin(), known_bug_table().end(), is_alike);
  EXPECT_GE(alikes, 10);
  EXPECT_GE(static_cast<std::ptrdiff_t>(known_bug_table().size()) - alikes, 40);
}

TEST(KnownBugs, AreSubjectsInFloatAndDouble) {
  const auto in_float = typed_subjects<float>();
  const auto in_double = typed_subjects<double>();
  const auto named = [](const auto& all, const std::string& name) {
    return std::count_if(all.begin(), all.end(), [&](auto* s) { return s->name == name; });
  };
  for (const KnownBug& b : known_bug_table()) {
    EXPECT_EQ(named(in_float, b.name), 1);
    EXPECT_EQ(named(in_double, b.name), 1);
  }
}

TEST(WeakStyles, PassTheLibraryAndKillSomeBugsButNotAll) {
  for (const WeakStyle& style : weak_styles()) {
    EXPECT_FALSE(style.kills(own_subject().operations)) << style.name;
    int killed = 0, survived = 0;
    for (const auto* s : typed_subjects<double>())
      if (s->name.rfind("bug:", 0) == 0) (style.kills(s->operations) ? killed : survived) += 1;
    EXPECT_GT(killed, 0) << style.name;
    EXPECT_GT(survived, 0) << style.name;
  }
}

TEST(KnownBugs, AFindingOnATreeDrawsItAndSaysWhere) {
  const auto [code, text] =
      shell("{ " LIECHECK_LAB
            " campaign --subject bug:tree_armature_twice --no-hard-cases --scalar double 2>/dev/null; }");
  EXPECT_EQ(code, 1);
  EXPECT_NE(text.find("   where    a joint has an armature: "), std::string::npos) << text;
  EXPECT_NE(text.find("   tree     1  "), std::string::npos) << text;
  EXPECT_NE(text.find("   perhaps  where it fails, the result is what twice the armature would give"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find(", armature 1; mass 1"), std::string::npos) << text;
  EXPECT_NE(text.find("M[0,0] is 3, and 2 is right"), std::string::npos) << text;
}

TEST(KnownBugs, AFindingOnATreeNamesTheTreeTheResultOrTheTermThatItComesFrom) {
  const std::pair<const char*, const char*> bugs[] = {
      {"tree_gravity_sign", "where it fails, the result is the opposite of the right one"},
      {"tree_aligned_for_world", "where it fails, the result is that of LOCAL_WORLD_ALIGNED"},
      {"tree_spatial_for_classical", "where it fails, the result is that of frame_acceleration"},
      {"tree_derivative_at_rest", "where it fails, the result is what a = 0 would give"},
      {"tree_coriolis_factor", "it is right with v = 0, so a term that is 0 then is wrong or missing"}};
  for (const auto& [bug, cause] : bugs) {
    const auto [code, text] = shell(
        "{ " LIECHECK_LAB " campaign --no-hard-cases --scalar double --subject bug:" + std::string(bug) +
        " 2>/dev/null; }");
    EXPECT_EQ(code, 1) << bug;
    EXPECT_NE(text.find(std::string("   perhaps  ") + cause + "\n"), std::string::npos) << text;
  }
}

TEST(KnownBugs, TheCauseOfAFaultyFormIsNamedRightlyOrNotAtAll) {
  std::map<Named, double> named;
  double found = 0;
  const std::size_t every = sample<std::size_t>(3, 1);
  for (const CauseRow& row : bench_of_causes(42, every))
    ++named[row.named], found += row.named != Named::not_found;
  EXPECT_GE(found * static_cast<double>(every), 150);
  EXPECT_GE(named[Named::right] + 0.5 * named[Named::where], 0.85 * found);
  EXPECT_LE(named[Named::wrong], 0.03 * found);
}

}  // namespace
}  // namespace liecheck::properties
