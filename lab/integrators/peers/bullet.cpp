// Bullet in double precision (zlib licence). A free body is a btRigidBody with implicit or explicit
// gyroscopic terms; any other robot is a btMultiBody (Featherstone's algorithm). Both have frames C of
// principal axes at the centres of mass.
//
// Gravity is its own. It gets all other forces once a step, also in its RK4.

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <fmt/format.h>
#include <integrators/peers/make_peer.hpp>

namespace liecheck::properties {
namespace {

btVector3 of(const Eigen::Vector3d& v) {
  return {v[0], v[1], v[2]};
}
Eigen::Vector3d of(const btVector3& v) {
  return {v[0], v[1], v[2]};
}
btQuaternion of(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond Q(R);
  return {Q.x(), Q.y(), Q.z(), Q.w()};
}
btTransform of(const Eigen::Isometry3d& X) {
  return btTransform(of(Eigen::Matrix3d(X.linear())), of(Eigen::Vector3d(X.translation())));
}
Eigen::Isometry3d of(const btTransform& X) {
  const btQuaternion o = X.getRotation();
  return Eigen::Translation3d(of(X.getOrigin())) *
         Eigen::Quaterniond(o.w(), o.x(), o.y(), o.z()).normalized();
}

/// Pose of a body's frame B and velocities of its origin and of it, in the world's axes.
struct Seen {
  Eigen::Isometry3d X;
  Eigen::Vector3d u, w;
};

class BulletRunner : public PeerRunner {
 public:
  explicit BulletRunner(const Benchmark& scene)
      : PeerRunner(scene),
        dispatcher_(&configuration_),
        world_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
    world_.setGravity(of(scene.gravity));
  }

 protected:
  void step() override {
    if (load_) {
      add_forces(time_);
      time_ += h_;
    }
    world_.stepSimulation(h_, 0);
  }
  virtual void add_forces(double t) = 0;
  /// From the pose of C and the velocity of the centre of mass.
  static Seen seen(const PeerBody& b, const Eigen::Isometry3d& X_WC, const Eigen::Vector3d& u_C,
                   const Eigen::Vector3d& w) {
    const Eigen::Isometry3d X = X_WC * b.X_BC.inverse();
    return {X, u_C - w.cross(Eigen::Vector3d(X.linear() * b.centre)), w};
  }
  /// The velocities of the centre of mass of the free root at the start, and its angular velocity.
  std::pair<Eigen::Vector3d, Eigen::Vector3d> root_start() const {
    const PeerBody& b = bodies_[0];
    const Eigen::Matrix3d R = b.pose(scene_.q0).linear();
    const Eigen::Vector3d u = scene_.v0.segment<3>(b.v), w = scene_.v0.segment<3>(b.v + 3);
    return {R * (u + w.cross(b.centre)), R * w};
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btMultiBodyConstraintSolver solver_;
  btMultiBodyDynamicsWorld world_;
  double h_ = 0, time_ = 0;
};

class FreeBodyRunner final : public BulletRunner {
 public:
  FreeBodyRunner(const Benchmark& scene, const std::string& method) : BulletRunner(scene) {
    const PeerBody& b = bodies_[0];
    btRigidBody::btRigidBodyConstructionInfo info(b.mass, nullptr, &shape_, of(b.moments));
    info.m_linearDamping = info.m_angularDamping = 0;
    body_ = std::make_unique<btRigidBody>(info);
    body_->setActivationState(DISABLE_DEACTIVATION);
    body_->setFlags(method == "explicit gyroscopic" ? BT_ENABLE_GYROSCOPIC_FORCE_EXPLICIT
                                                    : BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY);
    world_.addRigidBody(body_.get(), 0, 0);
  }
  ~FreeBodyRunner() override { world_.removeRigidBody(body_.get()); }

 protected:
  void reset(double h) override {
    h_ = h, time_ = 0;
    const auto [u, w] = root_start();
    const btTransform X = of(bodies_[0].pose(scene_.q0) * bodies_[0].X_BC);
    body_->setWorldTransform(X), body_->setInterpolationWorldTransform(X);
    body_->clearForces();
    body_->setLinearVelocity(of(u)), body_->setAngularVelocity(of(w));
    body_->updateInertiaTensor();
  }
  void read(Eigen::VectorXd& q, Eigen::VectorXd& v) const override {
    const Seen s = look();
    bodies_[0].set_free(q, v, s.X.translation(), Eigen::Quaterniond(s.X.linear()), s.u, s.w);
  }
  void add_forces(double t) override {
    load_->t = t;
    read(load_->q, load_->v);
    const Seen s = look();
    load_->see(0, s.X.linear(), s.X.translation(), s.u, s.w);
    load_->evaluate();
    if (!load_->wrenches[0].acts) return;
    body_->applyCentralForce(of(load_->wrenches[0].force)), body_->applyTorque(of(load_->wrenches[0].moment));
  }

 private:
  Seen look() const {
    return seen(bodies_[0], of(body_->getWorldTransform()), of(body_->getLinearVelocity()),
                of(body_->getAngularVelocity()));
  }
  btSphereShape shape_{0.01};
  std::unique_ptr<btRigidBody> body_;
};

class MultiBodyRunner final : public BulletRunner {
 public:
  MultiBodyRunner(const Benchmark& scene, const std::string& method)
      : BulletRunner(scene), first_(bodies_[0].free()) {
    const PeerBody& root = bodies_[0];
    robot_ = std::make_unique<btMultiBody>(int(bodies_.size()) - first_, first_ ? root.mass : 0,
                                           first_ ? of(root.moments) : btVector3(0, 0, 0), !first_, false);
    for (std::size_t i = std::size_t(first_); i < bodies_.size(); ++i) add_link(int(i));
    robot_->finalizeMultiDof();
    robot_->setLinearDamping(0), robot_->setAngularDamping(0);
    robot_->setMaxCoordinateVelocity(1e30);
    robot_->useRK4Integration(method == "RK4");
    world_.addMultiBody(robot_.get(), 0, 0);
    linear_.resize(int(bodies_.size()) + 1), angular_.resize(int(bodies_.size()) + 1);
  }
  ~MultiBodyRunner() override { world_.removeMultiBody(robot_.get()); }

 protected:
  void reset(double h) override {
    h_ = h, time_ = 0;
    robot_->clearForcesAndTorques(), robot_->clearVelocities();
    if (first_) {
      const auto [u, w] = root_start();
      robot_->setBaseWorldTransform(of(bodies_[0].pose(scene_.q0) * bodies_[0].X_BC));
      robot_->setBaseVel(of(u)), robot_->setBaseOmega(of(w));
    }
    for (int i = first_; i < int(bodies_.size()); ++i) {
      const PeerBody& b = bodies_[std::size_t(i)];
      robot_->setJointPos(i - first_, b.position(scene_.q0)), robot_->setJointVel(i - first_, scene_.v0[b.v]);
    }
  }
  void read(Eigen::VectorXd& q, Eigen::VectorXd& v) const override {
    if (first_) {
      const Seen s = seen(bodies_[0], of(robot_->getBaseWorldTransform()), of(robot_->getBaseVel()),
                          of(robot_->getBaseOmega()));
      bodies_[0].set_free(q, v, s.X.translation(), Eigen::Quaterniond(s.X.linear()), s.u, s.w);
    }
    for (int i = first_; i < int(bodies_.size()); ++i) {
      const PeerBody& b = bodies_[std::size_t(i)];
      b.set_position(q, robot_->getJointPos(i - first_)), v[b.v] = robot_->getJointVel(i - first_);
    }
  }
  void add_forces(double t) override {
    load_->t = t;
    read(load_->q, load_->v);
    if (load_->poses) see_bodies();
    load_->evaluate();
    for (int i = 0; i < int(bodies_.size()); ++i) {
      const PeerLoad::Wrench& w = load_->wrenches[std::size_t(i)];
      const int link = i - first_;
      if (link >= 0) robot_->addJointTorque(link, load_->tau[bodies_[std::size_t(i)].v]);
      if (!w.acts) continue;
      if (link >= 0)
        robot_->addLinkForce(link, of(w.force)), robot_->addLinkTorque(link, of(w.moment));
      else
        robot_->addBaseForce(of(w.force)), robot_->addBaseTorque(of(w.moment));
    }
  }

 private:
  /// Link i, counted in bodies_, with its pivot at the origin of its frame B.
  void add_link(int i) {
    const PeerBody& b = bodies_[std::size_t(i)];
    const Eigen::Isometry3d X_PC =
        b.parent < 0 ? Eigen::Isometry3d::Identity() : bodies_[std::size_t(b.parent)].X_BC;  // of the parent
    const Eigen::Isometry3d X_CpB = X_PC.inverse() * b.X_PB;
    const Eigen::Matrix3d R_CB = b.X_BC.linear().transpose(), turn = R_CB * X_CpB.linear().transpose();
    const btVector3 axis = of(Eigen::Vector3d(R_CB * b.axis)),
                    to_pivot = of(Eigen::Vector3d(X_CpB.translation())),
                    to_centre = of(Eigen::Vector3d(R_CB * b.centre));
    if (b.joint == PeerBody::Joint::revolute)
      robot_->setupRevolute(i - first_, b.mass, of(b.moments), b.parent - first_, of(turn), axis, to_pivot,
                            to_centre, true);
    else
      robot_->setupPrismatic(i - first_, b.mass, of(b.moments), b.parent - first_, of(turn), axis, to_pivot,
                             to_centre, true);
  }
  void see_bodies() {
    robot_->forwardKinematics(rotations_, origins_);
    robot_->compTreeLinkVelocities(&angular_[0], &linear_[0]);  // in the axes of each C
    for (int i = 0; i < int(bodies_.size()); ++i) {
      const int link = i - first_;
      const Eigen::Isometry3d X =
          of(link < 0 ? robot_->getBaseWorldTransform() : robot_->getLink(link).m_cachedWorldTransform);
      const Seen s = seen(bodies_[std::size_t(i)], X, X.linear() * of(linear_[link + 1]),
                          X.linear() * of(angular_[link + 1]));
      load_->see(std::size_t(i), s.X.linear(), s.X.translation(), s.u, s.w);
    }
  }

  const int first_;  ///< the number of bodies that are not links: 1 with a free root
  std::unique_ptr<btMultiBody> robot_;
  btAlignedObjectArray<btQuaternion> rotations_;
  btAlignedObjectArray<btVector3> origins_, linear_, angular_;
};

std::unique_ptr<Runner> make(const Benchmark& scene, const std::string& method) {
  if (scene.robot.njoints == 2 && peer_bodies(scene)[0].free())
    return std::make_unique<FreeBodyRunner>(scene, method);
  return std::make_unique<MultiBodyRunner>(scene, method);
}

const Peer peer = make_peer(
    make, "Bullet", fmt::format("{}.{}", BT_BULLET_VERSION / 100, BT_BULLET_VERSION % 100),
    {{"implicit gyroscopic", 1}, {"explicit gyroscopic", 1}}, {{"RK4", 4}, {"semi-implicit Euler", 1}});

}  // namespace
}  // namespace liecheck::properties

LIECHECK_SCENE_PEER(liecheck::properties::peer)
