// DART (BSD-2-Clause): generalized coordinates on the Lie group, semi-implicit Euler.

#include <dart/config.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/simulation/World.hpp>

#include <scenes/peers/make_peer.hpp>

namespace liecheck::properties {
namespace {

namespace dd = dart::dynamics;

class DartRunner final : public PeerRunner {
 public:
  DartRunner(const Benchmark& scene, const std::string&) : PeerRunner(scene) {
    robot_ = dd::Skeleton::create("robot");
    dd::BodyNode* parent = nullptr;
    for (const PeerBody& b : bodies_) {
      // Names are unique, because DART prints a message for each body that it renames.
      const dd::BodyNode::AspectProperties name("body" + std::to_string(robot_->getNumBodyNodes()));
      if (b.free) {
        const auto made = robot_->createJointAndBodyNodePair<dd::FreeJoint>(parent, {}, name);
        root_ = made.first, parent = made.second;
      } else {
        dd::RevoluteJoint::Properties joint;
        joint.mName = "joint" + std::to_string(robot_->getNumBodyNodes());
        const auto made = robot_->createJointAndBodyNodePair<dd::RevoluteJoint>(parent, joint, name);
        made.first->setAxis(b.axis);
        made.first->setTransformFromParentBodyNode(Eigen::Isometry3d(Eigen::Translation3d(b.at)));
        parent = made.second;
      }
      parent->setInertia(dd::Inertia(b.mass, b.centre, Eigen::Matrix3d(b.moments.asDiagonal())));
    }
    world_ = dart::simulation::World::create();
    world_->setGravity(scene.gravity);
    world_->addSkeleton(robot_);
  }

 protected:
  void reset(double h) override {
    world_->setTimeStep(h);
    world_->reset();
    if (!root_) {
      robot_->setPositions(scene_.q0), robot_->setVelocities(scene_.v0);
      return;
    }
    root_->setTransform(Eigen::Translation3d(scene_.q0.head<3>()) * attitude_of(scene_.q0));
    Eigen::Vector6d V;
    V << scene_.v0.tail<3>(), scene_.v0.head<3>();
    root_->setRelativeSpatialVelocity(V);
  }
  void step() override { world_->step(); }
  void read(Eigen::VectorXd& q, Eigen::VectorXd& v) const override {
    if (!root_) {
      q = robot_->getPositions(), v = robot_->getVelocities();
      return;
    }
    const dd::BodyNode* body = robot_->getBodyNode(0);
    const Eigen::Isometry3d X = body->getWorldTransform();
    set_free(q, v, X.translation(), Eigen::Quaterniond(X.linear()), body->getLinearVelocity(),
             body->getAngularVelocity());
  }

 private:
  dd::SkeletonPtr robot_;
  dart::simulation::WorldPtr world_;
  dd::FreeJoint* root_ = nullptr;
};

const Peer peer = make_peer<DartRunner>("DART", DART_VERSION, {{"semi-implicit Euler", 1}});

}  // namespace
}  // namespace liecheck::properties

LIECHECK_SCENE_PEER(liecheck::properties::peer)
