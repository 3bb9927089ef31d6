// urdf/urdf.hpp: the model of a valid file.

#include <gtest/gtest.h>

#include <liecheck/multibody/configuration.hpp>

#include "urdf_texts.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

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

TEST(Urdf, AfterABaseAndAContinuousJointTheOffsetsInQAndVDiffer) {
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

TEST(Urdf, AFixedJointGivesTwoFramesAndItsInertiaIsMergedIntoTheSupportingJoint) {
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
  // mast 1.5 kg at (0, 0, 0.25); camera 0.5 kg at (0.1, 0.2, 0.5), rotated by 90 degrees about z.
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

TEST(Urdf, TheInertiaOfALinkIsRotatedIntoItsAxes) {
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

TEST(Urdf, ARootJointOfAnyTypeAndAPlanarJointAreBuilt) {
  const std::string text = twoLinks("planar", "<axis xyz='0 0 1'/>");
  const UrdfRobot r = loadUrdfText(text, {.root_joint = Joint<double>(Spherical<double>())});
  EXPECT_EQ(r.model.nq, 4 + 4);
  EXPECT_EQ(r.model.nv, 3 + 3);
  EXPECT_EQ(r.model.names[1], "root_joint");
  EXPECT_EQ(shortname<double>(r.model.joints[2]), "JointModelPlanar");
}

TEST(Urdf, AChainAndAStarOfTenThousandJointsLoad) {
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
