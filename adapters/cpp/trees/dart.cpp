// DART: its URDF reader, or skeletons that its programming interface makes of a list of joints; kinematics and dynamics
// of a Skeleton, in double. Twists are (angular, linear), and so are the velocities of a dynamics::FreeJoint, which are those of its
// body in its own axes. Links without an inertial get 1 kg from DART's reader unless its options say otherwise: here they
// say 0. Damping, springs and friction of joints are set to 0.

#include <dart/config.hpp>
#include <dart/dynamics/BallJoint.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/PrismaticJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/TranslationalJoint.hpp>
#include <dart/dynamics/WeldJoint.hpp>
#include <dart/utils/urdf/DartLoader.hpp>

#include "protocol.hpp"

namespace {

using namespace trees;
namespace dynamics = dart::dynamics;
using dynamics::BodyNode, dynamics::SkeletonPtr;
using Eigen::Isometry3d, Eigen::Vector6d;

Isometry3d placement(const Quaterniond& Q, const Vector3d& p) {
  Isometry3d X = Isometry3d::Identity();
  X.linear() = Q.toRotationMatrix(), X.translation() = p;
  return X;
}
template <class Kind>
BodyNode* add(const SkeletonPtr& skeleton, BodyNode* parent, const Joint& j) {
  typename Kind::Properties p;
  p.mName = j.name, p.mT_ParentBodyToJoint = placement(j.Q, j.p);
  if constexpr (requires { p.mAxis; }) p.mAxis = j.axis;
  return skeleton->createJointAndBodyNodePair<Kind>(parent, p).second;
}
SkeletonPtr built(const Robot& robot) {
  const SkeletonPtr skeleton = dynamics::Skeleton::create("robot");
  std::vector<BodyNode*> nodes;
  for (const Joint& j : robot.joints) {
    BodyNode* const parent = j.parent < 0 ? nullptr : nodes[static_cast<std::size_t>(j.parent)];
    nodes.push_back(j.kind == "prismatic"     ? add<dynamics::PrismaticJoint>(skeleton, parent, j)
                    : j.kind == "spherical"   ? add<dynamics::BallJoint>(skeleton, parent, j)
                    : j.kind == "translation" ? add<dynamics::TranslationalJoint>(skeleton, parent, j)
                    : j.kind == "free-flyer"  ? add<dynamics::FreeJoint>(skeleton, parent, j)
                                              : add<dynamics::RevoluteJoint>(skeleton, parent, j));
  }
  std::vector<bool> has(nodes.size(), false);
  for (const Body& b : robot.bodies) {
    BodyNode* node = nodes[static_cast<std::size_t>(b.joint)];
    if (has[static_cast<std::size_t>(b.joint)]) {
      dynamics::WeldJoint::Properties weld;
      weld.mT_ParentBodyToJoint = placement(b.Q, b.p);
      node = skeleton->createJointAndBodyNodePair<dynamics::WeldJoint>(node, weld).second;
    }
    has[static_cast<std::size_t>(b.joint)] = true;
    node->setInertia(dynamics::Inertia(b.mass, b.c, b.I_C));
  }
  return skeleton;
}
SkeletonPtr read(const Robot& robot) {
  dart::utils::DartLoader::Options options;
  options.mDefaultRootJointType = robot.floating ? dart::utils::DartLoader::RootJointType::FLOATING
                                                 : dart::utils::DartLoader::RootJointType::FIXED;
  options.mDefaultInertia = dynamics::Inertia(0, Vector3d::Zero(), Matrix3d::Zero());
  const SkeletonPtr skeleton = dart::utils::DartLoader(options).parseSkeletonString(robot.text, "");
  if (!skeleton) throw std::invalid_argument("DART does not read the URDF");
  return skeleton;
}

struct Tree {
  Robot robot;
  SkeletonPtr skeleton;
  std::vector<dynamics::Joint*> own;
  Eigen::MatrixXd P;  ///< DART's velocity is P v

  explicit Tree(const Robot& given)
      : robot(given),
        skeleton(robot.text.empty() ? built(robot) : read(robot)),
        P(Eigen::MatrixXd::Zero(robot.nv, robot.nv)) {
    if (static_cast<int>(skeleton->getNumDofs()) != robot.nv)
      throw std::invalid_argument("DART reads another number of velocities");
    skeleton->setGravity(robot.gravity);
    for (const Joint& j : robot.joints) {
      own.push_back(robot.floating && j.v == 0 ? skeleton->getRootJoint() : skeleton->getJoint(j.name));
      if (!own.back()) throw std::invalid_argument("DART reads no joint " + j.name);
      const int n = static_cast<int>(own.back()->getNumDofs()), at = index(own.size() - 1);
      for (int k = 0; k < n; ++k) {
        P(at + k, j.v + (n == 6 ? (k + 3) % 6 : k)) = 1;
        own.back()->setDampingCoefficient(static_cast<std::size_t>(k), 0);
        own.back()->setSpringStiffness(static_cast<std::size_t>(k), 0);
        own.back()->setCoulombFriction(static_cast<std::size_t>(k), 0);
      }
    }
  }
  int index(std::size_t i) const { return static_cast<int>(own[i]->getIndexInSkeleton(0)); }

  void set_q(std::span<const double> q) {
    VectorXd all(robot.nv);
    for (std::size_t i = 0; i < own.size(); ++i) {
      const Joint& j = robot.joints[i];
      const double* const x = &q[static_cast<std::size_t>(j.q)];
      if (j.kind == "free-flyer")
        all.segment<6>(index(i)) = dynamics::FreeJoint::convertToPositions(
            placement(Quaterniond(x[6], x[3], x[4], x[5]).normalized(), {x[0], x[1], x[2]}));
      else if (j.kind == "spherical")
        all.segment<3>(index(i)) = dynamics::BallJoint::convertToPositions(
            Quaterniond(x[3], x[0], x[1], x[2]).normalized().toRotationMatrix());
      else if (j.kind == "translation")
        all.segment<3>(index(i)) = Vector3d(x[0], x[1], x[2]);
      else
        all[index(i)] = robot.coordinate(j, q);
    }
    skeleton->setPositions(all);
    skeleton->clearExternalForces();
  }
  void set_v(std::span<const double> v) { skeleton->setVelocities(P * vector(v)); }
  void set_a(std::span<const double> a) { skeleton->setAccelerations(P * vector(a)); }
  /// A wrench on a joint's body, in its axes and at its origin.
  void push(std::span<const double> joint, std::span<const double> F) {
    if (joint[0] < 0) return;
    BodyNode* const body = node(static_cast<std::size_t>(joint[0]));
    body->addExtForce(Vector3d(F[0], F[1], F[2]), Vector3d::Zero(), true, true);
    body->addExtTorque(Vector3d(F[3], F[4], F[5]), true);
  }
  BodyNode* node(std::size_t joint) { return own[joint]->getChildBodyNode(); }
};

Numbers rnea(Tree& t, const Given& x) {
  t.set_q(x[0]), t.set_v(x[1]), t.set_a(x[2]), t.push(x[3], x[4]);
  t.skeleton->computeInverseDynamics(true, false, false);
  return rows(t.P.transpose() * t.skeleton->getForces());
}
Numbers aba(Tree& t, const Given& x) {
  t.set_q(x[0]), t.set_v(x[1]), t.push(x[3], x[4]);
  t.skeleton->setForces(t.P * vector(x[2]));
  t.skeleton->computeForwardDynamics();
  return rows(t.P.transpose() * t.skeleton->getAccelerations());
}
Numbers nonlinear(Tree& t, const Given& x) {
  t.set_q(x[0]), t.set_v(x[1]);
  return rows(t.P.transpose() * t.skeleton->getCoriolisAndGravityForces());
}
Numbers gravity(Tree& t, const Given& x) {
  t.set_q(x[0]);
  return rows(t.P.transpose() * t.skeleton->getGravityForces());
}
Numbers mass(Tree& t, const Given& x) {
  t.set_q(x[0]);
  return rows(t.P.transpose() * t.skeleton->getMassMatrix() * t.P);
}
Numbers mass_inverse(Tree& t, const Given& x) {
  t.set_q(x[0]);
  return rows(t.P.transpose() * t.skeleton->getInvMassMatrix() * t.P);
}
Numbers kinetic(Tree& t, const Given& x) {
  t.set_q(x[0]), t.set_v(x[1]);
  return {t.skeleton->computeKineticEnergy()};
}
Numbers potential(Tree& t, const Given& x) {
  t.set_q(x[0]);
  return {t.skeleton->computePotentialEnergy()};
}

/// Linear first, in the axes and at the origin that `seen` names, of a twist in the axes of the frame's body.
template <class V>
Numbers seen_as(Tree& t, double seen, const Frame& f, const V& angular_first) {
  const Isometry3d X = t.node(f.joint)->getWorldTransform();
  const Matrix3d R = seen == 1 ? Matrix3d(f.Q.toRotationMatrix().transpose()) : Matrix3d(X.linear());
  MatrixXd y(6, angular_first.cols());
  y << R * angular_first.template bottomRows<3>(), R * angular_first.template topRows<3>();
  return rows(y);
}
/// The point of the body at which `seen` wants a twist.
Vector3d point(Tree& t, double seen, const Frame& f) {
  return seen == 0 ? Vector3d(t.node(f.joint)->getWorldTransform().inverse() * Vector3d(Vector3d::Zero()))
                   : f.p;
}
Numbers frame_pose(Tree& t, const Given& x) {
  t.set_q(x[0]);
  const Frame f(x[1]);
  const Isometry3d X = t.node(f.joint)->getWorldTransform() * placement(f.Q, f.p);
  return pose(X.linear(), X.translation());
}
Numbers frame_jacobian(Tree& t, const Given& x) {
  t.set_q(x[0]);
  const Frame f(x[2]);
  const BodyNode* const body = t.node(f.joint);
  const auto partial = body->getJacobian(point(t, x[1][0], f));  // of the joints that the body depends on
  MatrixXd J = MatrixXd::Zero(6, t.robot.nv);
  for (std::size_t k = 0; k < body->getNumDependentGenCoords(); ++k)
    J.col(static_cast<int>(body->getDependentGenCoordIndex(k))) = partial.col(static_cast<int>(k));
  return seen_as(t, x[1][0], f, MatrixXd(J * t.P));
}
Numbers frame_velocity(Tree& t, const Given& x) {
  t.set_q(x[0]), t.set_v(x[1]);
  const Frame f(x[3]);
  const BodyNode* const body = t.node(f.joint);
  return seen_as(t, x[2][0], f,
                 body->getSpatialVelocity(point(t, x[2][0], f), dynamics::Frame::World(), body));
}
Numbers frame_acceleration(Tree& t, const Given& x) {
  t.set_q(x[0]), t.set_v(x[1]), t.set_a(x[2]);
  const Frame f(x[4]);
  const BodyNode* const body = t.node(f.joint);
  return seen_as(t, x[3][0], f,
                 body->getSpatialAcceleration(point(t, x[3][0], f), dynamics::Frame::World(), body));
}

}  // namespace

int main() {
  return serve<Tree>(
      "dart_trees", DART_VERSION,
      {{"models", {"urdf", "joints"}},
       {"joints", {"revolute", "continuous", "prismatic", "spherical", "translation", "free-flyer"}}},
      {{"tree_rnea", {"q v v 1 6", "v", rnea}},
       {"tree_aba", {"q v v 1 6", "v", aba}},
       {"tree_nonlinear_effects", {"q v", "v", nonlinear}},
       {"tree_gravity", {"q", "v", gravity}},
       {"tree_crba", {"q", "vv", mass}},
       {"tree_mass_inverse", {"q", "vv", mass_inverse}},
       {"tree_kinetic_energy", {"q v", "1", kinetic}},
       {"tree_potential_energy", {"q", "1", potential}},
       {"frame_pose", {"q 8", "12", frame_pose}},
       {"frame_jacobian", {"q 1 8", "6v", frame_jacobian}},
       {"frame_velocity", {"q v 1 8", "6", frame_velocity}},
       {"frame_acceleration", {"q v v 1 8", "6", frame_acceleration}}});
}
