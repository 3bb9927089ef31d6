// urdf/urdf.hpp: errors in links and joints, and warnings of elements that a joint's type does not use.

#include <gtest/gtest.h>

#include "urdf_texts.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

TEST(BadUrdf, AnUnknownJointTypeIsNamed) {
  expectRefused(twoLinks("wobbly", ""), 4, "joint 'j': unknown joint type", "wobbly");
  std::string untyped = twoLinks("fixed", "");
  untyped.erase(untyped.find(" type='fixed'"), 13);
  expectRefused(untyped, 4, "joint 'j' has no type", "");
}

TEST(BadUrdf, AZeroOrNonFiniteAxisIsRefused) {
  for (const char* type : {"revolute", "continuous", "prismatic"}) {
    expectRefused(twoLinks(type, limit + "<axis xyz='0 0 -0.0'/>"), 4, "zero axis", "0 0 -0.0");
    expectRefused(twoLinks(type, limit + "<axis xyz='0 inf 0'/>"), 4, "hold finite numbers", "0 inf 0");
    expectRefused(twoLinks(type, limit + "<axis xyz='0 nan 0'/>"), 4, "hold finite numbers", "0 nan 0");
    expectRefused(twoLinks(type, limit + "<axis/>"), 4, "<axis> xyz is missing", "");
  }
}

TEST(BadUrdf, TextThatIsNoFiniteNumberIsRefusedWithItsLine) {
  for (const char* bad : {"x", "1..0", "1,5", "0x10", "nan", "-inf", "1e999", "--1", "1e", "+-1", "1_0"}) {
    const std::string value = bad;
    expectRefused(twoLinks("fixed", "\n<origin xyz='0 " + value + " 0'/>"), 5, "<origin> xyz",
                  "0 " + value + " 0");
    expectRefused(twoLinks("fixed", "\n<origin rpy='" + value + " 0 0'/>"), 5, "<origin> rpy",
                  value + " 0 0");
    expectRefused(oneLink(inertial(value)), 3, "<mass> value", value);
    expectRefused(oneLink(inertial("1", value)), 3, "<inertia> ixx", value);
    expectRefused(twoLinks("revolute", "\n\n<limit effort='" + value + "' velocity='1'/>"), 6,
                  "<limit> effort", value);
    expectRefused(oneLink("<visual><geometry><sphere radius='" + value + "'/></geometry></visual>"), 3,
                  "radius", value);
  }
  expectRefused(twoLinks("fixed", "<origin xyz='0 1'/>"), 4, "2 numbers, not 3", "0 1");
  expectRefused(twoLinks("fixed", "<origin xyz='0 1 2 3'/>"), 4, "4 numbers, not 3", "0 1 2 3");
  expectRefused(oneLink(inertial("")), 3, "0 numbers, not 1", "");
  const Model<double> m = buildModelFromUrdfText(oneLink(inertial("+1.5e0", " \t2\n")), RootJoint::FreeFlyer);
  EXPECT_EQ(m.inertias[1].mass(), 1.5);
  EXPECT_EQ(m.inertias[1].inertia()(0, 0), 2);
}

TEST(BadUrdf, AnIncompleteInertialIsRefused) {
  expectRefused(oneLink("<inertial><mass value='1'/></inertial>"), 3, "without <inertia>", "a");
  expectRefused(oneLink("<inertial><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>"), 3,
                "without <mass>", "a");
  expectRefused(oneLink("<inertial><mass value='1'/><inertia ixx='1'/></inertial>"), 3, "ixy is missing", "");
}

TEST(BadUrdf, ANegativeMassIsRefusedAndAZeroMassIsNot) {
  expectRefused(oneLink(inertial("-0.5")), 3, "link 'a' has a negative mass", "-0.5");
  EXPECT_NO_THROW(buildModelFromUrdfText(oneLink(inertial("0"))));
}

TEST(BadUrdf, AMissingLinkIsNamedWithItsRole) {
  std::string text = twoLinks("fixed", "");
  std::string no_child = text, no_parent = text, nothing = text;
  expectRefused(no_child.replace(no_child.find("child link='b'"), 14, "child link='c'"), 4,
                "child link does not exist", "c");
  expectRefused(no_parent.replace(no_parent.find("parent link='a'"), 15, "parent link='c'"), 4,
                "parent link does not exist", "c");
  expectRefused(nothing.replace(nothing.find("<parent link='a'/>"), 18, ""), 4, "has no parent link", "");
}

TEST(BadUrdf, TwoRootsAreBothNamed) {
  expectRefused("<robot name='r'>\n<link name='a'/>\n<link name='b'/></robot>", 3,
                "two roots, the other is 'a'", "b");
}

TEST(BadUrdf, LoopsAreRefused) {
  const auto joint = [](const std::string& name, const std::string& parent, const std::string& child) {
    return "<joint name='" + name + "' type='fixed'><parent link='" + parent + "'/><child link='" + child +
           "'/></joint>\n";
  };
  const std::string links = "<robot name='r'>\n<link name='a'/>\n<link name='b'/>\n<link name='c'/>\n";
  expectRefused(links + joint("x", "a", "b") + joint("y", "b", "c") + joint("z", "c", "a") + "</robot>", 1,
                "a loop", "a");
  expectRefused(links + joint("x", "b", "c") + joint("y", "c", "b") + "</robot>", 3, "form a loop", "b");
  expectRefused(links + joint("x", "a", "c") + joint("y", "a", "b") + joint("z", "b", "c") + "</robot>", 7,
                "the same child", "c");
}

TEST(BadUrdf, DuplicateNamesAreRefusedWithTheLineOfTheFirst) {
  expectRefused("<robot name='r'>\n<link name='a'/>\n<link name='a'/></robot>", 3, "the first is in line 2",
                "a");
  expectRefused("<robot name='r'>\n<link name='a'/>\n<material name='m'/>\n<material name='m'/></robot>", 4,
                "the first is in line 3", "m");
  std::string text = twoLinks("fixed", "");
  text.insert(text.find("</robot>"),
              "<link name='c'/><joint name='j' type='fixed'><parent link='b'/><child link='c'/></joint>");
  expectRefused(text, 5, "the first is in line 4", "j");
  std::string universe = twoLinks("fixed", "");
  expectRefused(universe.replace(universe.find("'j'"), 3, "'universe'"), 4, "reserved", "universe");
  std::string root = twoLinks("fixed", "");
  root.replace(root.find("'j'"), 3, "'root_joint'");
  EXPECT_NO_THROW(buildModelFromUrdfText(root));
  EXPECT_NE(refusal(root, RootJoint::FreeFlyer).find("reserved"), std::string::npos);
}

TEST(BadUrdf, AMissingLimitIsRefusedIfTheTypeNeedsOne) {
  expectRefused(twoLinks("revolute", ""), 4, "no <limit>", "revolute");
  EXPECT_NO_THROW(buildModelFromUrdfText(twoLinks("continuous", "")));
}

TEST(BadUrdf, AnIncompleteMimicCalibrationSafetyControllerOrDynamicsIsNamedWithItsLine) {
  expectRefused(twoLinks("continuous", "\n<mimic/>"), 5, "joint 'j' has a <mimic> that names no joint", "");
  expectRefused(twoLinks("continuous", "\n<calibration rising='x'/>"), 5, "<calibration> rising", "x");
  expectRefused(twoLinks("continuous", "\n<safety_controller k_velocity='nan'/>"), 5, "k_velocity", "nan");
  expectRefused(twoLinks("continuous", "\n<safety_controller/>"), 5,
                "<safety_controller> k_velocity is missing", "");
  expectRefused(twoLinks("continuous", "\n<dynamics/>"), 5, "<dynamics> without damping", "");
}

TEST(BadUrdf, CrossedAndNegativeLimitsAreRefused) {
  const std::string crossed = "\n<limit lower='1' upper='-1' effort='1' velocity='1'/>";
  for (const char* type : {"revolute", "prismatic"})
    expectRefused(twoLinks(type, crossed), 5, "joint 'j' has crossed limits", "1.000000 > -1.000000");
  expectRefused(twoLinks("continuous", "\n<limit effort='-2' velocity='1'/>"), 5, "a negative effort limit",
                "-2");
  expectRefused(twoLinks("revolute", "\n<limit effort='2' velocity='-1'/>"), 5, "a negative velocity limit",
                "-1");
}

TEST(BadUrdf, AnImpossibleInertiaIsRefusedUnlessFixedLinksMakeItPossible) {
  expectRefused(oneLink("\n" + inertial("1", "3")), 4,
                "link 'a': a principal moment of inertia is larger than the sum of the other two", "1 1 3");
  expectRefused(oneLink(inertial("1", "-1")), 3, "link 'a': a principal moment of inertia is negative",
                "-1 1 1");
  EXPECT_NO_THROW(buildModelFromUrdfText(oneLink(inertial("1", "2"))));  // flat
  const std::string sensor = "<robot name='r'>\n<link name='a'>" + inertial("10", "1") +
                             "</link>\n<link name='b'>" + inertial("1e-3", "2.1") +
                             "</link>\n<joint name='j' type='fixed'><parent link='a'/>" +
                             "<child link='b'/></joint></robot>";
  const UrdfRobot robot = loadUrdfText(sensor, {}, "r.urdf");
  ASSERT_EQ(robot.warnings.size(), 1U);
  EXPECT_EQ(
      robot.warnings[0],
      "r.urdf:3: link 'b': a principal moment of inertia is larger than the sum of the other two; the sum "
      "with the links fixed to it is valid (1 1 2.1)");
}

const std::string three = "<robot name='r'>\n<link name='a'/>\n<link name='b'/>\n<link name='c'/>\n";

std::string mimicJoint(const std::string& name, const std::string& type, const std::string& parent,
                       const std::string& child, const std::string& primary) {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent + "'/><child link='" +
         child + "'/>" + limit +
         (primary.empty() ? "" : "<mimic joint='" + primary + "' multiplier='-2' offset='0.5'/>") +
         "</joint>\n";
}

TEST(BadUrdf, AMimicOfNothingOfItselfOfALaterJointOrOfAMimicIsRefused) {
  const auto text = [](const std::string& first, const std::string& second, const char* type = "revolute") {
    return three + mimicJoint("j", type, "a", "b", first) + mimicJoint("k", "revolute", "b", "c", second) +
           "</robot>";
  };
  expectRefused(text("", "nobody"), 6, "joint 'k' mimics a joint that does not exist", "nobody");
  expectRefused(text("k", ""), 5, "joint 'j' mimics a joint that comes later", "k");
  expectRefused(text("", "k"), 6, "joint 'k' mimics itself", "k");
  expectRefused(text("", "j", "fixed"), 6, "mimics a joint that does not move", "j");
  expectRefused(text("", "j", "floating"), 6, "mimics a joint that does not have exactly one", "j");
  std::string chained = text("", "j");
  chained.insert(chained.find("</robot>"), "<link name='d'/>" + mimicJoint("l", "revolute", "c", "d", "k"));
  EXPECT_NO_THROW(loadUrdfText(chained));
  try {
    loadUrdfText(chained, {.mimic = MimicJoints::Tied}, "bad.urdf");
    ADD_FAILURE() << "a mimic of a mimic was tied";
  } catch (const UrdfError& e) {
    EXPECT_STREQ(e.what(), "bad.urdf:7: joint 'l' mimics a joint that is a mimic itself (k)");
  }
}

TEST(Urdf, AMimicIsIndependentWithAWarningOrTiedIfRequested) {
  const std::string text = three + mimicJoint("j", "revolute", "a", "b", "") +
                           mimicJoint("k", "prismatic", "b", "c", "j") + "</robot>";
  const UrdfRobot free = loadUrdfText(text, {}, "r.urdf"),
                  tied = loadUrdfText(text, {.mimic = MimicJoints::Tied});
  EXPECT_EQ(free.model.nv, 2);
  EXPECT_EQ(free.warnings[0], "r.urdf:6: joint 'k' is a mimic and is treated as independent (j)");
  EXPECT_EQ(tied.model.nv, 1);
  const auto& mimic = std::get<Mimic<double>>(tied.model.joints[2]);
  EXPECT_EQ(mimic.primary, 1);
  EXPECT_EQ(mimic.multiplier, -2);
  EXPECT_EQ(mimic.offset, 0.5);
  EXPECT_TRUE(std::holds_alternative<Prismatic<double>>(mimic.moved));
}

TEST(Urdf, LimitsDampingAndFrictionAreReadIntoTheModel) {
  const UrdfRobot r = loadUrdfText(
      twoLinks("revolute",
               "<limit lower='-1' upper='2' effort='3' velocity='4'/><dynamics damping='5' friction='6'/>"));
  EXPECT_EQ(r.model.lowerPositionLimit[0], -1);
  EXPECT_EQ(r.model.upperPositionLimit[0], 2);
  EXPECT_EQ(r.model.effortLimit[0], 3);
  EXPECT_EQ(r.model.velocityLimit[0], 4);
  EXPECT_EQ(r.model.damping[0], 5);
  EXPECT_EQ(r.model.friction[0], 6);
  const Model<double> free = buildModelFromUrdfText(twoLinks("continuous", ""));
  EXPECT_EQ(free.effortLimit[0], INFINITY);
  EXPECT_EQ(free.upperPositionLimit[0], INFINITY);
}

TEST(Urdf, AnElementThatAJointTypeIgnoresIsAWarningAndIfStrictAnError) {
  const auto warned = [](const std::string& type, const std::string& elements) {
    const std::string text = twoLinks(type, elements);
    const UrdfRobot r = loadUrdfText(text, {}, "r.urdf");
    EXPECT_EQ(r.warnings.size(), 2U);  // the other one is about the link without mass
    EXPECT_EQ(r.warnings.back(),
              "r.urdf:4: the link of a moving joint and the links fixed to it have no mass (j)");
    try {
      loadUrdfText(text, {.strict = true}, "r.urdf");
      ADD_FAILURE() << "nothing was refused although strict";
    } catch (const UrdfError& e) {
      EXPECT_EQ(e.what(), r.warnings.front());
    }
    return r.warnings.front();
  };
  EXPECT_EQ(warned("planar", "<axis xyz='0 1 0'/>"),
            "r.urdf:4: joint 'j' is planar and its axis is ignored: it moves in its x y plane (0 1 0)");
  EXPECT_EQ(warned("floating", "<axis xyz='0 1 0'/>"),
            "r.urdf:4: joint 'j' is floating and its axis is ignored (0 1 0)");
  EXPECT_EQ(warned("floating", "<dynamics damping='1'/>"),
            "r.urdf:4: joint 'j': its <dynamics> is ignored (floating)");
  EXPECT_NE(
      warned("continuous", "<limit lower='-1' upper='1' effort='1' velocity='1'/>").find("position limits"),
      std::string::npos);
}

}  // namespace
