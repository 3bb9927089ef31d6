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
    expectWarned(oneLink("<visual><geometry><sphere radius='" + value + "'/></geometry></visual>"), 3,
                 "radius", value);
  }
  expectRefused(twoLinks("fixed", "<origin xyz='0 1'/>"), 4, "2 numbers, not 3", "0 1");
  expectRefused(twoLinks("fixed", "<origin xyz='0 1 2 3'/>"), 4, "4 numbers, not 3", "0 1 2 3");
  expectRefused(oneLink(inertial("")), 3, "0 numbers, not 1", "");
  const Model<double> m = buildModelFromUrdfText(oneLink(inertial("+1.5e0", " \t2\n")), RootJoint::FreeFlyer);
  EXPECT_EQ(m.inertias[1].mass(), 1.5);
  EXPECT_EQ(m.inertias[1].inertia()(0, 0), 2);
}

TEST(Urdf, AnIncompleteInertialIsAWarningIfWhatIsMissingHasAnObviousValue) {
  const std::string point = oneLink("<inertial><mass value='2'/></inertial>");
  expectWarned(point, 3, "an <inertial> without <inertia> is that of a point", "a");
  const Inertia<double> I = buildModelFromUrdfText(point, RootJoint::FreeFlyer).inertias[1];
  EXPECT_EQ(I.mass(), 2);
  EXPECT_EQ(I.inertia(), M3::Zero());
  expectWarned(oneLink("<inertial><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>"), 3,
               "an <inertial> without <mass> is ignored, and the link has no mass", "a");
  expectRefused(oneLink("<inertial><mass value='1'/><inertia ixx='1'/></inertial>"), 3, "iyy is missing", "");
  const std::string diagonal =
      oneLink("<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1'/></inertial>");
  for (const char* product : {"ixy", "ixz", "iyz"})
    expectWarned(diagonal, 3, std::string("<inertia> ") + product + " is missing and is taken as", "0");
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
  expectWarned("<robot name='r'>\n<link name='a'/>\n<material name='m'/>\n<material name='m'/></robot>", 4,
               "the first is in line 3", "m");
  std::string text = twoLinks("fixed", "");
  text.insert(text.find("</robot>"),
              "<link name='c'/><joint name='j' type='fixed'><parent link='b'/><child link='c'/></joint>");
  expectRefused(text, 5, "the first is in line 4", "j");
  std::string universe = twoLinks("fixed", "");
  expectRefused(universe.replace(universe.find("'j'"), 3, "'universe'"), 4, "reserved", "universe");
  expectRefused("<robot name='r'>\n<link name='universe'/></robot>", 2, "this link name is reserved",
                "universe");
  std::string root = twoLinks("fixed", "");
  root.replace(root.find("'j'"), 3, "'root_joint'");
  EXPECT_NO_THROW(buildModelFromUrdfText(root));
  EXPECT_TRUE(has(refusal(root, RootJoint::FreeFlyer), "reserved"));
}

TEST(Urdf, AJointWhoseLimitIsMissingCrossedOrNegativeIsNotLimitedWithAWarning) {
  const double infinity = std::numeric_limits<double>::infinity();
  const auto expectUnlimited = [&](const std::string& elements, int line, const std::string& words,
                                   const std::string& value, bool bounds, bool effort) {
    const std::string text = twoLinks("revolute", elements);
    expectWarned(text, line, words, value);
    const Model<double> m = buildModelFromUrdfText(text);
    EXPECT_EQ(m.lowerPositionLimit[0], bounds ? -infinity : -1);
    EXPECT_EQ(m.upperPositionLimit[0], bounds ? infinity : 1);
    EXPECT_EQ(m.effortLimit[0], effort ? infinity : 1);
  };
  expectUnlimited("", 4, "no <limit>, which its type needs", "revolute", true, true);
  expectUnlimited("\n<limit lower='2' upper='-1' effort='1' velocity='1'/>", 5,
                  "joint 'j' has crossed limits, lower > upper, which are ignored", "2.000000 -1.000000",
                  true, false);
  expectUnlimited("\n<limit lower='-1' upper='1' effort='-2' velocity='1'/>", 5,
                  "a negative effort limit, which is ignored", "-2", false, true);
  expectUnlimited("\n<limit lower='-1' upper='1' velocity='1'/>", 5, "<limit> effort is missing", "infinite",
                  false, true);
  expectWarned(twoLinks("prismatic", "\n<limit lower='0' upper='1' effort='2' velocity='-1'/>"), 5,
               "a negative velocity limit, which is ignored", "-1");
  for (const char* type : {"continuous", "floating"})
    EXPECT_NO_THROW(buildModelFromUrdfText(twoLinks(type, "")));
}

TEST(Urdf, ALimitWithoutBoundsIsZeroAsInTheSpecificationWithAWarning) {
  const std::string text = twoLinks("prismatic", "\n<limit effort='1' velocity='1'/>");
  expectWarned(text, 5, "joint 'j' has a <limit> without lower, which is taken as", "0");
  expectWarned(text, 5, "joint 'j' has a <limit> without upper, which is taken as", "0");
  EXPECT_EQ(buildModelFromUrdfText(text).upperPositionLimit[0], 0);
}

TEST(BadUrdf, AnIncompleteMimicCalibrationSafetyControllerOrDynamicsIsNamedWithItsLine) {
  expectRefused(twoLinks("continuous", "\n<mimic/>"), 5, "joint 'j' has a <mimic> that names no joint", "");
  expectRefused(twoLinks("continuous", "\n<calibration rising='x'/>"), 5, "<calibration> rising", "x");
  expectRefused(twoLinks("continuous", "\n<safety_controller k_velocity='nan'/>"), 5, "k_velocity", "nan");
  expectRefused(twoLinks("continuous", "\n<safety_controller/>"), 5,
                "<safety_controller> k_velocity is missing", "");
  expectWarned(twoLinks("continuous", "\n<dynamics/>"), 5, "<dynamics> without damping", "continuous");
}

TEST(Urdf, AnInertiaThatBreaksTheTriangleInequalityIsAWarning) {
  expectWarned(oneLink("\n" + inertial("1", "3")), 4,
               "link 'a': a principal moment of inertia is larger than the sum of the other two", "1 1 3");
  EXPECT_EQ(loadUrdfText(oneLink(inertial("1", "2")), {.root = RootJoint::FreeFlyer}).warnings.size(),
            0U);  // flat
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

TEST(Urdf, ANegativeMomentIsAWarningThatTheEnergyCanBeNegativeIfItMovesAndIsMoreThanAPrintingError) {
  const std::string bad = oneLink(inertial("1", "-1"));
  const std::string energy = "is negative, and the kinetic energy can be negative";
  expectWarned(bad, 3, "link 'a': a principal moment of inertia " + energy, "-1 1 1");
  expectWarned(bad, 3, "is negative; the link does not move", "-1 1 1", {});
  expectWarned(oneLink(inertial("1", "-1e-4")), 3, "is negative", "-0.0001 1 1");
  // Moments below m (eps |c|)^2 are those of a point mass.
  const auto point = [](const std::string& ixz) {
    return oneLink("<inertial><origin xyz='0.1 0 0'/><mass value='1'/><inertia ixx='0' ixy='0' ixz='" + ixz +
                   "' iyy='0' iyz='0' izz='0'/></inertial>");
  };
  for (const std::string& warning : loadUrdfText(point("2e-35"), {.root = RootJoint::FreeFlyer}).warnings)
    EXPECT_FALSE(has(warning, "negative"));
  expectWarned(point("2e-33"), 3, energy, "-2e-33 0 2e-33");
}

const std::string three = "<robot name='r'>\n<link name='a'/>\n<link name='b'/>\n<link name='c'/>\n";

std::string mimicJoint(const std::string& name, const std::string& type, const std::string& parent,
                       const std::string& child, const std::string& primary) {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent + "'/><child link='" +
         child + "'/>" + limit +
         (primary.empty() ? "" : "<mimic joint='" + primary + "' multiplier='-2' offset='0.5'/>") +
         "</joint>\n";
}

const UrdfOptions tied = {.mimic = MimicJoints::Tied};

TEST(BadUrdf, AMimicOfNothingOfItselfOrOfAMimicIsRefusedIfTiedAndOtherwiseAWarning) {
  const auto text = [](const std::string& first, const std::string& second, const char* type = "revolute") {
    return three + mimicJoint("j", type, "a", "b", first) + mimicJoint("k", "revolute", "b", "c", second) +
           "</robot>";
  };
  const auto expectBoth = [](const std::string& bad, int line, const std::string& what,
                             const std::string& primary) {
    expectWarned(bad, line, what, primary);
    EXPECT_EQ(refusal<UrdfError>([&] { loadUrdfText(bad, tied, "bad.urdf"); }),
              "bad.urdf:" + std::to_string(line) + ": " + what + " (" + primary + ")");
  };
  expectBoth(text("", "nobody"), 6, "joint 'k' mimics a joint that does not exist", "nobody");
  expectBoth(text("", "k"), 6, "joint 'k' mimics itself", "k");
  expectBoth(text("", "j", "fixed"), 6, "joint 'k' mimics a joint that does not move", "j");
  expectBoth(text("", "j", "floating"), 6,
             "joint 'k' mimics a joint that does not have exactly one degree of freedom", "j");
  std::string chained = text("", "j");
  chained.insert(chained.find("</robot>"), "<link name='d'/>" + mimicJoint("l", "revolute", "c", "d", "k"));
  expectBoth(chained, 7, "joint 'l' mimics a joint that is a mimic itself", "k");
  EXPECT_NO_THROW(loadUrdfText(text("k", "")));
  EXPECT_THROW(loadUrdfText(text("k", ""), tied), UrdfError);
}

TEST(Urdf, AMimicOfALaterJointFollowsIt) {
  // The tree is j: a - b, with k: b - c below it, and l: a - d. j follows l, which comes later.
  const std::string text = three + "<link name='d'/>" + mimicJoint("j", "revolute", "a", "b", "l") +
                           mimicJoint("k", "prismatic", "b", "c", "") +
                           mimicJoint("l", "revolute", "a", "d", "") + "</robot>";
  EXPECT_EQ(loadUrdfText(text).model.names, (std::vector<std::string>{"universe", "j", "k", "l"}));
  const Model<double> m = loadUrdfText(text, tied).model;
  EXPECT_EQ(m.names, (std::vector<std::string>{"universe", "l", "j", "k"}));
  EXPECT_EQ(m.parents, (std::vector<int>{0, 0, 0, 2}));
  EXPECT_EQ(m.nv, 2);
  EXPECT_EQ(m.idx_vs[2], m.idx_vs[1]);
  EXPECT_EQ(m.frames[m.getFrameId("b")].parentJoint, 2);
}

TEST(Urdf, AMimicIsIndependentWithAWarningOrTiedIfRequested) {
  const std::string text = three + mimicJoint("j", "revolute", "a", "b", "") +
                           mimicJoint("k", "prismatic", "b", "c", "j") + "</robot>";
  const UrdfRobot free = loadUrdfText(text, {}, "r.urdf"), follows = loadUrdfText(text, tied);
  EXPECT_EQ(free.model.nv, 2);
  EXPECT_EQ(free.warnings[0], "r.urdf:6: joint 'k' is a mimic and is treated as independent (j)");
  EXPECT_EQ(follows.model.nv, 1);
  const auto& mimic = std::get<Mimic<double>>(follows.model.joints[2]);
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
    EXPECT_EQ(refusal<UrdfError>([&] { loadUrdfText(text, {.strict = true}, "r.urdf"); }),
              r.warnings.front());
    return r.warnings.front();
  };
  EXPECT_EQ(warned("planar", "<axis xyz='0 1 0'/>"),
            "r.urdf:4: joint 'j' is planar and its axis is ignored: it moves in its x y plane (0 1 0)");
  EXPECT_EQ(warned("floating", "<axis xyz='0 1 0'/>"),
            "r.urdf:4: joint 'j' is floating and its axis is ignored (0 1 0)");
  EXPECT_EQ(warned("floating", "<dynamics damping='1'/>"),
            "r.urdf:4: joint 'j': its <dynamics> is ignored (floating)");
  EXPECT_TRUE(
      has(warned("continuous", "<limit lower='-1' upper='1' effort='1' velocity='1'/>"), "position limits"));
}

}  // namespace
