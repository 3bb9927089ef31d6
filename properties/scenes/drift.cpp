#include <scenes/drift.hpp>

#include <algorithm>
#include <cmath>
#include <liecheck/algorithms/centroidal.hpp>
#include <liecheck/algorithms/energy.hpp>
#include <liecheck/scene/tree.hpp>

namespace liecheck::properties {

Drift drift_of(const std::vector<double>& t, const std::vector<Eigen::VectorXd>& x, double scale) {
  Drift d;
  if (x.size() < 3) return d;
  const double size = std::max(scale, x.front().norm()), n = double(x.size());
  if (!(size > 0)) return d;
  d.samples = x.size();
  double mean_t = 0, square = 0;
  for (double s : t) mean_t += s / n;
  for (double s : t) square += (s - mean_t) * (s - mean_t);
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(x.front().size()), slope = mean;
  for (const auto& y : x) mean += (y - x.front()) / (n * size);
  for (std::size_t i = 0; i < x.size(); ++i)
    slope += (t[i] - mean_t) / square * ((x[i] - x.front()) / size - mean);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Eigen::VectorXd rest = (x[i] - x.front()) / size - mean - (t[i] - mean_t) * slope;
    d.oscillation = std::max(d.oscillation, rest.norm());
  }
  d.slope = slope.size() == 1 ? slope[0] : slope.norm();
  return d;
}

struct DriftWatch::Parts {
  explicit Parts(const Benchmark& s)
      : scene(s), tree(s.robot, s.effects()), kinetic(tree.model(), Dense::None), moving(s.force_free()) {}
  const Benchmark& scene;
  scene::Tree<double> tree;
  Data<double> kinetic;
  bool moving;
  std::vector<double> t;
  std::vector<Eigen::VectorXd> energy, momentum;
  double scale = 0;
};

DriftWatch::DriftWatch(const Benchmark& scene) : parts_(std::make_unique<Parts>(scene)) {}
DriftWatch::~DriftWatch() = default;

void DriftWatch::see(double t, const Moment& m) {
  Parts& p = *parts_;
  Eigen::VectorXd q(Eigen::Index(m.q.size())), v(Eigen::Index(m.v.size()));
  for (Eigen::Index i = 0; i < q.size(); ++i) q[i] = static_cast<double>(m.q[std::size_t(i)]);
  for (Eigen::Index i = 0; i < v.size(); ++i) v[i] = static_cast<double>(m.v[std::size_t(i)]);
  const Model<double>& model = p.tree.model();
  p.t.push_back(t);
  if (p.scene.conservative()) {
    const double moving = computeKineticEnergy<double>(model, p.kinetic, q, v);
    double sum = moving + computePotentialEnergy<double>(model, p.kinetic, q);
    const auto now = p.tree.here(t, q, v, scene::Kinematics::Velocities);
    for (const auto& e : p.tree.effects()) sum += e->potential(now);
    p.scale = std::max(p.scale, moving);
    p.energy.push_back(Eigen::VectorXd::Constant(1, sum));
  }
  if (p.moving) {
    const auto& h = computeCentroidalMomentum<double>(model, p.kinetic, q, v);
    p.momentum.push_back(h.angular());
  }
}

/// The energy at the start may be near zero, so that the scale is at least the largest kinetic energy.
Drift DriftWatch::energy() const {
  return drift_of(parts_->t, parts_->energy, parts_->scale);
}
Drift DriftWatch::momentum() const {
  return drift_of(parts_->t, parts_->momentum);
}

}  // namespace liecheck::properties
