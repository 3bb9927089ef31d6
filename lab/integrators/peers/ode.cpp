// Open Dynamics Engine (BSD-3-Clause or LGPL-2.1): bodies in maximal coordinates, joints by constraints that
// dWorldStep solves directly; semi-implicit Euler. Its bodies have the axes of B and their origins at the
// centres of mass.
//
// Gravity is its own. It gets all other forces once a step.

#include <ode/ode.h>

#include <algorithm>
#include <integrators/peers/make_peer.hpp>

namespace liecheck::properties {
namespace {

class OdeRunner final : public PeerRunner {
 public:
  OdeRunner(const Benchmark& scene, const std::string&) : PeerRunner(scene), world_(dWorldCreate()) {
    dWorldSetGravity(world_, scene.gravity[0], scene.gravity[1], scene.gravity[2]);
    dWorldSetCFM(world_, 0);
    dWorldSetAutoDisableFlag(world_, 0);
    for (const PeerBody& b : bodies_) {
      const dBodyID id = dBodyCreate(world_);
      const Eigen::Matrix3d& I = b.inertia;
      dMass mass;
      dMassSetParameters(&mass, b.mass, 0, 0, 0, I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
      dBodySetMass(id, &mass);
      dBodySetFiniteRotationMode(id, 1);
      ids_.push_back(id);
    }
    place();
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      if (!bodies_[i].free()) add_joint(i);
  }
  ~OdeRunner() override { dWorldDestroy(world_); }

 protected:
  void reset(double h) override {
    h_ = h, time_ = 0;
    place();
  }
  void step() override {
    if (load_) add_forces();
    dWorldStep(world_, h_);
    time_ += h_;
    check();
  }
  void read(Eigen::VectorXd& q, Eigen::VectorXd& v) const override {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const PeerBody& b = bodies_[i];
      const Seen s = look(int(i));
      if (b.free()) {
        b.set_free(q, v, s.X.translation(), Eigen::Quaterniond(s.X.linear()), s.u, s.w);
        continue;
      }
      const Seen parent = look(b.parent);
      const Eigen::Isometry3d X_JB = b.X_PB.inverse() * (parent.X.inverse() * s.X);
      const Eigen::Vector3d axis_W = s.X.linear() * b.axis;
      if (b.joint == PeerBody::Joint::revolute) {
        const Eigen::Quaterniond Q(X_JB.linear());
        b.set_position(q, 2 * std::atan2(Q.vec().dot(b.axis), Q.w()));
        v[b.v] = axis_W.dot(s.w - parent.w);
      } else {
        b.set_position(q, X_JB.translation().dot(b.axis));
        const Eigen::Vector3d arm = s.X.translation() - parent.X.translation();
        v[b.v] = axis_W.dot(s.u - parent.u - parent.w.cross(arm));
      }
    }
  }

 private:
  /// Pose of a body's frame B and velocities of its origin and of it, in the world's axes.
  struct Seen {
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    Eigen::Vector3d u = Eigen::Vector3d::Zero(), w = Eigen::Vector3d::Zero();
  };
  static Eigen::Vector3d of(const dReal* x) { return {x[0], x[1], x[2]}; }
  Seen look(int body) const {
    Seen s;
    if (body < 0) return s;
    const dBodyID id = ids_[std::size_t(body)];
    const dReal* Q = dBodyGetQuaternion(id);
    const Eigen::Vector3d& c = bodies_[std::size_t(body)].centre;
    const Eigen::Quaterniond R(Q[0], Q[1], Q[2], Q[3]);
    s.X = Eigen::Translation3d(of(dBodyGetPosition(id)) - R * c) * R;
    s.w = of(dBodyGetAngularVel(id));
    s.u = of(dBodyGetLinearVel(id)) - s.w.cross(R * c);
    return s;
  }
  /// Sets all bodies to the start, from the root outwards.
  void place() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const PeerBody& b = bodies_[i];
      Seen s = look(b.parent);
      if (b.free()) {
        s.X = b.pose(scene_.q0);
        s.u = s.X.linear() * scene_.v0.segment<3>(b.v), s.w = s.X.linear() * scene_.v0.segment<3>(b.v + 3);
      } else {
        const bool turns = b.joint == PeerBody::Joint::revolute;
        const double x = b.position(scene_.q0), rate = scene_.v0[b.v];
        const Eigen::Vector3d before = s.X.translation();
        s.X = s.X * b.X_PB;
        if (turns)
          s.X = s.X * Eigen::AngleAxisd(x, b.axis);
        else
          s.X = s.X * Eigen::Translation3d(x * b.axis);
        const Eigen::Vector3d axis_W = s.X.linear() * b.axis;
        s.u += s.w.cross(s.X.translation() - before);
        (turns ? s.w : s.u) += rate * axis_W;
      }
      const dBodyID id = ids_[i];
      const Eigen::Quaterniond Q(s.X.linear());
      const Eigen::Vector3d c = s.X.linear() * b.centre, p = s.X.translation() + c, u = s.u + s.w.cross(c);
      const dQuaternion o = {Q.w(), Q.x(), Q.y(), Q.z()};
      dBodySetPosition(id, p[0], p[1], p[2]), dBodySetQuaternion(id, o);
      dBodySetLinearVel(id, u[0], u[1], u[2]), dBodySetAngularVel(id, s.w[0], s.w[1], s.w[2]);
      dBodySetForce(id, 0, 0, 0), dBodySetTorque(id, 0, 0, 0);
    }
  }
  /// ODE ends the program when a number is no longer finite. Speeds square at most in one step, so these are
  /// caught before.
  void check() const {
    for (const dBodyID id : ids_) {
      const dReal *u = dBodyGetLinearVel(id), *w = dBodyGetAngularVel(id);
      const double largest = std::max(
          {std::abs(u[0]), std::abs(u[1]), std::abs(u[2]), std::abs(w[0]), std::abs(w[1]), std::abs(w[2])});
      if (!(largest < 1e30)) throw Diverged("speeds grow beyond 1e30");
    }
  }
  void add_joint(std::size_t i) {
    const PeerBody& b = bodies_[i];
    const Seen s = look(int(i));
    const Eigen::Vector3d p = s.X.translation(), axis = s.X.linear() * b.axis;
    const bool turns = b.joint == PeerBody::Joint::revolute;
    const dJointID joint = turns ? dJointCreateHinge(world_, nullptr) : dJointCreateSlider(world_, nullptr);
    dJointAttach(joint, ids_[i], b.parent < 0 ? nullptr : ids_[std::size_t(b.parent)]);
    if (turns)
      dJointSetHingeAnchor(joint, p[0], p[1], p[2]), dJointSetHingeAxis(joint, axis[0], axis[1], axis[2]);
    else
      dJointSetSliderAxis(joint, axis[0], axis[1], axis[2]);
  }
  void add_forces() {
    load_->t = time_;
    read(load_->q, load_->v);
    for (std::size_t i = 0; load_->poses && i < bodies_.size(); ++i) {
      const Seen s = look(int(i));
      load_->see(i, s.X.linear(), s.X.translation(), s.u, s.w);
    }
    load_->evaluate();
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const PeerBody& b = bodies_[i];
      const PeerLoad::Wrench& w = load_->wrenches[i];
      if (w.acts)
        dBodyAddForce(ids_[i], w.force[0], w.force[1], w.force[2]),
            dBodyAddTorque(ids_[i], w.moment[0], w.moment[1], w.moment[2]);
      if (b.free() || load_->tau[b.v] == 0) continue;
      const Seen s = look(int(i));
      const Eigen::Vector3d p = s.X.translation(), f = load_->tau[b.v] * (s.X.linear() * b.axis);
      act(b, ids_[i], p, f);
      if (b.parent >= 0) act(b, ids_[std::size_t(b.parent)], p, -f);
    }
  }
  /// Applies a joint's torque, or its force at p, to one of its bodies.
  static void act(const PeerBody& b, dBodyID id, const Eigen::Vector3d& p, const Eigen::Vector3d& f) {
    if (b.joint == PeerBody::Joint::revolute)
      dBodyAddTorque(id, f[0], f[1], f[2]);
    else
      dBodyAddForceAtPos(id, f[0], f[1], f[2], p[0], p[1], p[2]);
  }

  struct Library {
    Library() { dInitODE2(0); }
  };
  const Library library_;
  dWorldID world_;
  std::vector<dBodyID> ids_;
  double h_ = 0, time_ = 0;
};

const Peer peer = make_peer<OdeRunner>("ODE", dODE_VERSION, {{"dWorldStep", 1}});

}  // namespace
}  // namespace liecheck::properties

LIECHECK_SCENE_PEER(liecheck::properties::peer)
