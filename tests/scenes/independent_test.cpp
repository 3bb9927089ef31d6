// Tangent increments (lib, in float128) and maximal coordinates (scenes/independent.hpp) agree on every
// effect, so that a wrong equation in either is seen: each key of an effect that changes, and each wrong term
// that is planted, separates them.

#include <gtest/gtest.h>

#include <liecheck/scene/effects/registry.hpp>
#include <list>

#include "formulations.hpp"
#include "planted.hpp"

namespace {

using namespace liecheck;
using test::Formulations;

std::vector<const scene::PartInfo*> every_effect() {
  std::vector<const scene::PartInfo*> all;
  for (const auto* list : {&scene::effectEntries<double>(), &scene::actuationEntries<double>()})
    for (const auto& e : *list) all.push_back(e.info);
  return all;
}

/// Two results in double are compared to half a unit of the last place, 1.1e-16.
constexpr double agreed = 1e-17;
/// Wrong terms change the motion by more than this many times the agreement.
constexpr double apart = 1e6;

class Effect : public testing::TestWithParam<const scene::PartInfo*> {
 protected:
  Effect() {
    for (const test::EffectScene& s : test::effect_scenes())
      if (s.effect == GetParam()->name) names.push_back(test::name_of(s)), scenes.emplace_back(s);
  }
  /// The largest change over the scenes, as a multiple of their agreement; a change of the scene itself may
  /// fail.
  template <class Change>
  double seen(Change change) {
    double largest = 0;
    for (const Formulations& s : scenes)
      if (const double d = s.from(change(s.scene)); d > 1e-9) largest = std::max(largest, d / s.agreement);
    return largest;
  }
  std::list<Formulations> scenes;
  std::vector<std::string> names;
};

/// Another value of a key.
void change(scene::Value& value, const scene::Key& key) {
  for (double& x : value.numbers) x = x == 0 ? 0.01 : 1.01 * x;
  if (key.kind == scene::Kind::Direction) value.numbers[0] += 0.1;  // its length does not matter
  for (std::string& name : value.names) {
    if (key.kind == scene::Kind::Frame) name = "fin";
    if (key.kind == scene::Kind::Choice) {
      const std::string words = key.unit, first = words.substr(0, words.find('|'));
      name = name == first ? words.substr(first.size() + 1) : first;
    }
  }
  if (key.kind == scene::Kind::Frames || key.kind == scene::Kind::Bodies) value.names = {"fin"};
  if (key.kind == scene::Kind::Joints && value.names[0] != "root_joint")
    value.names = {value.names[0] == "a_joint" ? "b_joint" : "slide"};
}

TEST_P(Effect, IsTheSameInTangentIncrementsAndInMaximalCoordinates) {
  EXPECT_FALSE(scenes.empty()) << "effect_scenes.hpp has no scene for " << GetParam()->name;
  std::size_t i = 0;
  for (const Formulations& s : scenes) {
    std::printf("  agree to %.0e: %s\n", s.agreement, names[i].c_str());
    EXPECT_LT(s.agreement, agreed) << names[i];
    ++i;
  }
  for (const scene::Key& key : GetParam()->keys) {
    const double times = seen([&](properties::Benchmark scene) {
      auto& values = scene.requests[0].parameters.values;
      if (const auto at = values.find(key.name); at != values.end()) change(at->second, key);
      return properties::independent_tree<long double>(scene);
    });
    EXPECT_GT(times, apart) << "no scene shows the key " << key.name << " of " << GetParam()->name;
  }
  std::size_t wrong = 0;
  for (const test::planted::Planted& p : test::planted::all()) {
    if (p.effect != std::string(GetParam()->name)) continue;
    const double times = seen([&](const properties::Benchmark& scene) {
      auto tree = properties::independent_tree<long double>(scene);
      p.plant(tree);
      return tree;
    });
    std::printf("  %.0e times further apart: %s %s\n", times, p.effect, p.what);
    EXPECT_GT(times, apart) << p.what;
    ++wrong;
  }
  EXPECT_GT(wrong, 0U) << "planted.hpp has no wrong term for " << GetParam()->name;
}

TEST(ClosedLoops, AgreeWhereAConstraintOfAPlanarLinkageIsRedundant) {
  const Formulations s({"closed_loops", "frames: [coupler_end, rocker_end]", false, false, "linkage"});
  EXPECT_LT(s.agreement, agreed);
}

/// A scene with each part that has no law.
test::EffectScene scene_with(const properties::Unconfirmed& u) {
  test::EffectScene s{u.effect, "bodies: fin, stiffness: 300", false, true};
  s.shapes = "[{shape: sphere, on: fin, radius: 0.1}]";
  if (u.part == "cylinders") s.shapes = "[{shape: cylinder, on: fin, radius: 0.1, length: 0.2}]";
  if (u.part == "heights and meshes")
    s.ground = "{heights: [[0, 0], [0, 0]], spacing: [9, 9], corner: [-4, -4]}";
  return s;
}

TEST(UnconfirmedParts, AreListedAndHaveNoLaw) {
  for (const properties::Unconfirmed& u : properties::unconfirmed_parts()) {
    std::printf("  not confirmed: %s of %s, since %s\n", u.effect.c_str(), u.part.c_str(), u.why.c_str());
    const auto scene = properties::benchmark_of(test::scene_of(scene_with(u)));
    try {
      properties::independent_tree<long double>(scene);
      ADD_FAILURE() << u.effect << " of " << u.part << " has a law: take it off the list";
    } catch (const std::invalid_argument& e) {
      EXPECT_NE(std::string(e.what()).find(u.why), std::string::npos) << e.what();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Effect, testing::ValuesIn(every_effect()),
                         [](const auto& info) { return std::string(info.param->name); });

}  // namespace
