// The JSON of a scene sweep.

#include <app/scene_sweep_command.hpp>

#include <cmath>
#include <nlohmann/json.hpp>
#include <support/environment.hpp>

namespace liecheck::properties {
namespace {

using nlohmann::json;

/// NaN stands for a number that a scene has not.
json number(double x) {
  if (std::isnan(x)) return nullptr;
  return std::isfinite(x) ? json(x) : json("inf");
}

json drift_of(const Drift& d) {
  if (d.samples == 0) return nullptr;
  return {{"slope", number(d.slope)}, {"oscillation", number(d.oscillation)}};
}

json point_of(const SweepPoint& p) {
  json time;
  if (p.time.repetitions > 0)
    time = {{"median", p.time.median},
            {"low", p.time.low},
            {"high", p.time.high},
            {"repetitions", p.time.repetitions}};
  return {{"steps", p.steps > 0 ? p.steps : p.effort.steps},
          {"tolerance", p.effort.tolerance > 0 ? json(p.effort.tolerance) : json()},
          {"attitude", number(p.error.attitude)},
          {"position", number(p.error.position)},
          {"angular_velocity", number(p.error.angular_velocity)},
          {"linear_velocity", number(p.error.linear_velocity)},
          {"energy", drift_of(p.energy)},
          {"momentum", drift_of(p.momentum)},
          {"time_ns", time},
          {"diverged", p.diverged}};
}

json order_of(const OrderRow& row) {
  const ObservedOrder& o = row.observed;
  json errors = json::array();
  for (double e : row.errors) errors.push_back(number(e));
  return {{"integrator", row.integrator},
          {"scalar", row.scalar},
          {"promised", row.promised},
          {"exact", row.exact},
          {"observed", o.order},
          {"halvings", o.halvings},
          {"first", o.first},
          {"settled", o.settled},
          {"floor", o.floor ? number(*o.floor) : json()},
          {"steps", row.steps},
          {"errors", errors}};
}

json scene_of(const SceneSweep& s) {
  json series = json::array(), orders = json::array();
  for (const SweepSeries& line : s.series) {
    json points = json::array();
    for (const SweepPoint& p : line.points) points.push_back(point_of(p));
    series.push_back({{"subject", line.subject},
                      {"version", line.subject == "liecheck" ? LIECHECK_VERSION : line.version},
                      {"integrator", line.integrator},
                      {"order", line.order},
                      {"adaptive", line.adaptive},
                      {"smallest", number(line.smallest)},
                      {"at_floor", line.at_floor},
                      {"points", points}});
  }
  for (const OrderRow& row : s.orders) orders.push_back(order_of(row));
  return {{"scene", s.scene.name}, {"what", s.scene.what}, {"duration", s.scene.duration},
          {"truth", s.truth},      {"closed", s.closed},   {"disagreement", s.disagreement},
          {"series", series},      {"orders", orders}};
}

}  // namespace

json scene_sweep_record(const SceneSweepResult& r) {
  json scenes = json::array(), peers = json::array(), spins = json::array(), flips = json::array();
  for (const SceneSweep& s : r.scenes) scenes.push_back(scene_of(s));
  for (const PeerComparison& c : r.peers)
    peers.push_back({{"scene", c.scene},
                     {"peer", c.peer},
                     {"integrator", c.integrator},
                     {"points", c.points},
                     {"ratio", c.ratio},
                     {"error", c.error},
                     {"ours", c.ours},
                     {"unmatched", c.unmatched}});
  for (const LongSpin& s : r.spins)
    spins.push_back({{"integrator", s.integrator},
                     {"order", s.order},
                     {"turns", s.turns},
                     {"steps_per_turn", s.steps_per_turn},
                     {"error", number(s.error)},
                     {"limit", s.limit},
                     {"seconds", s.seconds}});
  for (const Flips& f : r.flips) {
    json relative = json::array();
    for (double e : f.relative) relative.push_back(number(e));
    flips.push_back({{"perturbation", f.perturbation},
                     {"scalar", f.scalar},
                     {"integrator", f.integrator},
                     {"exact", f.exact},
                     {"relative", relative},
                     {"predicted", f.predicted},
                     {"horizon", f.horizon}});
  }
  return {{"version", LIECHECK_VERSION},
          {"verdict", !r.complete       ? "incomplete"
                      : r.wrong.empty() ? "pass"
                                        : "fail"},
          {"environment", json::parse(environment_text())},
          {"elapsed", r.elapsed},
          {"wrong_orders", r.wrong},
          {"absent", absent_peers()},
          {"scenes", scenes},
          {"peers", peers},
          {"spins", spins},
          {"flips", flips}};
}

}  // namespace liecheck::properties
