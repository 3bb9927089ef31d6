#include <liecheck/scene/run.hpp>
#include <record/record.hpp>
#include <support/json_number.hpp>

namespace liecheck::properties {
namespace {

using nlohmann::json;

json estimate_record(const scene::Estimate& e) {
  const auto alarm = [](const scene::Alarm& a) -> json {
    return {{"t", a.t},
            {"what", a.what},
            {"cause", a.cause},
            {"remedy", a.remedy},
            {"step", a.step > 0 ? json(a.step) : json()}};
  };
  return {{"position", number_or_null(e.error.position)},
          {"angle", number_or_null(e.error.angle)},
          {"linear_velocity", number_or_null(e.error.linear_velocity)},
          {"angular_velocity", number_or_null(e.error.angular_velocity)},
          {"accepted_position", e.accepted.position},
          {"accepted_angle", e.accepted.angle},
          {"order", e.order ? number(*e.order) : json()},
          {"by", e.by},
          {"cost", e.cost},
          {"seconds", e.seconds},
          {"checkpoints", e.checkpoints},
          {"alarms", list_of(e.alarms, alarm)}};
}

}  // namespace

json record_of(const scene::Scene& scene, const scene::Run& run) {
  json rows = json::array();
  for (std::size_t i = 0; i + run.columns.size() <= run.rows.size(); i += run.columns.size())
    rows.push_back(
        std::vector<double>(run.rows.begin() + long(i), run.rows.begin() + long(i + run.columns.size())));
  const auto column = [](const auto& c) -> json { return {{"name", c.name}, {"unit", c.unit}}; };
  const auto figure = [](const auto& f) -> json {
    return {{"name", f.name}, {"unit", f.unit}, {"value", f.value ? number(*f.value) : json()}};
  };
  return {{"version", LIECHECK_VERSION},
          {"scene", scene.name},
          {"reason", scene.reason},
          {"integrator", scene.integrator},
          {"step", scene.span.duration / double(scene.span.steps)},
          {"verdict", run.outcome.diverged                            ? "diverged"
                      : run.outcome.stopped                           ? "stopped"
                      : run.estimate && !run.estimate->alarms.empty() ? "alarm"
                                                                      : "complete"},
          {"why", run.outcome.why},
          {"steps", run.outcome.steps},
          {"of_steps", scene.span.steps},
          {"t", run.outcome.t},
          {"seconds", run.seconds},
          {"columns", list_of(run.columns, column)},
          {"rows", rows},
          {"figures", list_of(run.figures, figure)},
          {"estimate", run.estimate ? estimate_record(*run.estimate) : json()}};
}

}  // namespace liecheck::properties
