#include <integrators/drift.hpp>

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

Drifts drifts_of(Runner& runner, const Benchmark& s, const Effort& effort, long samples) {
  scene::Tree<double> tree(s.robot, s.effects());
  const Model<double>& model = tree.model();
  Data<double> data(model, Dense::None);
  std::vector<double> times;
  std::vector<Eigen::VectorXd> energies, momenta;
  double largest = 0;  // kinetic energy: the energy at the start may be near zero
  const auto in_double = [](const std::vector<oracles::Real>& x) {
    Eigen::VectorXd y(Eigen::Index(x.size()));
    for (Eigen::Index i = 0; i < y.size(); ++i) y[i] = static_cast<double>(x[std::size_t(i)]);
    return y;
  };
  runner.run(effort, samples, [&](double t, const Moment& m) {
    const Eigen::VectorXd q = in_double(m.q), v = in_double(m.v);
    times.push_back(t);
    if (s.conservative()) {
      const double kinetic = computeKineticEnergy<double>(model, data, q, v);
      double sum = kinetic + computePotentialEnergy<double>(model, data, q);
      const auto now = tree.here(t, q, v, scene::Kinematics::Velocities);
      for (const auto& e : tree.effects()) sum += e->potential(now);
      largest = std::max(largest, kinetic);
      energies.push_back(Eigen::VectorXd::Constant(1, sum));
    }
    if (s.force_free()) momenta.push_back(computeCentroidalMomentum<double>(model, data, q, v).angular());
  });
  return {drift_of(times, energies, largest), drift_of(times, momenta)};
}

}  // namespace liecheck::properties
