// MuJoCo (Apache-2.0): generalized coordinates; semi-implicit Euler, RK4, and Euler implicit in the velocity.
//
// Gravity, armature, damping, springs and PD controllers (as actuators) are its own. The other forces enter
// in its callback for passive forces, at each evaluation of its equations.

#include <mujoco/mujoco.h>

#include <fmt/format.h>
#include <cstring>
#include <integrators/peers/make_peer.hpp>

namespace liecheck::properties {
namespace {

std::string numbers(const Eigen::Vector3d& v) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", v[0], v[1], v[2]);
}
std::string pose(const Eigen::Isometry3d& X) {
  const Eigen::Quaterniond Q(X.linear());
  return fmt::format(" pos=\"{}\" quat=\"{:.17g} {:.17g} {:.17g} {:.17g}\"", numbers(X.translation()), Q.w(),
                     Q.x(), Q.y(), Q.z());
}

std::string body_text(const std::vector<PeerBody>& bodies, std::size_t i) {
  const PeerBody& b = bodies[i];
  std::string text = fmt::format("<body name=\"b{}\"{}><inertial{} mass=\"{:.17g}\" diaginertia=\"{}\"/>", i,
                                 pose(b.X_PB), pose(b.X_BC), b.mass, numbers(b.moments));
  text += b.free() ? "<freejoint/>"
                   : fmt::format(
                         "<joint name=\"j{}\" type=\"{}\" axis=\"{}\" armature=\"{:.17g}\" "
                         "damping=\"{:.17g}\" stiffness=\"{:.17g}\" springref=\"{:.17g}\"/>",
                         b.v, b.joint == PeerBody::Joint::revolute ? "hinge" : "slide", numbers(b.axis),
                         b.armature, b.damping, b.stiffness, b.rest);
  for (std::size_t k = i + 1; k < bodies.size(); ++k)
    if (bodies[k].parent == int(i)) text += body_text(bodies, k);
  return text + "</body>";
}

std::string model_text(const std::vector<PeerBody>& bodies, const Benchmark& scene,
                       const std::string& method) {
  std::string text = fmt::format(
      "<mujoco><compiler angle=\"radian\"/><option gravity=\"{}\" integrator=\"{}\"><flag "
      "contact=\"disable\" "
      "constraint=\"disable\"/></option><worldbody>",
      numbers(scene.gravity), method);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].parent < 0) text += body_text(bodies, i);
  text += "</worldbody><actuator>";
  for (const Servo& s : scene.servos) {
    text += fmt::format(
        "<general joint=\"j{}\" gainprm=\"{:.17g}\" biastype=\"affine\" biasprm=\"0 {:.17g} {:.17g}\"", s.v,
        s.stiffness, -s.stiffness, -s.damping);
    if (std::isfinite(s.limit))
      text += fmt::format(" forcelimited=\"true\" forcerange=\"{:.17g} {:.17g}\"", -s.limit, s.limit);
    text += "/>";
  }
  return text + "</actuator></mujoco>";
}

class MujocoRunner final : public PeerRunner {
 public:
  MujocoRunner(const Benchmark& scene, const std::string& method)
      : PeerRunner(scene, {"joint_damping", "joint_spring", "pd"}) {
    const std::string text = model_text(bodies_, scene, method);
    const auto files = std::make_unique<mjVFS>();
    mju_user_warning = [](const char*) {};  // else MuJoCo writes them to a file in the current folder
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "scene.xml", int(text.size()));
    std::memcpy(files->filedata[0], text.data(), text.size());
    char why[300] = "";
    model_.reset(mj_loadXML("scene.xml", files.get(), why, sizeof why));
    mj_deleteFileVFS(files.get(), "scene.xml");
    if (!model_) throw std::invalid_argument(std::string("it refuses the robot: ") + why);
    data_.reset(mj_makeData(model_.get()));
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const int id = mj_name2id(model_.get(), mjOBJ_BODY, fmt::format("b{}", i).c_str());
      const int joint = model_->body_jntadr[id];
      at_.push_back({id, model_->jnt_qposadr[joint], model_->jnt_dofadr[joint]});
    }
    mjcb_passive = [](const mjModel*, mjData*) {
      if (running_) running_->add_forces();
    };
  }

 protected:
  void reset(double h) override {
    model_->opt.timestep = h;
    mj_resetData(model_.get(), data_.get());
    for (std::size_t k = 0; k < scene_.servos.size(); ++k) data_->ctrl[k] = scene_.servos[k].target;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const PeerBody& b = bodies_[i];
      mjtNum *const q = data_->qpos + at_[i].q, *const v = data_->qvel + at_[i].v;
      if (!b.free()) {
        *q = b.position(scene_.q0), *v = scene_.v0[b.v];
        continue;
      }
      const Eigen::Isometry3d X = b.pose(scene_.q0);
      const Eigen::Vector3d u = X.linear() * scene_.v0.segment<3>(b.v);
      for (int k = 0; k < 3; ++k) q[k] = scene_.q0[b.q + k], v[k] = u[k], v[3 + k] = scene_.v0[b.v + 3 + k];
      for (int k = 0; k < 4; ++k) q[3 + k] = scene_.q0[b.q + 3 + (k + 3) % 4];  // w x y z
    }
  }
  void step() override {
    running_ = load_ ? this : nullptr;
    mj_step(model_.get(), data_.get());
    running_ = nullptr;  // MuJoCo makes a step of its own when it compiles a model
  }
  void read(Eigen::VectorXd& q, Eigen::VectorXd& v) const override {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const PeerBody& b = bodies_[i];
      const mjtNum *const p = data_->qpos + at_[i].q, *const u = data_->qvel + at_[i].v;
      if (!b.free()) {
        b.set_position(q, *p), v[b.v] = *u;
        continue;
      }
      const Eigen::Quaterniond Q(p[3], p[4], p[5], p[6]);
      b.set_free(q, v, {p[0], p[1], p[2]}, Q, {u[0], u[1], u[2]}, Q * Eigen::Vector3d(u[3], u[4], u[5]));
    }
  }

 private:
  struct Place {
    int body, q, v;
  };
  /// MuJoCo calls it when positions and velocities of all bodies are known.
  void add_forces() {
    load_->t = data_->time;
    read(load_->q, load_->v);
    for (std::size_t i = 0; load_->poses && i < bodies_.size(); ++i) {
      const int id = at_[i].body;
      mjtNum V[6];  // angular, linear
      mj_objectVelocity(model_.get(), data_.get(), mjOBJ_XBODY, id, V, 0);
      load_->see(i, Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(data_->xmat + 9 * id),
                 Eigen::Map<const Eigen::Vector3d>(data_->xpos + 3 * id), {V[3], V[4], V[5]},
                 {V[0], V[1], V[2]});
    }
    load_->evaluate();
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (!bodies_[i].free()) data_->qfrc_passive[at_[i].v] += load_->tau[bodies_[i].v];
      Eigen::Map<Eigen::Matrix<double, 6, 1>> applied(data_->xfrc_applied + 6 * at_[i].body);
      const PeerLoad::Wrench& w = load_->wrenches[i];
      applied.setZero();
      if (w.acts) applied << w.force, w.moment;
    }
  }

  struct Free {
    void operator()(mjModel* m) const { mj_deleteModel(m); }
    void operator()(mjData* d) const { mj_deleteData(d); }
  };
  static thread_local MujocoRunner* running_;
  std::unique_ptr<mjModel, Free> model_;
  std::unique_ptr<mjData, Free> data_;
  std::vector<Place> at_;
};
thread_local MujocoRunner* MujocoRunner::running_ = nullptr;

const Peer peer =
    make_peer<MujocoRunner>("MuJoCo", mj_versionString(), {{"RK4", 4}, {"Euler", 1}, {"implicit", 1}}, true);

}  // namespace
}  // namespace liecheck::properties

LIECHECK_SCENE_PEER(liecheck::properties::peer)
