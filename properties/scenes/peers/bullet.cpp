// Bullet in double precision (zlib licence). A free body is a btRigidBody with implicit or explicit
// gyroscopic terms; a chain is a btMultiBody (Featherstone's algorithm).

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <fmt/format.h>
#include <scenes/peers/make_peer.hpp>

namespace liecheck::properties {
namespace {

btVector3 of(const Eigen::Vector3d& v) {
  return {v[0], v[1], v[2]};
}
Eigen::Vector3d of(const btVector3& v) {
  return {v[0], v[1], v[2]};
}

class BulletRunner final : public PeerRunner {
 public:
  BulletRunner(const Benchmark& scene, const std::string& method)
      : PeerRunner(scene),
        dispatcher_(&configuration_),
        world_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
    world_.setGravity(of(scene.gravity));
    if (bodies_[0].free) {
      const PeerBody& b = bodies_[0];
      btRigidBody::btRigidBodyConstructionInfo info(b.mass, nullptr, &shape_, of(b.moments));
      info.m_linearDamping = info.m_angularDamping = 0;
      body_ = std::make_unique<btRigidBody>(info);
      body_->setActivationState(DISABLE_DEACTIVATION);
      body_->setFlags(method == "explicit gyroscopic" ? BT_ENABLE_GYROSCOPIC_FORCE_EXPLICIT
                                                      : BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY);
      world_.addRigidBody(body_.get(), 0, 0);
      return;
    }
    chain_ = std::make_unique<btMultiBody>(int(bodies_.size()), 0, btVector3(0, 0, 0), true, false);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const PeerBody& b = bodies_[i];
      const Eigen::Vector3d parent = i > 0 ? bodies_[i - 1].centre : Eigen::Vector3d(Eigen::Vector3d::Zero());
      chain_->setupRevolute(int(i), b.mass, of(b.moments), b.parent, btQuaternion(0, 0, 0, 1), of(b.axis),
                            of(Eigen::Vector3d(b.at - parent)), of(b.centre), true);
    }
    chain_->finalizeMultiDof();
    chain_->setLinearDamping(0), chain_->setAngularDamping(0);
    chain_->setMaxCoordinateVelocity(1e30);
    chain_->useRK4Integration(method == "RK4");
    world_.addMultiBody(chain_.get(), 0, 0);
  }
  ~BulletRunner() override {
    if (body_) world_.removeRigidBody(body_.get());
    if (chain_) world_.removeMultiBody(chain_.get());
  }

 protected:
  void reset(double h) override {
    h_ = h;
    if (body_) {
      const Eigen::Quaterniond Q = attitude_of(scene_.q0);
      const Eigen::Vector3d u = scene_.v0.head<3>(), w = scene_.v0.tail<3>(), c = bodies_[0].centre;
      const btTransform X(btQuaternion(Q.x(), Q.y(), Q.z(), Q.w()),
                          of(Eigen::Vector3d(scene_.q0.head<3>() + Q * c)));
      body_->setWorldTransform(X), body_->setInterpolationWorldTransform(X);
      body_->clearForces();
      body_->setLinearVelocity(of(Eigen::Vector3d(Q * (u + w.cross(c)))));
      body_->setAngularVelocity(of(Eigen::Vector3d(Q * w)));
      body_->updateInertiaTensor();
    } else {
      chain_->clearForcesAndTorques(), chain_->clearVelocities();
      for (int i = 0; i < int(bodies_.size()); ++i)
        chain_->setJointPos(i, scene_.q0[i]), chain_->setJointVel(i, scene_.v0[i]);
    }
  }
  void step() override { world_.stepSimulation(h_, 0); }
  void read(Eigen::VectorXd& q, Eigen::VectorXd& v) const override {
    if (body_) {
      const btQuaternion o = body_->getOrientation();
      const Eigen::Quaterniond Q = Eigen::Quaterniond(o.w(), o.x(), o.y(), o.z()).normalized();
      const Eigen::Vector3d c = Q * bodies_[0].centre, w = of(body_->getAngularVelocity());
      set_free(q, v, of(body_->getCenterOfMassPosition()) - c, Q, of(body_->getLinearVelocity()) - w.cross(c),
               w);
      return;
    }
    q.resize(scene_.q0.size()), v.resize(scene_.v0.size());
    for (int i = 0; i < int(q.size()); ++i) q[i] = chain_->getJointPos(i), v[i] = chain_->getJointVel(i);
  }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btMultiBodyConstraintSolver solver_;
  btMultiBodyDynamicsWorld world_;
  btSphereShape shape_{0.01};
  std::unique_ptr<btRigidBody> body_;
  std::unique_ptr<btMultiBody> chain_;
  double h_ = 0;
};

const Peer peer = make_peer<BulletRunner>(
    "Bullet", fmt::format("{}.{}", BT_BULLET_VERSION / 100, BT_BULLET_VERSION % 100),
    {{"implicit gyroscopic", 1}, {"explicit gyroscopic", 1}}, {{"RK4", 4}, {"semi-implicit Euler", 1}});

}  // namespace
}  // namespace liecheck::properties

LIECHECK_SCENE_PEER(liecheck::properties::peer)
