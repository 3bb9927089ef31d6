#include <scenes/peers/simbody_model.hpp>

#include <Simbody.h>

namespace liecheck::properties {
namespace {

SimTK::Vec3 of(const Eigen::Vector3d& v) {
  return {v[0], v[1], v[2]};
}
Eigen::Vector3d of(const SimTK::Vec3& v) {
  return {v[0], v[1], v[2]};
}

class Model final : public SimbodyModel {
 public:
  Model(const SimbodyScene& scene, const std::string& method)
      : scene_(scene), matter_(system_), forces_(system_) {
    if (!scene.gravity.isZero(0)) SimTK::Force::Gravity(forces_, matter_, of(scene.gravity));
    for (const PeerBody& b : scene_.bodies) {
      const SimTK::Inertia about_centre(of(b.moments));
      const SimTK::Body::Rigid body(SimTK::MassProperties(
          b.mass, of(b.centre), about_centre.shiftFromMassCenter(of(Eigen::Vector3d(-b.centre)), b.mass)));
      SimTK::MobilizedBody& parent = mobods_.empty() ? matter_.updGround() : mobods_.back();
      if (b.free) {
        mobods_.push_back(SimTK::MobilizedBody::Free(parent, body));
      } else {  // a pin rotates about z
        const SimTK::Rotation turned(SimTK::UnitVec3(of(b.axis)), SimTK::ZAxis);
        mobods_.push_back(SimTK::MobilizedBody::Pin(parent, SimTK::Transform(turned, of(b.at)), body,
                                                    SimTK::Transform(turned)));
      }
    }
    system_.realizeTopology();
    if (method == "RKMerson") integrator_ = std::make_unique<SimTK::RungeKuttaMersonIntegrator>(system_);
    if (method == "RKFehlberg") integrator_ = std::make_unique<SimTK::RungeKuttaFeldbergIntegrator>(system_);
    if (method == "Verlet") integrator_ = std::make_unique<SimTK::VerletIntegrator>(system_);
    integrator_->setAllowInterpolation(false);
  }

  void start(double accuracy) override {
    SimTK::State s = system_.getDefaultState();
    if (scene_.bodies[0].free) {
      const Eigen::VectorXd &q = scene_.q0, &v = scene_.v0;
      const Eigen::Quaterniond Q(q[6], q[3], q[4], q[5]);
      mobods_[0].setQToFitTransform(
          s, SimTK::Transform(SimTK::Rotation(SimTK::Quaternion(Q.w(), Q.x(), Q.y(), Q.z())),
                              of(Eigen::Vector3d(q.head<3>()))));
      mobods_[0].setUToFitAngularVelocity(s, of(Eigen::Vector3d(Q * Eigen::Vector3d(v.tail<3>()))));
      mobods_[0].setUToFitLinearVelocity(s, of(Eigen::Vector3d(Q * Eigen::Vector3d(v.head<3>()))));
    } else {
      for (std::size_t i = 0; i < mobods_.size(); ++i)
        mobods_[i].setOneQ(s, 0, scene_.q0[int(i)]), mobods_[i].setOneU(s, 0, scene_.v0[int(i)]);
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
    q.resize(scene_.q0.size()), v.resize(scene_.v0.size());
    if (!scene_.bodies[0].free) {
      for (std::size_t i = 0; i < mobods_.size(); ++i)
        q[int(i)] = mobods_[i].getOneQ(s, 0), v[int(i)] = mobods_[i].getOneU(s, 0);
      return;
    }
    system_.realize(s, SimTK::Stage::Velocity);
    const SimTK::MobilizedBody& b = mobods_[0];
    const SimTK::Quaternion o = b.getBodyRotation(s).convertRotationToQuaternion();
    const Eigen::Quaterniond Q(o[0], o[1], o[2], o[3]), from_world = Q.conjugate();
    q << of(b.getBodyOriginLocation(s)), Q.x(), Q.y(), Q.z(), Q.w();
    v << from_world * of(b.getBodyOriginVelocity(s)), from_world * of(b.getBodyAngularVelocity(s));
  }
  long steps() const override { return integrator_->getNumStepsTaken(); }

 private:
  SimbodyScene scene_;
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::GeneralForceSubsystem forces_;
  std::vector<SimTK::MobilizedBody> mobods_;
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
