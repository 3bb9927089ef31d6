#include <integrators/peers/peer.hpp>

namespace liecheck::properties {

Moment PeerRunner::moment() const {
  Eigen::VectorXd q = scene_.q0, v = scene_.v0;
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
