// Simbody: generalized coordinates, Apache-2.0. Runge-Kutta pairs and CVODES with a given accuracy, and fixed Verlet.

#include <simbody/Simbody.h>

#include <fmt/format.h>
#include <scene_peers/peer.hpp>

namespace liecheck::properties {
namespace {

SimTK::Vec3 of(const Eigen::Vector3d& v) {
  return {v[0], v[1], v[2]};
}
Eigen::Vector3d of(const SimTK::Vec3& v) {
  return {v[0], v[1], v[2]};
}

class SimbodyRunner final : public PeerRunner {
 public:
  SimbodyRunner(const Benchmark& scene, const std::string& method)
      : PeerRunner(scene), matter_(system_), forces_(system_) {
    if (!scene.gravity.isZero(0)) SimTK::Force::Gravity(forces_, matter_, of(scene.gravity));
    for (const PeerBody& b : bodies_) {
      const SimTK::Inertia about_centre(of(b.moments));
      const SimTK::Body::Rigid body(SimTK::MassProperties(
          b.mass, of(b.centre), about_centre.shiftFromMassCenter(of(Eigen::Vector3d(-b.centre)), b.mass)));
      SimTK::MobilizedBody& parent = mobods_.empty() ? matter_.updGround() : mobods_.back();
      if (b.free) {
        mobods_.push_back(SimTK::MobilizedBody::Free(parent, body));
      } else {  // pins turn about z
        const SimTK::Rotation turned(SimTK::UnitVec3(of(b.axis)), SimTK::ZAxis);
        mobods_.push_back(SimTK::MobilizedBody::Pin(parent, SimTK::Transform(turned, of(b.at)), body,
                                                    SimTK::Transform(turned)));
      }
    }
    system_.realizeTopology();
    if (method == "RKMerson") integrator_ = std::make_unique<SimTK::RungeKuttaMersonIntegrator>(system_);
    if (method == "RKFehlberg") integrator_ = std::make_unique<SimTK::RungeKuttaFeldbergIntegrator>(system_);
    if (method == "CPodes")
      integrator_ = std::make_unique<SimTK::CPodesIntegrator>(system_, SimTK::CPodes::Adams);
    if (method == "Verlet") integrator_ = std::make_unique<SimTK::VerletIntegrator>(system_);
    integrator_->setAllowInterpolation(false);
  }

  long run(const Effort& effort, long samples,
           const std::function<void(double, const Moment&)>& watch) override {
    start(effort);
    watch(0, moment());
    for (long k = 1; k <= samples; ++k) {
      to(double(k) * scene_.duration / double(samples));
      watch(double(k) * scene_.duration / double(samples), moment());
    }
    return integrator_->getNumStepsTaken();
  }
  void pass(const Effort& effort) override {
    start(effort);
    to(scene_.duration);
  }

 protected:
  void reset(double) override {}
  void step() override {}
  void read(Eigen::VectorXd& q, Eigen::VectorXd& v) const override {
    const SimTK::State& s = integrator_->getState();
    system_.realize(s, SimTK::Stage::Velocity);
    if (bodies_[0].free) {
      const SimTK::MobilizedBody& b = mobods_[0];
      const SimTK::Quaternion Q = b.getBodyRotation(s).convertRotationToQuaternion();
      set_free(q, v, of(b.getBodyOriginLocation(s)), {Q[0], Q[1], Q[2], Q[3]}, of(b.getBodyOriginVelocity(s)),
               of(b.getBodyAngularVelocity(s)));
      return;
    }
    q.resize(scene_.q0.size()), v.resize(scene_.v0.size());
    for (std::size_t i = 0; i < mobods_.size(); ++i)
      q[int(i)] = mobods_[i].getOneQ(s, 0), v[int(i)] = mobods_[i].getOneU(s, 0);
  }

 private:
  void start(const Effort& effort) {
    SimTK::State s = system_.getDefaultState();
    for (std::size_t i = 0; i < mobods_.size(); ++i)
      if (!bodies_[i].free)
        mobods_[i].setOneQ(s, 0, scene_.q0[int(i)]), mobods_[i].setOneU(s, 0, scene_.v0[int(i)]);
    if (bodies_[0].free) {
      const Eigen::Quaterniond Q = attitude_of(scene_.q0);
      mobods_[0].setQToFitTransform(
          s, SimTK::Transform(SimTK::Rotation(SimTK::Quaternion(Q.w(), Q.x(), Q.y(), Q.z())),
                              of(Eigen::Vector3d(scene_.q0.head<3>()))));
      mobods_[0].setUToFitAngularVelocity(s, of(Eigen::Vector3d(Q * Eigen::Vector3d(scene_.v0.tail<3>()))));
      mobods_[0].setUToFitLinearVelocity(s, of(Eigen::Vector3d(Q * Eigen::Vector3d(scene_.v0.head<3>()))));
    }
    integrator_->setAccuracy(effort.tolerance);
    integrator_->setFinalTime(scene_.duration);
    try {
      integrator_->initialize(s);
    } catch (const std::exception& e) {
      throw Diverged(fmt::format("at 0 s: {}", e.what()));
    }
  }
  void to(double t) try {
    while (integrator_->getTime() < t && !integrator_->isSimulationOver()) integrator_->stepTo(t);
  } catch (const std::exception& e) {
    throw Diverged(fmt::format("at {:.6g} s: {}", integrator_->getTime(), e.what()));
  }

  mutable SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::GeneralForceSubsystem forces_;
  std::vector<SimTK::MobilizedBody> mobods_;
  std::unique_ptr<SimTK::Integrator> integrator_;
};

std::string version() {
  int major = 0, minor = 0, build = 0;
  SimTK_version_simbody(&major, &minor, &build);
  return fmt::format("{}.{}.{}", major, minor, build);
}

const PeerRegistration registration(
    {"Simbody", version(),
     [](const Benchmark& s) -> std::vector<PeerMethod> {
       if (peer_bodies(s).empty()) return {};
       return {{"RKMerson", 4, true}, {"RKFehlberg", 5, true}, {"CPodes", 0, true}, {"Verlet", 2, true}};
     },
     [](const Benchmark& s, const std::string& method) {
       return std::make_unique<SimbodyRunner>(s, method);
     }});

}  // namespace
}  // namespace liecheck::properties
