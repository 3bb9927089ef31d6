// The second formulation refuses what it cannot confirm, and a reference that it contradicts is refused.

#include <gtest/gtest.h>

#include <integrators/confirm.hpp>
#include <integrators/reference.hpp>

#include "effect_scenes.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::properties;

TEST(Confirmation, NamesTheMimicJointThatMaximalCoordinatesLack) {
  const Benchmark b = benchmark_of(loadSceneText(
      "robot: {urdf: tied_rods.urdf, root: fixed}\neffects: [gravity]\nintegrator: {name: rkmk4, "
      "step: 1 ms}\nduration: 0.1\n",
      "mimic.yaml", LIECHECK_FIXTURES "/scenes/"));
  Moment start;
  start.q.assign(b.q0.begin(), b.q0.end()), start.v.assign(b.v0.begin(), b.v0.end());
  const Confirmation c = confirmation_of(b, {start, start}, nullptr);
  EXPECT_NE(c.unconfirmed.find("joint 'knee' is a mimic"), std::string::npos) << c.unconfirmed;
}

/// On a lone body, drag far from the centre of mass.
Benchmark dragged() {
  return benchmark_of(test::scene_of({"drag", "frame: tool, linear: 0.5, quadratic: 0.7", false, true}));
}
Reference reference(const Benchmark& b) {
  return reference_of(b, 2, nullptr, [](const std::string&) {});
}

TEST(Reference, IsConfirmedByMaximalCoordinates) {
  const Reference r = reference(dragged());
  EXPECT_NE(r.name.find("maximal coordinates"), std::string::npos) << r.name;
  EXPECT_EQ(r.name.find("unconfirmed"), std::string::npos) << r.name;
}

TEST(Reference, IsRefusedIfTheLawOfOneEffectDiffers) {
  Benchmark b = dragged();
  b.requests[0].parameters.values["linear"].numbers[0] *= 1 + 1e-9;
  EXPECT_THROW(reference(b), std::invalid_argument);
}

}  // namespace
