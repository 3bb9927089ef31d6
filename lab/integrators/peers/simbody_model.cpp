#include <integrators/peers/simbody_model.hpp>

#include <Simbody.h>

namespace liecheck::properties {
namespace {

SimTK::Vec3 of(const Eigen::Vector3d& v) {
  return {v[0], v[1], v[2]};
}
Eigen::Vector3d of(const SimTK::Vec3& v) {
  return {v[0], v[1], v[2]};
}

SimTK::Rotation of(const Eigen::Matrix3d& R) {
  return {SimTK::Mat33(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)),
          true};
}
SimTK::Transform of(const Eigen::Isometry3d& X) {
  return {of(Eigen::Matrix3d(X.linear())), of(Eigen::Vector3d(X.translation()))};
}
Eigen::Matrix3d of(const SimTK::Rotation& R) {
  Eigen::Matrix3d M;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) M(i, j) = R[i][j];
  return M;
}

using Mobods = std::vector<SimTK::MobilizedBody>;

/// Sets q and v to the state s, which must be realised to velocities.
void read_state(const std::vector<PeerBody>& bodies, const Mobods& mobods, const SimTK::State& s,
                Eigen::VectorXd& q, Eigen::VectorXd& v) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const PeerBody& b = bodies[i];
    if (!b.free()) {
      b.set_position(q, mobods[i].getOneQ(s, 0)), v[b.v] = mobods[i].getOneU(s, 0);
      continue;
    }
    const SimTK::Quaternion o = mobods[i].getBodyRotation(s).convertRotationToQuaternion();
    b.set_free(q, v, of(mobods[i].getBodyOriginLocation(s)), Eigen::Quaterniond(o[0], o[1], o[2], o[3]),
               of(mobods[i].getBodyOriginVelocity(s)), of(mobods[i].getBodyAngularVelocity(s)));
  }
}

/// The forces of a PeerLoad.
class Loaded final : public SimTK::Force::Custom::Implementation {
 public:
  Loaded(PeerLoad& load, const std::vector<PeerBody>& bodies, const Mobods& mobods)
      : load_(load), bodies_(bodies), mobods_(mobods) {}
  void calcForce(const SimTK::State& s, SimTK::Vector_<SimTK::SpatialVec>& on_bodies,
                 SimTK::Vector_<SimTK::Vec3>&, SimTK::Vector& on_joints) const override {
    load_.t = s.getTime();
    read_state(bodies_, mobods_, s, load_.q, load_.v);
    for (std::size_t i = 0; load_.poses && i < bodies_.size(); ++i)
      load_.see(i, of(mobods_[i].getBodyRotation(s)), of(mobods_[i].getBodyOriginLocation(s)),
                of(mobods_[i].getBodyOriginVelocity(s)), of(mobods_[i].getBodyAngularVelocity(s)));
    load_.evaluate();
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const SimTK::MobilizedBody& body = mobods_[i];
      const PeerLoad::Wrench& w = load_.wrenches[i];
      if (!bodies_[i].free()) body.applyOneMobilityForce(s, 0, load_.tau[bodies_[i].v], on_joints);
      if (!w.acts) continue;
      body.applyForceToBodyPoint(s, of(bodies_[i].centre), of(w.force), on_bodies);
      body.applyBodyTorque(s, of(w.moment), on_bodies);
    }
  }
  SimTK::Real calcPotentialEnergy(const SimTK::State&) const override { return 0; }

 private:
  PeerLoad& load_;
  const std::vector<PeerBody>& bodies_;
  const Mobods& mobods_;
};

class Model final : public SimbodyModel {
 public:
  Model(const SimbodyScene& scene, const std::string& method)
      : scene_(scene), matter_(system_), forces_(system_) {
    if (!scene.gravity.isZero(0)) SimTK::Force::Gravity(forces_, matter_, of(scene.gravity));
    for (const PeerBody& b : scene_.bodies) add(b);
    if (scene_.load) SimTK::Force::Custom(forces_, new Loaded(*scene_.load, scene_.bodies, mobods_));
    system_.realizeTopology();
    if (method == "RKMerson") integrator_ = std::make_unique<SimTK::RungeKuttaMersonIntegrator>(system_);
    if (method == "RKFehlberg") integrator_ = std::make_unique<SimTK::RungeKuttaFeldbergIntegrator>(system_);
    if (method == "Verlet") integrator_ = std::make_unique<SimTK::VerletIntegrator>(system_);
    integrator_->setAllowInterpolation(false);
  }

  void start(double accuracy) override {
    SimTK::State s = system_.getDefaultState();
    for (std::size_t i = 0; i < mobods_.size(); ++i) {
      const PeerBody& b = scene_.bodies[i];
      if (!b.free()) {
        mobods_[i].setOneQ(s, 0, b.position(scene_.q0)), mobods_[i].setOneU(s, 0, scene_.v0[b.v]);
        continue;
      }
      const Eigen::Isometry3d X = b.pose(scene_.q0);
      const Eigen::Vector3d u = X.linear() * scene_.v0.segment<3>(b.v),
                            w = X.linear() * scene_.v0.segment<3>(b.v + 3);
      mobods_[i].setQToFitTransform(s, of(X));
      mobods_[i].setUToFitAngularVelocity(s, of(w)), mobods_[i].setUToFitLinearVelocity(s, of(u));
    }
    integrator_->setAccuracy(accuracy);
    integrator_->setFinalTime(scene_.duration);
    integrator_->initialize(s);
  }
  std::string to(double t) override try {
    for (int idle = 0; integrator_->getTime() < t && !integrator_->isSimulationOver();) {
      const double before = integrator_->getTime();
      integrator_->stepTo(t);  // also returns once at the start
      idle = integrator_->getTime() > before ? 0 : idle + 1;
      if (idle > 3) return "at " + std::to_string(before) + " s: the time no longer increases";
    }
    return "";
  } catch (const std::exception& e) {
    return "at " + std::to_string(integrator_->getTime()) + " s: " + e.what();
  }
  void read(Eigen::VectorXd& q, Eigen::VectorXd& v) const override {
    const SimTK::State& s = integrator_->getState();
    system_.realize(s, SimTK::Stage::Velocity);
    read_state(scene_.bodies, mobods_, s, q, v);
  }
  long steps() const override { return integrator_->getNumStepsTaken(); }

 private:
  /// A pin rotates about z, a slider moves along x.
  void add(const PeerBody& b) {
    const Eigen::Matrix3d& I = b.inertia;
    const SimTK::Inertia about_centre(I(0, 0), I(1, 1), I(2, 2), I(1, 0), I(2, 0), I(2, 1));
    const SimTK::Body::Rigid body(SimTK::MassProperties(
        b.mass, of(b.centre), about_centre.shiftFromMassCenter(of(Eigen::Vector3d(-b.centre)), b.mass)));
    SimTK::MobilizedBody& parent = b.parent < 0 ? matter_.updGround() : mobods_[std::size_t(b.parent)];
    if (b.free()) {
      mobods_.push_back(SimTK::MobilizedBody::Free(parent, body));
      return;
    }
    const bool turns = b.joint == PeerBody::Joint::revolute;
    const SimTK::CoordinateAxis along =
        turns ? SimTK::CoordinateAxis(SimTK::ZAxis) : SimTK::CoordinateAxis(SimTK::XAxis);
    const SimTK::Transform X_BM(SimTK::Rotation(SimTK::UnitVec3(of(b.axis)), along));
    if (turns)
      mobods_.push_back(SimTK::MobilizedBody::Pin(parent, of(b.X_PB) * X_BM, body, X_BM));
    else
      mobods_.push_back(SimTK::MobilizedBody::Slider(parent, of(b.X_PB) * X_BM, body, X_BM));
  }

  SimbodyScene scene_;
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::GeneralForceSubsystem forces_;
  Mobods mobods_;
  std::unique_ptr<SimTK::Integrator> integrator_;
};

}  // namespace

std::unique_ptr<SimbodyModel> make_simbody_model(const SimbodyScene& scene, const std::string& method) {
  return std::make_unique<Model>(scene, method);
}

std::string simbody_version() {
  int major = 0, minor = 0, build = 0;
  SimTK_version_simbody(&major, &minor, &build);
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(build);
}

}  // namespace liecheck::properties
