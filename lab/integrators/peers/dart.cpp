// DART (BSD-2-Clause): generalized coordinates on the Lie group, semi-implicit Euler.
//
// Gravity, damping and springs (both implicit in its step) are its own. It gets the other forces once a step.

#include <dart/config.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/PrismaticJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/simulation/World.hpp>

#include <integrators/peers/make_peer.hpp>

namespace liecheck::properties {
namespace {

namespace dd = dart::dynamics;

class DartRunner final : public PeerRunner {
 public:
  DartRunner(const Benchmark& scene, const std::string&)
      : PeerRunner(scene, {"joint_damping", "joint_spring"}) {
    robot_ = dd::Skeleton::create("robot");
    for (const PeerBody& b : bodies_) {
      if (b.free())
        root_ = add<dd::FreeJoint>(b);
      else if (b.joint == PeerBody::Joint::revolute)
        add<dd::RevoluteJoint>(b)->setAxis(b.axis);
      else
        add<dd::PrismaticJoint>(b)->setAxis(b.axis);
      dd::Joint& joint = *nodes_.back()->getParentJoint();
      joint.setTransformFromParentBodyNode(b.X_PB);
      if (!b.free())
        joint.setDampingCoefficient(0, b.damping), joint.setSpringStiffness(0, b.stiffness),
            joint.setRestPosition(0, b.rest);
      nodes_.back()->setInertia(dd::Inertia(b.mass, b.centre, b.inertia));
    }
    world_ = dart::simulation::World::create();
    world_->setGravity(scene.gravity);
    world_->addSkeleton(robot_);
  }

 protected:
  void reset(double h) override {
    world_->setTimeStep(h);
    world_->reset();
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const PeerBody& b = bodies_[i];
      if (!b.free()) {
        nodes_[i]->getParentJoint()->setPosition(0, b.position(scene_.q0));
        nodes_[i]->getParentJoint()->setVelocity(0, scene_.v0[b.v]);
        continue;
      }
      root_->setTransform(b.pose(scene_.q0));
      Eigen::Vector6d V;
      V << scene_.v0.segment<3>(b.v + 3), scene_.v0.segment<3>(b.v);
      root_->setRelativeSpatialVelocity(V);
    }
  }
  void step() override {
    if (load_) add_forces();
    world_->step();
    // DART ends the program when a number is no longer finite. Speeds square at most in one step.
    if (!(robot_->getVelocities().squaredNorm() < 1e60)) throw Diverged("speeds grow beyond 1e30");
  }
  void read(Eigen::VectorXd& q, Eigen::VectorXd& v) const override {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const PeerBody& b = bodies_[i];
      const dd::Joint& joint = *nodes_[i]->getParentJoint();
      if (!b.free()) {
        b.set_position(q, joint.getPosition(0)), v[b.v] = joint.getVelocity(0);
        continue;
      }
      const Eigen::Isometry3d& X = nodes_[i]->getWorldTransform();
      b.set_free(q, v, X.translation(), Eigen::Quaterniond(X.linear()), nodes_[i]->getLinearVelocity(),
                 nodes_[i]->getAngularVelocity());
    }
  }

 private:
  /// Adds a body with its joint. Names are unique, because DART prints a message for each that it changes.
  template <class J>
  J* add(const PeerBody& b) {
    const std::string number = std::to_string(nodes_.size());
    typename J::Properties joint;
    joint.mName = "joint" + number;
    dd::BodyNode* parent = b.parent < 0 ? nullptr : nodes_[std::size_t(b.parent)];
    const auto made =
        robot_->createJointAndBodyNodePair<J>(parent, joint, dd::BodyNode::AspectProperties("body" + number));
    nodes_.push_back(made.second);
    return made.first;
  }
  void add_forces() {
    load_->t = world_->getTime();
    read(load_->q, load_->v);
    for (std::size_t i = 0; load_->poses && i < bodies_.size(); ++i) {
      const Eigen::Isometry3d& X = nodes_[i]->getWorldTransform();
      load_->see(i, X.linear(), X.translation(), nodes_[i]->getLinearVelocity(),
                 nodes_[i]->getAngularVelocity());
    }
    load_->evaluate();
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (!bodies_[i].free()) nodes_[i]->getParentJoint()->setCommand(0, load_->tau[bodies_[i].v]);
      const PeerLoad::Wrench& w = load_->wrenches[i];
      if (w.acts)
        nodes_[i]->addExtForce(w.force, bodies_[i].centre, false, true),
            nodes_[i]->addExtTorque(w.moment, false);
    }
  }

  dd::SkeletonPtr robot_;
  dart::simulation::WorldPtr world_;
  dd::FreeJoint* root_ = nullptr;
  std::vector<dd::BodyNode*> nodes_;
};

const Peer peer = make_peer<DartRunner>("DART", DART_VERSION, {{"semi-implicit Euler", 1}});

}  // namespace
}  // namespace liecheck::properties

LIECHECK_SCENE_PEER(liecheck::properties::peer)
