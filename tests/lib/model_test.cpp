// multibody/model.hpp, joint.hpp, frame.hpp.

#include <gtest/gtest.h>

#include <liecheck/multibody/configuration.hpp>

#include "random_tree.hpp"
#include "../refusal.hpp"

namespace {

using namespace liecheck;
using test::at, test::has, test::refusal;
using V3 = Vector3<double>;
using M3 = Matrix3<double>;

const SE3<double> origin = SE3<double>::Identity();

/// universe - root (free-flyer) - wheel (continuous) - arm (revolute); rail (prismatic) on root.
Model<double> robot() {
  Model<double> m;
  m.name = "robot";
  const int root = m.addJoint(0, FreeFlyer<double>(), origin, "root");
  const int wheel = m.addJoint(root, Continuous<double>(Axis<double>::Y()), at(1, 0, 0), "wheel");
  m.addJoint(wheel, Revolute<double>(Axis<double>::Z()), at(0, 2, 0), "arm");
  m.addJoint(root, Prismatic<double>(V3(0, 3, 4)), at(0, 0, 3), "rail");
  return m;
}

TEST(Model, AnEmptyModelHasOnlyTheUniverse) {
  const Model<double> m;
  EXPECT_EQ(m.njoints, 1);
  EXPECT_EQ(m.nframes, 1);
  EXPECT_EQ(m.nq, 0);
  EXPECT_EQ(m.nv, 0);
  EXPECT_EQ(m.names[0], "universe");
  EXPECT_EQ(m.frames[0].name, "universe");
  EXPECT_EQ(shortname<double>(m.joints[0]), "universe");
  EXPECT_EQ(neutral(m).size(), 0);
}

TEST(Model, AfterTheBaseTheOffsetsInQAndVDiffer) {
  const Model<double> m = robot();
  EXPECT_EQ(m.nq, 11);
  EXPECT_EQ(m.nv, 9);
  EXPECT_EQ(m.idx_qs, (std::vector<int>{0, 0, 7, 9, 10}));
  EXPECT_EQ(m.idx_vs, (std::vector<int>{0, 0, 6, 7, 8}));
  EXPECT_EQ(m.nqs, (std::vector<int>{0, 7, 2, 1, 1}));
  EXPECT_EQ(m.nvs, (std::vector<int>{0, 6, 1, 1, 1}));
  EXPECT_EQ(m.parents, (std::vector<int>{0, 0, 1, 2, 1}));
  EXPECT_EQ(m.jointPlacements[3].translation(), V3(0, 2, 0));
}

TEST(Model, ANewJointHasNoInertia) {
  const Model<double> m = robot();
  EXPECT_EQ(m.inertias[2].mass(), 0);
  EXPECT_EQ(m.inertias[2].inertia(), M3(M3::Zero()));
}

TEST(Model, TheIdOfAnUnknownJointIsNjointsAndOfAnUnknownFrameNframes) {
  Model<double> m = robot();
  m.addJointFrame(1);
  EXPECT_EQ(m.getJointId("nobody"), m.njoints);
  EXPECT_EQ(m.getFrameId("nobody"), m.nframes);
  EXPECT_EQ(m.getFrameId("root", FrameType::BODY), m.nframes);
  EXPECT_FALSE(m.existJointName("nobody"));
  EXPECT_FALSE(m.existFrame("nobody"));
  EXPECT_EQ(m.getJointId("arm"), 3);
  EXPECT_EQ(m.getFrameId("root"), 1);
  EXPECT_TRUE(m.existJointName("arm"));
  EXPECT_TRUE(m.existFrame("root"));
  EXPECT_TRUE(m.existFrame("root", FrameType::JOINT));
}

TEST(Model, DuplicatesAndBadParentsAreRefusedByName) {
  Model<double> m = robot();
  const Joint<double> j = FreeFlyer<double>();
  EXPECT_TRUE(has(refusal([&] { m.addJoint(0, j, origin, "wheel"); }), "'wheel'"));
  for (const int parent : {-1, 5}) {
    const std::string number = std::to_string(parent);
    EXPECT_TRUE(has(refusal([&] { m.addJoint(parent, j, origin, "new"); }), "'new' is joint " + number));
    EXPECT_TRUE(has(refusal([&] { m.addBodyFrame("body", parent); }), "'body' is joint " + number));
    EXPECT_TRUE(has(refusal([&] { m.addJointFrame(parent); }), "joint " + number));
    EXPECT_TRUE(
        has(refusal([&] { m.appendBodyToJoint(parent, Inertia<double>::Zero()); }), "joint " + number));
  }
  EXPECT_TRUE(has(refusal([&] {
                    m.addFrame({"tool", 1, 7, origin, FrameType::OP_FRAME});
                  }),
                  "'tool' is frame 7"));
  EXPECT_TRUE(has(refusal([&] { m.addFrame({"tool", 1, -1, origin, FrameType::OP_FRAME}); }), "frame -1"));
  EXPECT_TRUE(has(refusal([&] { m.addJoint(0, Universe<double>(), origin, "u"); }), "second universe"));
  EXPECT_TRUE(has(refusal([&] { m.addBodyFrame("body", 1); }), "'root' has no frame yet"));
  EXPECT_TRUE(has(refusal([&] { m.addJointFrame(2); }), "'root' has no frame yet"));
  m.addJointFrame(1);
  m.addBodyFrame("body", 1);
  EXPECT_TRUE(has(refusal([&] { m.addBodyFrame("body", 1); }), "named 'body'"));
  EXPECT_EQ(m.njoints, 5);
  EXPECT_EQ(m.nframes, 3);
}

TEST(Model, TheParentOfAFrameIsTheFrameOfItsJointUnlessGiven) {
  Model<double> m = robot();
  const int root = m.addJointFrame(1);
  const int wheel = m.addJointFrame(2);
  const int body = m.addBodyFrame("wheel_body", 2, at(1, 2, 3));
  const int other = m.addBodyFrame("other", 2, at(0, 0, 0), body);
  EXPECT_EQ(m.frames[root].parentFrame, 0);
  EXPECT_EQ(m.frames[wheel].parentFrame, root);
  EXPECT_EQ(m.frames[body].parentFrame, wheel);
  EXPECT_EQ(m.frames[other].parentFrame, body);
  EXPECT_EQ(m.frames[body].parentJoint, 2);
  EXPECT_EQ(m.frames[body].placement.translation(), V3(1, 2, 3));
  EXPECT_EQ(m.frames[body].type, FrameType::BODY);
  EXPECT_EQ(m.frames[wheel].type, FrameType::JOINT);
  EXPECT_EQ(m.frames[wheel].name, "wheel");
}

TEST(Model, AFrameWhoseParentMovesWithAnotherJointIsRefused) {
  Model<double> m = robot();
  const int root = m.addJointFrame(1), wheel = m.addJointFrame(2), body = m.addBodyFrame("body", 1);
  const std::string on_root =
      "the parent of frame 'tool' is frame 'root' (frame 1), which moves with joint 'root', "
      "not with joint 'wheel'";
  EXPECT_EQ(refusal([&] { m.addFrame({"tool", 2, root, origin, FrameType::OP_FRAME}); }), on_root);
  EXPECT_EQ(refusal([&] { m.addBodyFrame("tool", 2, origin, root); }), on_root);
  EXPECT_EQ(refusal([&] { m.addFixedJoint("tool", 2, origin, root); }), on_root);
  EXPECT_TRUE(has(refusal([&] {
                    m.addFrame({"tool", 0, wheel, origin, FrameType::SENSOR});
                  }),
                  "moves with joint 'wheel', not with joint 'universe'"));
  // The frame of a joint hangs on its parent joint.
  EXPECT_TRUE(
      has(refusal([&] { m.addJointFrame(3, root); }), "moves with joint 'root', not with joint 'wheel'"));
  EXPECT_EQ(m.nframes, 4);
  EXPECT_EQ(m.addJointFrame(3, wheel), 4);
  EXPECT_EQ(m.addJointFrame(4, body), 5);
  EXPECT_EQ(m.addFrame({"tool", 2, wheel, origin, FrameType::OP_FRAME}), 6);
  EXPECT_EQ(m.addFrame({"tip", 2, 0, origin, FrameType::OP_FRAME}), 7);  // no parent stated
}

TEST(Model, APlacementThatIsNotAPoseIsRefused) {
  Model<double> m = robot();
  m.addJointFrame(1);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  M3 bent = M3::Identity();
  bent(0, 1) = 1e-7;
  const auto each = [&](const SE3<double>& X, const std::string& text) {
    const auto refused = [&](auto call, const std::string& what) {
      EXPECT_TRUE(has(refusal(call), what + text)) << refusal(call);
    };
    refused([&] { m.addJoint(1, FreeFlyer<double>(), X, "new"); }, "the placement of joint 'new': ");
    refused([&] { m.addBodyFrame("tool", 1, X); }, "the placement of frame 'tool': ");
    refused([&] { m.addFixedJoint("tool", 1, X); }, "the placement of frame 'tool': ");
    refused([&] { m.addFrame({"tool", 1, 0, X, FrameType::OP_FRAME}); }, "the placement of frame 'tool': ");
    refused([&] { m.appendBodyToJoint(2, Inertia<double>::Zero(), X); },
            "a body of joint 'wheel': its pose: ");
  };
  each(at(nan, 0, 0), "position = nan: not finite");
  each(at(0, -inf, 0), "position = -inf: not finite");
  each({M3(nan * M3::Identity()), V3(V3::Zero())}, "rotation = nan: not finite");
  each({M3(2 * M3::Identity()), V3(V3::Zero())}, "rotation: |R^T R - I| = 5.196");
  each({M3(-M3::Identity()), V3(V3::Zero())}, "rotation: determinant = -1");
  each({bent, V3(V3::Zero())}, "rotation: |R^T R - I| = 1.414");
  EXPECT_EQ(m.njoints, 5);
  EXPECT_EQ(m.nframes, 2);
  bent(0, 1) = 1e-9;  // typed with nine digits
  EXPECT_EQ(refusal([&] { m.addBodyFrame("tool", 1, {bent, V3(V3::Zero())}); }), "");
}

TEST(Model, ABodyThatIsNoneIsRefusedWithItsValueAndChangesNothing) {
  Model<double> m = robot();
  m.appendBodyToJoint(2, Inertia<double>(2, V3(0.5, 0, 0), V3(1, 2, 3).asDiagonal()));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  M3 crooked = M3::Identity();
  crooked(0, 1) = 0.25;
  const auto refused = [&](const Inertia<double>& I, const std::string& text) {
    EXPECT_EQ(refusal([&] { m.appendBodyToJoint(2, I, at(1, 2, 3)); }), "a body of joint 'wheel': " + text);
  };
  refused({-1, V3::Zero(), M3::Identity()}, "the mass is negative: -1");
  refused({1, V3::Zero(), crooked}, "the inertia is not symmetric: two products of inertia are 0 0.25");
  refused({nan, V3::Zero(), M3::Identity()}, "the mass is not finite: nan");
  refused({1, V3(0, nan, 0), M3::Identity()}, "the centre of mass is not finite: 0 nan 0");
  refused({1, V3::Zero(), M3(nan * M3::Identity())}, "a number of the inertia is not finite: nan");
  const std::string overflow = "its inertia and that of the others, about the joint's origin, overflow";
  refused({1e308, V3::Zero(), M3::Identity()}, overflow);  // 1e308 kg at (1, 2, 3)
  refused({1, V3(1e200, 0, 0), M3::Identity()}, overflow);
  EXPECT_EQ(m.inertias[2].mass(), 2);
  EXPECT_EQ(m.inertias[2].lever(), V3(0.5, 0, 0));
  EXPECT_EQ(m.inertias[2].inertia(), M3(V3(1, 2, 3).asDiagonal()));
  // Half a body: its moments are not checked, since only the sum of a joint's bodies must be physical.
  EXPECT_EQ(refusal([&] { m.appendBodyToJoint(2, {1, V3::Zero(), V3(3, 1, 1).asDiagonal()}); }), "");
}

TEST(Model, ANameThatAJointAndALinkShareNeedsAFrameType) {
  Model<double> m = robot();
  const int joint = m.addJointFrame(1);
  const int body = m.addBodyFrame("root", 1);
  EXPECT_EQ(m.getFrameId("root", FrameType::JOINT), joint);
  EXPECT_EQ(m.getFrameId("root", FrameType::BODY), body);
  EXPECT_TRUE(has(refusal([&] { m.getFrameId("root"); }), "'root'"));
}

TEST(Model, AppendBodyToJointTransformsTheInertiaOnce) {
  Model<double> m = robot();
  const M3 quarter = (M3() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished();
  const Inertia<double> body(2, V3(0.5, 0, 0), V3(1, 2, 3).asDiagonal());
  m.appendBodyToJoint(2, body, SE3<double>(quarter, V3(0, 0, 1)));
  EXPECT_EQ(m.inertias[2].mass(), 2);
  EXPECT_EQ(m.inertias[2].lever(), V3(0, 0.5, 1));
  EXPECT_EQ(m.inertias[2].inertia(), M3(V3(2, 1, 3).asDiagonal()));
  // 2 kg more, 1 m away along z: the reduced mass is 1 kg.
  m.appendBodyToJoint(2, Inertia<double>(2, V3(0, 0.5, 2), M3::Zero()));
  EXPECT_EQ(m.inertias[2].mass(), 4);
  EXPECT_EQ(m.inertias[2].lever(), V3(0, 0.5, 1.5));
  EXPECT_EQ(m.inertias[2].inertia(), M3(V3(3, 2, 3).asDiagonal()));
}

TEST(Model, RevisionChangesWithJointsFramesAndBodiesAndIsUnique) {
  Model<double> m = robot();
  const int before = m.revision;
  const Model<double> copy = m, other = robot();
  EXPECT_EQ(copy.revision, before);
  EXPECT_NE(other.revision, before);
  m.appendBodyToJoint(1, Inertia<double>(1, V3::Zero(), M3::Identity()));
  const int with_body = m.revision;
  EXPECT_NE(with_body, before);
  m.addJoint(1, FreeFlyer<double>(), origin, "another");
  const int with_joint = m.revision;
  EXPECT_NE(with_joint, with_body);
  m.addJointFrame(1);
  EXPECT_NE(m.revision, with_joint);
  EXPECT_NE(m.revision, before);
}

TEST(Model, CastKeepsStructureNamesAndEveryNumber) {
  Model<double> m = robot();
  m.addJointFrame(1);
  m.addBodyFrame("body", 1, at(0.1, 0.2, 0.3));
  m.appendBodyToJoint(1, Inertia<double>(0.3, V3(0.1, 0, 0), M3::Identity()));
  const Model<float> f = m.cast<float>();
  EXPECT_EQ(f.name, "robot");
  EXPECT_EQ(f.names, m.names);
  EXPECT_EQ(f.parents, m.parents);
  EXPECT_EQ(f.idx_qs, m.idx_qs);
  EXPECT_EQ(f.idx_vs, m.idx_vs);
  EXPECT_EQ(f.nqs, m.nqs);
  EXPECT_EQ(f.nvs, m.nvs);
  EXPECT_EQ(f.nq, m.nq);
  EXPECT_EQ(f.nv, m.nv);
  EXPECT_EQ(f.njoints, m.njoints);
  EXPECT_EQ(f.nframes, m.nframes);
  EXPECT_EQ(f.revision, m.revision);
  EXPECT_EQ(f.frames[2].name, "body");
  EXPECT_EQ(f.frames[2].placement.translation(), Vector3<float>(0.1F, 0.2F, 0.3F));
  EXPECT_EQ(f.inertias[1].mass(), 0.3F);
  EXPECT_EQ(f.jointPlacements[4].translation(), Vector3<float>(0, 0, 3));
  for (int i = 0; i < m.njoints; ++i)
    EXPECT_EQ(shortname<float>(f.joints[i]), shortname<double>(m.joints[i]));
  EXPECT_EQ(std::get<Prismatic<float>>(f.joints[4]).axis.to_vector(), Vector3<float>(0, 0.6F, 0.8F));
  EXPECT_EQ(f.cast<double>().frames.size(), m.frames.size());
}

TEST(Model, CastRefusesConstantsThatAreTooLargeForTheScalar) {
  const auto refused = [](auto change) {
    Model<double> m = robot();
    m.addJointFrame(1);
    change(m);
    return refusal([&] { m.cast<float>(); });
  };
  const std::string text = " is not finite in the new scalar";
  EXPECT_EQ(refused([](Model<double>& m) { m.upperPositionLimit.setConstant(1e300); }), "");
  EXPECT_EQ(refused([](Model<double>& m) {
              m.appendBodyToJoint(2, {1e50, V3::Zero(), M3::Zero()});
            }),
            "cast: the inertia of joint 'wheel'" + text);
  EXPECT_EQ(refused([](Model<double>& m) { m.addJoint(1, FreeFlyer<double>(), at(0, 1e40, 0), "far"); }),
            "cast: the placement of joint 'far'" + text);
  EXPECT_EQ(refused([](Model<double>& m) { m.addBodyFrame("far", 1, at(0, 1e40, 0)); }),
            "cast: the placement of frame 'far'" + text);
  EXPECT_EQ(refused([](Model<double>& m) { m.gravity.z() = -1e100; }), "cast: gravity" + text);
}

TEST(Model, AnUnknownRequiredNameIsRefusedWithTheNearestNames) {
  Model<double> m;
  for (const char* name : {"left_hip", "left_knee", "right_hip", "head"}) {
    m.addJoint(0, Revolute<double>(Axis<double>::X()), SE3<double>::Identity(), name);
    m.addJointFrame(m.njoints - 1);
  }
  EXPECT_EQ(m.requireJointId("head"), 4);
  EXPECT_EQ(refusal([&] { m.requireJointId("left_hop"); }),
            "no joint is named 'left_hop', the nearest are 'left_hip', 'left_knee' and 'right_hip'");
  EXPECT_TRUE(refusal([&] {
                m.requireFrameId("haed");
              }).starts_with("no frame is named 'haed', the nearest are 'head', "));
  m.addBodyFrame("head", 4);
  EXPECT_EQ(refusal([&] { m.requireFrameId("head"); }),
            "several frames are named 'head': give the type as well");
  EXPECT_EQ(m.getFrameId("head", FrameType::BODY), 5);
}
TEST(Model, LimitsAreInfiniteAndFrictionIsZeroByDefault) {
  const Model<double> m = test::randomModel(1, test::joint_kinds);
  EXPECT_EQ(m.effortLimit.size(), m.nv);
  EXPECT_EQ(m.upperPositionLimit.size(), m.nq);
  EXPECT_TRUE((m.lowerPositionLimit.array() == -INFINITY).all() &&
              (m.velocityLimit.array() == INFINITY).all());
  EXPECT_EQ(m.friction.norm() + m.damping.norm(), 0);
  EXPECT_EQ(m.gravity, V3(0, 0, -9.81));
  EXPECT_EQ(m.cast<float>().upperPositionLimit.size(), m.nq);
}

TEST(Joint, ShortnamesAreThoseOfPinocchio) {
  const V3 tilted(1, 1, 0);
  EXPECT_EQ(FreeFlyer<double>().shortname(), "JointModelFreeFlyer");
  EXPECT_EQ(Revolute<double>(V3::UnitX()).shortname(), "JointModelRX");
  EXPECT_EQ(Revolute<double>(V3::UnitY()).shortname(), "JointModelRY");
  EXPECT_EQ(Revolute<double>(V3::UnitZ()).shortname(), "JointModelRZ");
  EXPECT_EQ(Revolute<double>(tilted).shortname(), "JointModelRevoluteUnaligned");
  EXPECT_EQ(Revolute<double>(V3(-V3::UnitZ())).shortname(), "JointModelRevoluteUnaligned");
  EXPECT_EQ(Continuous<double>(V3::UnitX()).shortname(), "JointModelRUBX");
  EXPECT_EQ(Continuous<double>(tilted).shortname(), "JointModelRevoluteUnboundedUnaligned");
  EXPECT_EQ(Prismatic<double>(V3::UnitY()).shortname(), "JointModelPY");
  EXPECT_EQ(Prismatic<double>(tilted).shortname(), "JointModelPrismaticUnaligned");
}

TEST(Joint, ARotationAboutACoordinateAxisKeepsThatAxisBitForBit) {
  const Matrix3<double> R = Eigen::Quaterniond(0.1, -0.5, 0.7, 0.5).normalized().toRotationMatrix();
  const double angle = 2.3, c = std::cos(angle), s = std::sin(angle);
  for (int i = 0; i < 3; ++i)
    for (const double sign : {1.0, -1.0}) {
      const V3 direction = sign * V3::Unit(i);
      const Axis<double> axis(direction);
      EXPECT_EQ(axis.in(R), V3(sign * R.col(i))) << direction.transpose();
      EXPECT_EQ(axis.cast<float>().in(R.cast<float>()), Vector3<float>(V3(sign * R.col(i)).cast<float>()));
      const Matrix3<double> turned =
          axis.rotated(R, c, s);  // 3 eps here, 3 in Eigen's rotation, 2 in its product
      EXPECT_EQ(turned.col(i), R.col(i)) << direction.transpose();
      EXPECT_LE((turned - R * Eigen::AngleAxisd(angle, direction).toRotationMatrix()).norm(),
                8 * eps<double>())
          << direction.transpose();
    }
}

TEST(Joint, AnAxisIsNormalisedAndMustHaveADirection) {
  EXPECT_EQ(Axis<double>(V3(0, 0, 5)).aligned(), "Z");
  EXPECT_LE((Axis<double>(V3(3, 0, 4)).to_vector() - V3(0.6, 0, 0.8)).norm(), 2 * eps<double>());
  EXPECT_LE((Axis<double>(V3(3e-200, 0, 4e-200)).to_vector() - V3(0.6, 0, 0.8)).norm(), 2 * eps<double>());
  EXPECT_LE((Axis<double>(V3(3e200, 0, 4e200)).to_vector() - V3(0.6, 0, 0.8)).norm(), 2 * eps<double>());
  EXPECT_THROW(Axis<double>(V3(0, 0, 0)), std::invalid_argument);
  EXPECT_THROW(Axis<double>(V3(0, std::numeric_limits<double>::quiet_NaN(), 0)), std::invalid_argument);
  EXPECT_THROW(Axis<double>(V3(0, std::numeric_limits<double>::infinity(), 0)), std::invalid_argument);
}

}  // namespace
