// MuJoCo (Apache-2.0): generalized coordinates; semi-implicit Euler, RK4, and Euler implicit in the velocity.

#include <mujoco/mujoco.h>

#include <fmt/format.h>
#include <cstring>
#include <scenes/peers/make_peer.hpp>

namespace liecheck::properties {
namespace {

std::string numbers(const Eigen::Vector3d& v) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", v[0], v[1], v[2]);
}

std::string model_text(const std::vector<PeerBody>& bodies, const Eigen::Vector3d& gravity,
                       const std::string& method) {
  std::string text = fmt::format(
      "<mujoco><compiler angle=\"radian\"/><option gravity=\"{}\" integrator=\"{}\"><flag "
      "contact=\"disable\" "
      "constraint=\"disable\"/></option><worldbody>",
      numbers(gravity), method);
  for (const PeerBody& b : bodies)
    text += fmt::format(
        "<body pos=\"{}\"><inertial pos=\"{}\" mass=\"{:.17g}\" diaginertia=\"{}\"/>{}", numbers(b.at),
        numbers(b.centre), b.mass, numbers(b.moments),
        b.free ? "<freejoint/>" : fmt::format("<joint type=\"hinge\" axis=\"{}\"/>", numbers(b.axis)));
  for (std::size_t i = 0; i < bodies.size(); ++i) text += "</body>";
  return text + "</worldbody></mujoco>";
}

class MujocoRunner final : public PeerRunner {
 public:
  MujocoRunner(const Benchmark& scene, const std::string& method) : PeerRunner(scene) {
    const std::string text = model_text(bodies_, scene.gravity, method);
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "scene.xml", int(text.size()));
    std::memcpy(files->filedata[0], text.data(), text.size());
    char why[300] = "";
    model_.reset(mj_loadXML("scene.xml", files.get(), why, sizeof why));
    mj_deleteFileVFS(files.get(), "scene.xml");
    if (!model_) throw std::invalid_argument(std::string("MuJoCo refuses the scene: ") + why);
    data_.reset(mj_makeData(model_.get()));
  }

 protected:
  void reset(double h) override {
    model_->opt.timestep = h;
    mj_resetData(model_.get(), data_.get());
    if (bodies_[0].free) {
      const Eigen::Quaterniond Q = attitude_of(scene_.q0);
      const Eigen::Vector3d u = Q * Eigen::Vector3d(scene_.v0.head<3>());
      for (int i = 0; i < 3; ++i)
        data_->qpos[i] = scene_.q0[i], data_->qvel[i] = u[i], data_->qvel[3 + i] = scene_.v0[3 + i];
      data_->qpos[3] = Q.w(), data_->qpos[4] = Q.x(), data_->qpos[5] = Q.y(), data_->qpos[6] = Q.z();
    } else {
      for (Eigen::Index i = 0; i < scene_.q0.size(); ++i)
        data_->qpos[i] = scene_.q0[i], data_->qvel[i] = scene_.v0[i];
    }
  }
  void step() override { mj_step(model_.get(), data_.get()); }
  void read(Eigen::VectorXd& q, Eigen::VectorXd& v) const override {
    if (bodies_[0].free) {
      const mjtNum *p = data_->qpos, *u = data_->qvel;
      const Eigen::Quaterniond Q(p[3], p[4], p[5], p[6]);
      set_free(q, v, {p[0], p[1], p[2]}, Q, {u[0], u[1], u[2]}, Q * Eigen::Vector3d(u[3], u[4], u[5]));
    } else {
      q = Eigen::Map<const Eigen::VectorXd>(data_->qpos, scene_.q0.size());
      v = Eigen::Map<const Eigen::VectorXd>(data_->qvel, scene_.v0.size());
    }
  }

 private:
  struct Free {
    void operator()(mjModel* m) const { mj_deleteModel(m); }
    void operator()(mjData* d) const { mj_deleteData(d); }
  };
  std::unique_ptr<mjModel, Free> model_;
  std::unique_ptr<mjData, Free> data_;
};

const Peer peer =
    make_peer<MujocoRunner>("MuJoCo", mj_versionString(), {{"RK4", 4}, {"Euler", 1}, {"implicit", 1}});

}  // namespace
}  // namespace liecheck::properties

LIECHECK_SCENE_PEER(liecheck::properties::peer)
