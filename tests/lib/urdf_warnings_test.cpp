// urdf/urdf.hpp, markup.hpp: what is accepted with a warning, and refused if strict.

#include <gtest/gtest.h>

#include "urdf_texts.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

TEST(UrdfWarnings, AMisspeltAttributeIsNamedWithTheNearestWord) {
  expectWarned(twoLinks("fixed", "\n<origin xzy='1 2 3'/>"), 5,
               "an unknown attribute of <origin> is ignored, the nearest are 'rpy' and 'xyz'", "xzy='1 2 3'");
  expectWarned(twoLinks("continuous", "\n<axis xzy='0 0 1'/>"), 5,
               "an unknown attribute of <axis> is ignored, the nearest is 'xyz'", "xzy='0 0 1'");
  expectWarned(twoLinks("continuous", "\n<axis xzy='0 0 1'/>"), 5, "<axis> xyz is missing and is taken as",
               "1 0 0");
  expectWarned(twoLinks("continuous", "\n<dynamics dampin='2'/>"), 5,
               "an unknown attribute of <dynamics> is ignored, the nearest are 'damping'", "dampin='2'");
  expectWarned(oneLink("<inertial><mass valu='3' value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' "
                       "izz='1' iyx='4'/></inertial>"),
               3, "an unknown attribute of <inertia> is ignored, the nearest are 'ixx'", "iyx='4'");
  expectWarned("<robot name='r'>\n<link name='a' colour='red'/></robot>", 2,
               "an unknown attribute of <link> is ignored, the nearest is 'name'", "colour='red'");
}

TEST(UrdfWarnings, AMisspeltElementIsNamedWithTheNearestWord) {
  expectWarned(twoLinks("revolute", "\n<limits lower='-1' upper='1' effort='1' velocity='1'/>"), 5,
               "an unknown element in <joint> is ignored, the nearest are 'limit'", "limits");
  expectWarned(oneLink("<inertail/>"), 3,
               "an unknown element in <link> is ignored, the nearest are 'inertial'", "inertail");
  expectWarned("<robot name='r'><link name='a'/>\n<jiont/></robot>", 2,
               "an unknown element in <robot> is ignored, the nearest are 'joint'", "jiont");
  expectWarned(oneLink("<visual><origins/></visual>"), 3, "in <visual> is ignored, the nearest are 'origin'",
               "origins");
}

TEST(UrdfWarnings, OnlyTheFirstOfTwoElementsIsReadAndTheSecondIsNamed) {
  const std::string text = twoLinks("prismatic", limit + "<axis xyz='0 1 0'/>\n<axis xyz='0 0 1'/>");
  expectWarned(text, 5, "a second <axis> in one <joint> is ignored, the first is in line 4", "j");
  EXPECT_EQ(shortname<double>(buildModelFromUrdfText(text).joints[1]), "JointModelPY");
  expectWarned(oneLink(inertial("1") + "\n" + inertial("2")), 4, "a second <inertial> in one <link>", "a");
}

TEST(UrdfWarnings, XacroThatIsNotExpandedIsNamed) {
  expectWarned("<robot name='r'><link name='a'/>\n<xacro:arm side='left'/></robot>", 2,
               "xacro that is not expanded", "xacro:arm");
  expectWarned("<robot name='r'>\n<link name='${prefix}a'/></robot>", 2, "xacro that is not expanded",
               "name='${prefix}a'");
  expectRefused(twoLinks("fixed", "\n<origin xyz='${x} 0 0'/>"), 5, "does not hold finite numbers",
                "${x} 0 0");
}

TEST(UrdfWarnings, TheWordsOfOtherProgramsAreNotNamed) {
  const UrdfRobot r = loadUrdfText(
      "<robot name='r' xmlns:drake='http://drake.mit.edu'><link name='a'><contact><stiffness value='1'/>"
      "</contact></link><gazebo><x y='z'/></gazebo><transmission name='t'/><drake:joint/>"
      "<ros2_control/><mujoco/><sensor/><collision_filter_group name='g'/><link name='b'/><joint name='j' "
      "type='fixed'><parent link='a'/><child link='b'/><controller_gains kp='1'/><traits/></joint></robot>");
  EXPECT_EQ(r.warnings, std::vector<std::string>());
}

TEST(UrdfWarnings, SoftLimitsAreNamedSinceTheModelHasNoPlaceForThem) {
  expectWarned(twoLinks("revolute", limit + "\n<safety_controller soft_lower_limit='-0.5' "
                                            "soft_upper_limit='0.5' k_velocity='1'/>"),
               5, "joint 'j': the soft limits of its <safety_controller> are ignored", "-0.5 0.5");
}

TEST(UrdfWarnings, NumbersWhoseSquareOverflowsOrUnderflowsAreNamed) {
  expectWarned(oneLink(inertial("1e308")), 3, "<mass> value is so large that its square overflows", "1e308");
  expectWarned(oneLink(inertial("1e-308", "1")), 3, "has a mass so small that its square underflows",
               "1e-308");
  expectWarned(twoLinks("fixed", "\n<origin xyz='0 1e200 0'/>"), 5, "<origin> xyz is so large", "0 1e200 0");
}

TEST(UrdfWarnings, AJointThatMovesNoInertiaIsNamed) {
  expectWarned(twoLinks("continuous", ""), 4, "have no mass", "j");
  // A point on the axis of a joint: its mass matrix is 0.
  const auto text = [](const std::string& xyz) {
    std::string t = twoLinks("continuous", "<axis xyz='0 0 1'/>");
    const std::string link = "<link name='b'/>";
    return t.replace(t.find(link), link.size(),
                     "<link name='b'><inertial><origin xyz='" + xyz +
                         "'/><mass value='1'/><inertia ixx='0' ixy='0' ixz='0' iyy='0' iyz='0' izz='0'/>"
                         "</inertial></link>");
  };
  expectWarned(text("0 0 1"), 4, "no inertia resists this joint at the neutral configuration", "j", {});
  EXPECT_EQ(loadUrdfText(text("0.1 0 1")).warnings, std::vector<std::string>());
}

}  // namespace
