#include <scenes/peers/peer.hpp>

namespace liecheck::properties {

std::vector<PeerBody> peer_bodies(const Benchmark& s) {
  const Model<double>& m = s.robot;
  if (s.others || s.stiffness.size() || s.damping.size() || !m.armature.isZero(0)) return {};
  std::vector<PeerBody> bodies;
  for (std::size_t i = 1; i < m.joints.size(); ++i) {
    const Inertia<double>& I = m.inertias[i];
    if (m.parents[i] != int(i) - 1 || !m.jointPlacements[i].rotation().isIdentity(0) ||
        !I.inertia().isDiagonal(0))
      return {};
    PeerBody b;
    b.parent = int(i) - 2;
    b.at = m.jointPlacements[i].translation();
    b.mass = I.mass(), b.centre = I.lever(), b.moments = I.inertia().diagonal();
    b.free = std::holds_alternative<FreeFlyer<double>>(m.joints[i]);
    const auto* turning = std::get_if<Revolute<double>>(&m.joints[i]);
    if (b.free ? i > 1 || !b.at.isZero(0) || m.njoints > 2 : !turning) return {};
    if (turning) b.axis = turning->axis.to_vector();
    bodies.push_back(b);
  }
  return bodies;
}

Moment PeerRunner::moment() const {
  Eigen::VectorXd q, v;
  read(q, v);
  if (!q.allFinite() || !v.allFinite()) throw Diverged("a number is no longer finite");
  Moment m;
  for (double x : q) m.q.push_back(oracles::Real(x));
  for (double x : v) m.v.push_back(oracles::Real(x));
  return m;
}

long PeerRunner::run(const Effort& effort, long samples,
                     const std::function<void(double, const Moment&)>& watch) {
  reset(scene_.duration / double(effort.steps));
  watch(0, moment());
  for (long k = 1; k <= samples; ++k) {
    advance(effort.steps / samples);
    watch(double(k) * scene_.duration / double(samples), moment());
  }
  return effort.steps;
}

void PeerRunner::pass(const Effort& effort) {
  reset(scene_.duration / double(effort.steps));
  advance(effort.steps);
}

void PeerRunner::advance(long steps) {
  for (long i = 0; i < steps; ++i) {
    if (stopped()) throw Stopped();
    step();
  }
}

}  // namespace liecheck::properties
