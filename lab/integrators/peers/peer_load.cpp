#include <Eigen/Eigenvalues>
#include <algorithm>
#include <integrators/peers/peer.hpp>

namespace liecheck::properties {
namespace {

Eigen::Isometry3d pose_of(const Eigen::Matrix3d& R, const Eigen::Vector3d& p) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = R, X.translation() = p;
  return X;
}

/// Sets X_BC and the moments. Axes that are principal already are kept, so that no rounding enters.
void set_principal_axes(PeerBody& b) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  b.moments = b.inertia.diagonal();
  if (!b.inertia.isDiagonal(0)) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(b.inertia);
    axes = solver.eigenvectors(), b.moments = solver.eigenvalues();
    if (axes.determinant() < 0) axes.col(0) = -axes.col(0);
  }
  b.X_BC = pose_of(axes, b.centre);
}

class Load final : public PeerLoad {
 public:
  Load(const Benchmark& s, scene::Effects<double> effects) : robot_(s.robot), effects_(std::move(effects)) {
    for (const auto& e : effects_) poses = poses || e->needs() != scene::Kinematics::None;
    const std::size_t n = robot_.joints.size();
    X_.assign(n, SE3<double>::Identity()), V_.assign(n, Motion<double>::Zero());
    f_.assign(n, Force<double>::Zero());
    q = s.q0, v = s.v0, tau = Eigen::VectorXd::Zero(robot_.nv);
    wrenches.resize(n - 1);
    bodies_ = std::any_of(effects_.begin(), effects_.end(),
                          [](const auto& e) { return e->acts() == scene::Acts::OnBodies; });
    free_root_ = std::holds_alternative<FreeFlyer<double>>(robot_.joints[1]);
  }
  void see(std::size_t body, const Eigen::Matrix3d& R, const Eigen::Vector3d& p, const Eigen::Vector3d& u_W,
           const Eigen::Vector3d& w_W) override {
    X_[body + 1] = SE3<double>(Matrix3<double>(R), Vector3<double>(p));
    V_[body + 1] = Motion<double>(Vector3<double>(u_W), Vector3<double>(w_W));
  }
  void evaluate() override {
    const auto span = [](auto& x) { return std::span(x.data(), std::size_t(x.size())); };
    const scene::Now<double> now{t, t, span(std::as_const(q)), span(std::as_const(v)), X_, {V_, X_, true}, {}, nullptr};
    tau.setZero();
    if (bodies_) f_.assign(f_.size(), Force<double>::Zero());
    for (const auto& e : effects_) e->add(now, {span(tau), f_});
    if (!bodies_) return;
    if (free_root_) {
      const Eigen::Matrix3d& R = X_[1].rotation();
      f_[1] = f_[1] + Force<double>(Vector3<double>(R * tau.head<3>()), Vector3<double>(R * tau.segment<3>(3)));
      tau.head<6>().setZero();
    }
    for (std::size_t i = 1; i < f_.size(); ++i) {
      Wrench& w = wrenches[i - 1];
      w.acts = !(f_[i].linear().isZero(0) && f_[i].angular().isZero(0));
      if (!w.acts) continue;
      const Eigen::Vector3d f = f_[i].linear(), arm = X_[i].rotation() * robot_.inertias[i].lever();
      w.force = f, w.moment = f_[i].angular() - arm.cross(f);
    }
  }

 private:
  Model<double> robot_;
  scene::Effects<double> effects_;
  std::vector<SE3<double>> X_;
  std::vector<Motion<double>> V_;
  std::vector<Force<double>> f_;
  bool bodies_ = false, free_root_ = false;
};

}  // namespace

std::string why_no_peer(const Benchmark& s) {
  const Model<double>& m = s.robot;
  for (std::size_t i = 1; i < m.joints.size(); ++i) {
    const auto& joint = m.joints[i];
    const bool free = std::holds_alternative<FreeFlyer<double>>(joint);
    if (!free && !rotatesAboutAxis(joint) && !std::holds_alternative<Prismatic<double>>(joint))
      return "joint '" + m.names[i] + "' is neither a free-flyer nor revolute, continuous or prismatic";
    if (free && (i > 1 || !m.jointPlacements[i].translation().isZero(0) ||
                 !m.jointPlacements[i].rotation().isIdentity(0)))
      return "joint '" + m.names[i] + "' is a free-flyer that is not at the world's origin";
    for (const auto* of : {&s.armature, &s.damping, &s.stiffness})
      if (free && of->size() && !of->head<6>().isZero(0))
        return "joint '" + m.names[i] + "' is a free-flyer with armature, damping or a spring";
    if (!(m.inertias[i].mass() > 0)) return "the body of joint '" + m.names[i] + "' has no mass";
  }
  return "";
}

std::vector<PeerBody> peer_bodies(const Benchmark& s) {
  const Model<double>& m = s.robot;
  std::vector<PeerBody> bodies;
  for (std::size_t i = 1; i < m.joints.size(); ++i) {
    PeerBody b;
    const Inertia<double>& I = m.inertias[i];
    const SE3<double>& X = m.jointPlacements[i];
    b.parent = m.parents[i] - 1;
    b.q = m.idx_qs[i], b.v = m.idx_vs[i];
    b.X_PB = pose_of(X.rotation(), X.translation());
    b.mass = I.mass(), b.centre = I.lever(), b.inertia = I.inertia();
    set_principal_axes(b);
    if (const auto* turns = std::get_if<Revolute<double>>(&m.joints[i])) b.axis = turns->axis.to_vector();
    if (const auto* turns = std::get_if<Continuous<double>>(&m.joints[i]))
      b.continuous = true, b.axis = turns->axis.to_vector();
    if (const auto* slides = std::get_if<Prismatic<double>>(&m.joints[i]))
      b.joint = PeerBody::Joint::prismatic, b.axis = slides->axis.to_vector();
    if (std::holds_alternative<FreeFlyer<double>>(m.joints[i])) {
      b.joint = PeerBody::Joint::free;
    } else {
      const auto of = [&](const Eigen::VectorXd& all) { return all.size() ? all[b.v] : 0.0; };
      b.armature = of(s.armature), b.damping = of(s.damping), b.stiffness = of(s.stiffness),
      b.rest = of(s.rest);
    }
    bodies.push_back(b);
  }
  return bodies;
}

std::unique_ptr<PeerLoad> peer_load(const Benchmark& s, const std::vector<std::string>& own) {
  scene::Effects<double> mine;
  const scene::Effects<double> all = s.effects();
  for (std::size_t k = 0; k < all.size(); ++k) {
    const bool done = std::find(own.begin(), own.end(), s.effect_names[k]) != own.end();
    if (all[k]->acts() != scene::Acts::OnModel && !done) mine.push_back(all[k]);
  }
  if (mine.empty()) return nullptr;
  return std::make_unique<Load>(s, std::move(mine));
}

}  // namespace liecheck::properties
