// urdf/urdf.hpp. Rows S2 to S5, S21: what a good file becomes, and what is said of a bad one.

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <clocale>
#include <filesystem>
#include <fstream>
#include <liecheck/multibody/configuration.hpp>
#include <liecheck/urdf/urdf.hpp>
#include <locale>

namespace {

using namespace liecheck;
using V3 = Vector3<double>;
using M3 = Matrix3<double>;

std::string fixture(const std::string& name) {
  return std::string(LIECHECK_FIXTURES) + "/robots/" + name;
}

/// Lines 2 to 5: two links a and b and the joint j between them, of that type, with those elements in line 4.
std::string twoLinks(const std::string& type, const std::string& elements) {
  return "<robot name='two'>\n<link name='a'/>\n<link name='b'/>\n<joint name='j' type='" + type +
         "'><parent link='a'/><child link='b'/>" + elements + "</joint>\n</robot>\n";
}
const std::string limit = "<limit lower='-1' upper='1' effort='1' velocity='1'/>";

/// Line 3 is inside link a.
std::string oneLink(const std::string& inside) {
  return "<robot name='one'>\n<link name='a'>\n" + inside + "\n</link>\n</robot>\n";
}
std::string inertial(const std::string& mass, const std::string& ixx = "1") {
  return "<inertial><mass value='" + mass + "'/><inertia ixx='" + ixx +
         "' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>";
}

/// What is said of a bad text; fails if nothing is.
std::string refusal(const std::string& text, RootJoint root = RootJoint::Fixed) {
  testing::internal::CaptureStderr();
  std::string said;
  try {
    buildModelFromUrdfText(text, root, "bad.urdf");
    ADD_FAILURE() << "nothing was refused in\n" << text.substr(0, 500);
  } catch (const UrdfError& e) {
    said = e.what();
    EXPECT_EQ(e.file(), "bad.urdf");
    EXPECT_EQ(said.rfind("bad.urdf:" + std::to_string(e.line()) + ": ", 0), 0U) << said;
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  return said;
}
/// It is refused in that line, the words are said, and the value stands at the end in brackets.
void expectRefused(const std::string& text, int line, const std::string& words, const std::string& value) {
  const std::string said = refusal(text);
  EXPECT_EQ(said.rfind("bad.urdf:" + std::to_string(line) + ": ", 0), 0U) << said;
  EXPECT_NE(said.find(words), std::string::npos) << said;
  EXPECT_TRUE(said.ends_with("(" + value + ")")) << said;
}

// S3: names, indices and types can be listed; children come in alphabetical order, depth first.
TEST(Urdf, ARobotOfEveryJointTypeIsReadInAlphabeticalOrderDepthFirst) {
  const Model<double> m = buildModelFromUrdf(fixture("mixed_joints.urdf"), RootJoint::FreeFlyer);
  EXPECT_EQ(m.name, "mixed_joints");
  EXPECT_EQ(m.names, (std::vector<std::string>{"universe", "root_joint", "arm_turn", "elbow", "wrist",
                                               "mast_slide", "radar_turn", "tail_slide"}));
  EXPECT_EQ(m.parents, (std::vector<int>{0, 0, 1, 2, 3, 1, 1, 6}));
  std::vector<std::string> types;
  for (const auto& joint : m.joints) types.push_back(shortname<double>(joint));
  EXPECT_EQ(types, (std::vector<std::string>{"universe", "JointModelFreeFlyer", "JointModelRUBZ",
                                             "JointModelRY", "JointModelRevoluteUnaligned", "JointModelPZ",
                                             "JointModelRevoluteUnboundedUnaligned", "JointModelPX"}));
}

// S5
TEST(Urdf, BehindABaseAndAContinuousJointTheOffsetsInQAndVDriftApart) {
  const Model<double> m = buildModelFromUrdf(fixture("mixed_joints.urdf"), RootJoint::FreeFlyer);
  EXPECT_EQ(m.idx_qs, (std::vector<int>{0, 0, 7, 9, 10, 11, 12, 14}));
  EXPECT_EQ(m.idx_vs, (std::vector<int>{0, 0, 6, 7, 8, 9, 10, 11}));
  EXPECT_EQ(m.nq, 15);
  EXPECT_EQ(m.nv, 12);
  const Model<double> quadruped = buildModelFromUrdf(fixture("quadruped.urdf"), RootJoint::FreeFlyer);
  EXPECT_EQ(quadruped.nq, 7 + 12);
  EXPECT_EQ(quadruped.nv, 6 + 12);
  EXPECT_EQ(quadruped.names[2], "front_left_hip");
  EXPECT_EQ(quadruped.idx_qs[2], 7);
  EXPECT_EQ(quadruped.idx_vs[2], 6);
}

TEST(Urdf, WithoutARootJointTheRootLinkIsWeldedToTheUniverse) {
  const Model<double> m = buildModelFromUrdf(fixture("mixed_joints.urdf"));
  EXPECT_EQ(m.nq, 8);
  EXPECT_EQ(m.nv, 6);
  EXPECT_EQ(m.inertias[0].mass(), 6);
  EXPECT_EQ(m.frames[1].name, "base");
  EXPECT_EQ(m.frames[1].parentJoint, 0);
}

// S2
TEST(Urdf, AFixedJointIsTwoFramesAndItsInertiaIsMergedIntoTheSupportingJoint) {
  const Model<double> m = buildModelFromUrdf(fixture("mixed_joints.urdf"), RootJoint::FreeFlyer);
  const int mast = m.getJointId("mast_slide");
  EXPECT_EQ(m.getJointId("camera_mount"), m.njoints);
  const Frame<double>& mount = m.frames[m.getFrameId("camera_mount")];
  const Frame<double>& camera = m.frames[m.getFrameId("camera")];
  EXPECT_EQ(mount.type, FrameType::FIXED_JOINT);
  EXPECT_EQ(camera.type, FrameType::BODY);
  EXPECT_EQ(mount.parentJoint, mast);
  EXPECT_EQ(camera.parentJoint, mast);
  EXPECT_EQ(m.frames[mount.parentFrame].name, "mast");
  EXPECT_EQ(m.frames[camera.parentFrame].name, "camera_mount");
  EXPECT_EQ(camera.placement.translation(), V3(0.1, 0, 0.5));
  // mast 1.5 kg at (0, 0, 0.25); camera 0.5 kg at (0.1, 0.2, 0.5), turned 90 degrees about z.
  const Inertia<double>& I = m.inertias[mast];
  EXPECT_EQ(I.mass(), 2);
  EXPECT_LE((I.lever() - V3(0.025, 0.05, 0.3125)).norm(), 2 * eps<double>());
  const double reduced = 0.375;
  const V3 d(0.1, 0.2, 0.25);
  const M3 expected = M3(V3(0.03 + 0.002, 0.03 + 0.001, 0.004 + 0.003).asDiagonal()) +
                      reduced * (d.squaredNorm() * M3::Identity() - d * d.transpose());
  EXPECT_LE((I.inertia() - expected).norm(), 4 * eps<double>() * expected.norm());
}

TEST(Urdf, FramesAreTheUniverseThenAJointAndABodyForEachJoint) {
  const Model<double> m = buildModelFromUrdf(fixture("mixed_joints.urdf"), RootJoint::FreeFlyer);
  std::vector<std::string> names;
  for (const auto& frame : m.frames) names.push_back(frame.name);
  EXPECT_EQ(names, (std::vector<std::string>{"universe", "root_joint", "base", "arm_turn", "arm", "elbow",
                                             "forearm", "wrist", "hand", "mast_slide", "mast", "camera_mount",
                                             "camera", "radar_turn", "radar", "tail_slide", "tail"}));
  EXPECT_EQ(m.frames[3].parentFrame, 2);
  EXPECT_EQ(m.frames[4].parentFrame, 3);
  EXPECT_EQ(m.frames[9].parentFrame, 2);
}

TEST(Urdf, PlacementsAreFixedAxisRollPitchYaw) {
  const Model<double> m = buildModelFromUrdf(fixture("mixed_joints.urdf"), RootJoint::FreeFlyer);
  const SE3<double>& X = m.jointPlacements[2];
  const double c = std::cos(0.3), s = std::sin(0.3);
  EXPECT_EQ(X.translation(), V3(0.25, 0, 0.1));
  EXPECT_LE((X.rotation() - (M3() << c, 0, s, 0, 1, 0, -s, 0, c).finished()).norm(), 4 * eps<double>());
  // rpy = (90, 0, 90) degrees: first about x, then about the fixed z.
  const Model<double> two = buildModelFromUrdfText(
      twoLinks("fixed", "<origin xyz='1 2 3' rpy='1.5707963267948966 0 1.5707963267948966'/>"));
  const SE3<double>& Y = two.frames[two.getFrameId("b")].placement;
  EXPECT_LE((Y.rotation() - (M3() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished()).norm(), 4 * eps<double>());
}

TEST(Urdf, TheInertiaOfALinkIsTurnedIntoItsAxes) {
  const Model<double> m = buildModelFromUrdfText(
      oneLink("<inertial><origin xyz='1 2 3' rpy='0 0 1.5707963267948966'/><mass value='2'/>"
              "<inertia ixx='1' ixy='0' ixz='0' iyy='2' iyz='0' izz='2.5'/></inertial>"),
      RootJoint::FreeFlyer);
  EXPECT_EQ(m.inertias[1].lever(), V3(1, 2, 3));
  EXPECT_LE((m.inertias[1].inertia() - M3(V3(2, 1, 2.5).asDiagonal())).norm(), 8 * eps<double>());
}

TEST(Urdf, AFloatingJointIsAFreeFlyer) {
  const Model<double> m = buildModelFromUrdfText(twoLinks("floating", ""));
  EXPECT_EQ(m.nq, 7);
  EXPECT_EQ(m.nv, 6);
  EXPECT_EQ(shortname<double>(m.joints[1]), "JointModelFreeFlyer");
  EXPECT_EQ(neutral(m)[6], 1);
}

// S4
TEST(Urdf, UnknownNamesAreNjointsAndNframes) {
  const Model<double> m = buildModelFromUrdf(fixture("quadruped.urdf"), RootJoint::FreeFlyer);
  EXPECT_EQ(m.getJointId("fifth_leg"), 14);
  EXPECT_EQ(m.getFrameId("fifth_leg"), m.nframes);
}

/// A locale whose decimal point is a comma, for C and C++ alike.
struct Comma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
};
TEST(Urdf, NumbersHaveAPointWhateverTheLocale) {
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE"})
    if (std::setlocale(LC_ALL, name)) break;
  const Model<double> m = buildModelFromUrdf(fixture("mixed_joints.urdf"), RootJoint::FreeFlyer);
  std::locale::global(before);
  std::setlocale(LC_ALL, "C");
  EXPECT_EQ(m.jointPlacements[2].translation(), V3(0.25, 0, 0.1));
  EXPECT_EQ(m.inertias[2].mass(), 1.2);
}

TEST(BadUrdf, AMissingFileADirectoryAndAnEmptyFileAreNamed) {
  const auto said = [](const std::string& path) {
    try {
      buildModelFromUrdf(path);
    } catch (const UrdfError& e) {
      return std::string(e.what());
    }
    return std::string("nothing");
  };
  EXPECT_EQ(said("/nowhere/robot.urdf"), "/nowhere/robot.urdf: cannot be opened (No such file or directory)");
  const std::string folder = std::filesystem::temp_directory_path().string();
  EXPECT_EQ(said(folder), folder + ": cannot be read (a directory)");
  const std::string path = folder + "/liecheck_empty_" + std::to_string(::getpid()) + ".urdf";
  std::ofstream(path).close();
  EXPECT_EQ(said(path), path + ":1: empty (0 bytes)");
  std::filesystem::remove(path);
  expectRefused(" \n\t\n", 1, "empty", "4 bytes");
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  EXPECT_EQ(said(path), path + ": cannot be read (a pipe, and nobody writes to it)");
  std::filesystem::remove(path);
  EXPECT_EQ(said("/dev/null"), "/dev/null: cannot be read (neither a regular file nor a pipe)");
  std::ofstream(path).close();
  std::filesystem::resize_file(path, max_urdf_bytes + 1);
  EXPECT_EQ(said(path), path + ": longer than a URDF may be (67108864 bytes)");
  std::filesystem::remove(path);
}
TEST(BadUrdf, CutOffOrMalformedTextIsRefused) {
  const std::string whole = twoLinks("fixed", "");
  EXPECT_NO_THROW(buildModelFromUrdfText(whole));
  for (std::size_t size = 1; size + 9 < whole.size(); ++size) refusal(whole.substr(0, size));
  expectRefused("<robot name='r'>\n<link name='a'>\n</robot>", 3, "malformed XML", "Error reading end tag.");
  EXPECT_NE(refusal("<robot name='r'>\n<link name=a/></robot>").find("malformed"), std::string::npos);
  refusal("not XML at all");
  expectRefused(std::string("<robot name='r'>\n<link name='a'/>\0</robot>", 43), 2, "zero byte", "byte 33");
  expectRefused("<robot name='r'><link name='a'/></robot>\n<robot name='s'/>", 2, "a second root element",
                "robot");
  expectRefused("<robot name='r'><link name='a'/></robot>\nand more", 2, "text outside the root element",
                "and more");
}
TEST(BadUrdf, SomethingThatIsNoRobotIsRefused) {
  expectRefused("\n<sdf name='r'/>", 2, "expected <robot>", "sdf");
  expectRefused("<!-- nothing -->", 1, "no element", "");
  expectRefused("<robot><link name='a'/></robot>", 1, "a robot without a name", "");
  expectRefused("<robot name='r'>\n</robot>", 1, "a robot without links", "r");
  expectRefused("<robot name='r'>\n<link/></robot>", 2, "a link without a name", "");
}
TEST(BadUrdf, AnUnknownJointTypeIsNamed) {
  expectRefused(twoLinks("wobbly", ""), 4, "joint 'j': unknown joint type", "wobbly");
  std::string untyped = twoLinks("fixed", "");
  untyped.erase(untyped.find(" type='fixed'"), 13);
  expectRefused(untyped, 4, "joint 'j' has no type", "");
}
TEST(BadUrdf, AZeroOrNonFiniteAxisIsRefused) {
  for (const char* type : {"revolute", "continuous", "prismatic"}) {
    expectRefused(twoLinks(type, limit + "<axis xyz='0 0 -0.0'/>"), 4, "zero axis", "0 0 -0.0");
    expectRefused(twoLinks(type, limit + "<axis xyz='0 inf 0'/>"), 4, "not finite numbers", "0 inf 0");
    expectRefused(twoLinks(type, limit + "<axis xyz='0 nan 0'/>"), 4, "not finite numbers", "0 nan 0");
    expectRefused(twoLinks(type, limit + "<axis/>"), 4, "<axis> xyz is missing", "");
  }
}
TEST(BadUrdf, NumbersThatAreNoneOrNotFiniteAreRefusedInTheirLine) {
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
  EXPECT_NO_THROW(buildModelFromUrdfText(oneLink(inertial("+1.5e0", " 2 "))));
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
  expectRefused(universe.replace(universe.find("'j'"), 3, "'universe'"), 4, "own root", "universe");
  std::string root = twoLinks("fixed", "");
  root.replace(root.find("'j'"), 3, "'root_joint'");
  EXPECT_NO_THROW(buildModelFromUrdfText(root));
  EXPECT_NE(refusal(root, RootJoint::FreeFlyer).find("own root"), std::string::npos);
}
TEST(BadUrdf, AMissingLimitIsRefusedWhereTheTypeNeedsOne) {
  expectRefused(twoLinks("revolute", ""), 4, "no <limit>", "revolute");
  EXPECT_NO_THROW(buildModelFromUrdfText(twoLinks("continuous", "")));
}
TEST(BadUrdf, TooDeepNestingIsRefusedBeforeAnyParserRecurses) {
  std::string deep = "<robot name='r'>\n<link name='a'>\n";
  for (int i = 0; i < 1000000; ++i) deep += "<x>";
  expectRefused(deep, 3, "nested too deep", "more than 64");
}
TEST(BadUrdf, APipeIsReadOnce) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const std::string text = twoLinks("fixed", "");
  ASSERT_EQ(::write(ends[1], text.data(), text.size()), ssize_t(text.size()));
  ::close(ends[1]);
  EXPECT_EQ(readUrdf("/proc/self/fd/" + std::to_string(ends[0])), text);
  ::close(ends[0]);
}
TEST(BadUrdf, TextThatIsNotUtf8IsRefusedInItsLine) {
  for (const char* bad : {"\xff", "\x80", "\xc3", "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe2\x82"})
    EXPECT_EQ(refusal("<robot name='r'>\n<link name='" + std::string(bad) + "'/></robot>")
                  .rfind("bad.urdf:2: not UTF-8", 0),
              0U);
  EXPECT_NO_THROW(
      buildModelFromUrdfText("<robot name='\xc3\xa9\xe2\x82\xac\xf0\x9f\xa4\x96'><link name='a'/></robot>"));
}
TEST(BadUrdf, TagsThatCloseNothingAndEntitiesAreNamed) {
  const std::string robot = "<robot name='r'>\n<link name='a'/></robot>\n";
  expectRefused(robot + "</robot></robot>", 3, "closed that was not opened", "</robot>");
  expectRefused("</robot>" + robot, 1, "closed that was not opened", "</robot>");
  expectRefused("<!DOCTYPE robot [<!ENTITY x 'y'>]>\n" + robot, 1, "(entities) is not supported",
                "[<!ENTITY x 'y'");
  EXPECT_NO_THROW(buildModelFromUrdfText("<!DOCTYPE robot>\n" + robot));
}
TEST(BadUrdf, WhatUrdfdomDislikesInAJointIsNamedWithItsLine) {
  expectRefused(twoLinks("continuous", "\n<mimic/>"), 5, "joint 'j' has a <mimic> that names no joint", "");
  expectRefused(twoLinks("continuous", "\n<calibration rising='x'/>"), 5, "<calibration> rising", "x");
  expectRefused(twoLinks("continuous", "\n<safety_controller k_velocity='nan'/>"), 5, "k_velocity", "nan");
  expectRefused(twoLinks("continuous", "\n<safety_controller/>"), 5,
                "<safety_controller> k_velocity is missing", "");
  expectRefused(twoLinks("continuous", "\n<dynamics/>"), 5, "<dynamics> without damping", "");
}
TEST(BadUrdf, AMessageIsOneShortLine) {
  const std::string said = refusal(twoLinks(std::string(1000, 'x'), ""));
  EXPECT_LT(said.size(), 160U) << said;
  EXPECT_NE(refusal("<robot name='r'>\n<link name='a'/></robot>\nsome\nmore").find("(some more)"),
            std::string::npos);
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
TEST(BadUrdf, AnInertiaThatNoBodyHasIsRefusedUnlessWhatItIsFixedToMakesUpForIt) {
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
      "r.urdf:3: link 'b': a principal moment of inertia is larger than the sum of the other two; what it is "
      "fixed to makes up for it (1 1 2.1)");
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
  expectRefused(text("", "j", "floating"), 6, "mimics a joint that has not one coordinate", "j");
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

TEST(Urdf, AMimicIsIndependentWithAWarningOrTiedIfAskedFor) {
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
TEST(Urdf, LimitsDampingAndFrictionAreThoseOfTheModel) {
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
TEST(Urdf, WhatAJointTypeHasNoUseForIsWarnedOfAndStrictlyAnError) {
  const auto warned = [](const std::string& type, const std::string& elements) {
    const std::string text = twoLinks(type, elements);
    const UrdfRobot r = loadUrdfText(text, {}, "r.urdf");
    EXPECT_EQ(r.warnings.size(), 2U);  // and of the link without mass
    EXPECT_EQ(r.warnings.back(),
              "r.urdf:4: the link of a moving joint, and what is fixed to it, has no mass (j)");
    try {
      loadUrdfText(text, {.strict = true}, "r.urdf");
      ADD_FAILURE() << "strictly nothing was refused";
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
TEST(Urdf, ARootJointOfAnyTypeAndAPlanarJoint) {
  const std::string text = twoLinks("planar", "<axis xyz='0 0 1'/>");
  const UrdfRobot r = loadUrdfText(text, {.root_joint = Joint<double>(Spherical<double>())});
  EXPECT_EQ(r.model.nq, 4 + 4);
  EXPECT_EQ(r.model.nv, 3 + 3);
  EXPECT_EQ(r.model.names[1], "root_joint");
  EXPECT_EQ(shortname<double>(r.model.joints[2]), "JointModelPlanar");
}
TEST(Urdf, AChainOfTenThousandJointsLoadsAndAStarOfThem) {
  std::string chain = "<robot name='r'><link name='l0'/>\n", star = chain;
  for (int i = 0; i < 10000; ++i) {
    const std::string b = std::to_string(i + 1), link = "<link name='l" + b + "'/><joint name='j" + b +
                                                        "' type='continuous'><child link='l" + b +
                                                        "'/><parent link='l";
    chain += link + std::to_string(i) + "'/></joint>\n";
    star += link + "0'/></joint>\n";
  }
  const Model<double> m = buildModelFromUrdfText(chain + "</robot>"),
                      n = buildModelFromUrdfText(star + "</robot>");
  EXPECT_EQ(m.njoints, 10001);
  EXPECT_EQ(m.parents[10000], 9999);
  EXPECT_EQ(n.nq, 20000);
  EXPECT_EQ(n.parents[10000], 0);
}

}  // namespace
