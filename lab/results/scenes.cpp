#include <results/scenes.hpp>

#include <cmath>
#include <integrators/peers/peer.hpp>
#include <integrators/show.hpp>
#include <record/record.hpp>
#include <support/environment.hpp>
#include <support/json_number.hpp>

namespace liecheck::properties {
namespace {

using nlohmann::json;

json drift_record(const Drift& d) {
  if (d.samples == 0) return nullptr;
  return {{"slope", number(d.slope)}, {"oscillation", number(d.oscillation)}};
}

json errors_record(const MotionError& e) {
  return {{"attitude", number_or_null(e.attitude)},
          {"position", number_or_null(e.position)},
          {"angular_velocity", number_or_null(e.angular_velocity)},
          {"linear_velocity", number_or_null(e.linear_velocity)}};
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

json series_record(const SweepSeries& s) {
  return {{"subject", s.subject},       {"version", s.subject == "liecheck" ? LIECHECK_VERSION : s.version},
          {"integrator", s.integrator}, {"order", s.order},
          {"adaptive", s.adaptive},     {"smallest", number_or_null(s.smallest)},
          {"at_floor", s.at_floor},     {"points", list_of(s.points, point_record)}};
}

json scene_record(const SceneSweep& s) {
  return {{"scene", s.scene.name},
          {"what", s.scene.what},
          {"duration", s.scene.duration},
          {"truth", s.truth},
          {"closed", s.closed},
          {"disagreement", errors_record(s.disagreement)},
          {"left_out", list_of(s.left_out,
                               [](const LeftOut& l) -> json {
                                 return {{"peer", l.peer}, {"why", l.why}};
                               })},
          {"series", list_of(s.series, series_record)},
          {"orders", list_of(s.orders, order_record)}};
}

json peer_record(const PeerComparison& c) {
  return {{"scene", c.scene},         {"peer", c.peer},       {"integrator", c.integrator},
          {"measure", c.measure},     {"points", c.points},   {"behind", c.behind},
          {"ratio", number(c.ratio)}, {"low", number(c.low)}, {"high", number(c.high)},
          {"error", number(c.error)}, {"ours", c.ours},       {"unmatched", c.unmatched}};
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

/// Rounds to 1e-5, because 0.01 mm is less than a pixel.
template <class Numbers>
json rounded(const Numbers& numbers) {
  return list_of(numbers, [](double x) { return std::round(x * 1e5) / 1e5 + 0.0; });
}

json link_record(const Film::Link& link) {
  return {{"name", link.name},
          {"centre", rounded(link.centre)},
          {"half", rounded(link.half)},
          {"axes", rounded(link.axes)},
          {"joints", list_of(link.joints, [](const auto& p) { return rounded(p); })}};
}

json film_record(const Film& film) {
  const auto poses = [](const auto& frame) {
    return list_of(frame, [](const auto& pose) { return rounded(pose); });
  };
  return {{"name", film.name},
          {"what", film.what},
          {"integrator", film.integrator},
          {"interval", film.interval},
          {"ground", film.ground ? json(*film.ground) : json()},
          {"links", list_of(film.links, link_record)},
          {"frames", list_of(film.frames, poses)}};
}

json cost_record(const StageCost& c) {
  return {{"scene", c.scene},
          {"stage", c.stage},
          {"equation", c.equation},
          {"energy", c.energy},
          {"when", c.when},
          {"why", c.why},
          {"nanoseconds", c.nanoseconds ? number(*c.nanoseconds) : json()},
          {"instructions", c.instructions ? json(*c.instructions) : json()}};
}

}  // namespace

json record_of(const SceneSweepResult& r) {
  json record = {{"version", LIECHECK_VERSION},
                 {"verdict", verdict_of(r.complete, r.wrong.empty())},
                 {"environment", environment()},
                 {"elapsed", r.elapsed},
                 {"wrong_orders", r.wrong},
                 {"absent", absent_peers()},
                 {"scenes", list_of(r.scenes, scene_record)},
                 {"peers", list_of(r.peers, peer_record)},
                 {"spins", list_of(r.spins, spin_record)},
                 {"flips", list_of(r.flips, flips_record)}};
  if (r.for_report && r.complete) {  // a sweep that was stopped does not wait for them
    record["costs"] = list_of(stage_costs(), cost_record);
    record["films"] = list_of(films(), film_record);
  }
  return record;
}

}  // namespace liecheck::properties
