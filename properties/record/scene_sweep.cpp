#include <record/scene_sweep.hpp>

#include <record/cost.hpp>
#include <support/environment.hpp>
#include <support/json_number.hpp>

namespace liecheck::properties {
namespace {

using nlohmann::json;

json drift_record(const Drift& d) {
  if (d.samples == 0) return nullptr;
  return {{"slope", number(d.slope)}, {"oscillation", number(d.oscillation)}};
}

json point_record(const SweepPoint& p) {
  return {{"steps", p.steps > 0 ? p.steps : p.effort.steps},
          {"tolerance", p.effort.tolerance > 0 ? json(p.effort.tolerance) : json()},
          {"attitude", number_or_null(p.error.attitude)},
          {"position", number_or_null(p.error.position)},
          {"angular_velocity", number_or_null(p.error.angular_velocity)},
          {"linear_velocity", number_or_null(p.error.linear_velocity)},
          {"energy", drift_record(p.energy)},
          {"momentum", drift_record(p.momentum)},
          {"time_ns", record_of(p.time)},
          {"diverged", p.diverged}};
}

json order_record(const OrderRow& row) {
  const ObservedOrder& o = row.observed;
  return {{"integrator", row.integrator},
          {"scalar", row.scalar},
          {"promised", row.promised},
          {"exact", row.exact},
          {"observed", number(o.order)},
          {"halvings", o.halvings},
          {"first", o.first},
          {"settled", o.settled},
          {"floor", o.floor ? number(*o.floor) : json()},
          {"steps", row.steps},
          {"errors", numbers(row.errors)}};
}

json scene_record(const SceneSweep& s) {
  json series = json::array(), orders = json::array();
  for (const SweepSeries& line : s.series) {
    json points = json::array();
    for (const SweepPoint& p : line.points) points.push_back(point_record(p));
    series.push_back({{"subject", line.subject},
                      {"version", line.subject == "liecheck" ? LIECHECK_VERSION : line.version},
                      {"integrator", line.integrator},
                      {"order", line.order},
                      {"adaptive", line.adaptive},
                      {"smallest", number_or_null(line.smallest)},
                      {"at_floor", line.at_floor},
                      {"points", points}});
  }
  for (const OrderRow& row : s.orders) orders.push_back(order_record(row));
  return {{"scene", s.scene.name}, {"what", s.scene.what}, {"duration", s.scene.duration},
          {"truth", s.truth},      {"closed", s.closed},   {"disagreement", number(s.disagreement)},
          {"series", series},      {"orders", orders}};
}

json peer_record(const PeerComparison& c) {
  return {{"scene", c.scene},   {"peer", c.peer},           {"integrator", c.integrator},
          {"points", c.points}, {"ratio", number(c.ratio)}, {"error", number(c.error)},
          {"ours", c.ours},     {"unmatched", c.unmatched}};
}

json spin_record(const LongSpin& s) {
  return {{"integrator", s.integrator}, {"order", s.order},
          {"turns", s.turns},           {"steps_per_turn", s.steps_per_turn},
          {"error", number(s.error)},   {"limit", s.limit},
          {"seconds", s.seconds}};
}

json flips_record(const Flips& f) {
  return {{"perturbation", f.perturbation},
          {"scalar", f.scalar},
          {"integrator", f.integrator},
          {"exact", f.exact},
          {"relative", numbers(f.relative)},
          {"predicted", f.predicted},
          {"horizon", f.horizon}};
}

}  // namespace

json record_of(const SceneSweepResult& r) {
  json scenes = json::array(), peers = json::array(), spins = json::array(), flips = json::array();
  for (const SceneSweep& s : r.scenes) scenes.push_back(scene_record(s));
  for (const PeerComparison& c : r.peers) peers.push_back(peer_record(c));
  for (const LongSpin& s : r.spins) spins.push_back(spin_record(s));
  for (const Flips& f : r.flips) flips.push_back(flips_record(f));
  return {{"version", LIECHECK_VERSION},
          {"verdict", !r.complete       ? "incomplete"
                      : r.wrong.empty() ? "pass"
                                        : "fail"},
          {"environment", environment()},
          {"elapsed", r.elapsed},
          {"wrong_orders", r.wrong},
          {"absent", absent_peers()},
          {"scenes", scenes},
          {"peers", peers},
          {"spins", spins},
          {"flips", flips}};
}

}  // namespace liecheck::properties
