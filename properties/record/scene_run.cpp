#include <record/scene_run.hpp>

#include <support/json_number.hpp>

namespace liecheck::properties {

using nlohmann::json;

json record_of(const scene::Scene& scene, const scene::Run& run) {
  json columns = json::array(), rows = json::array(), figures = json::array();
  for (const auto& c : run.columns) columns.push_back({{"name", c.name}, {"unit", c.unit}});
  for (std::size_t i = 0; i + run.columns.size() <= run.rows.size(); i += run.columns.size())
    rows.push_back(
        std::vector<double>(run.rows.begin() + long(i), run.rows.begin() + long(i + run.columns.size())));
  for (const auto& f : run.figures)
    figures.push_back({{"name", f.name}, {"unit", f.unit}, {"value", f.value ? number(*f.value) : json()}});
  return {{"version", LIECHECK_VERSION},
          {"scene", scene.name},
          {"reason", scene.reason},
          {"integrator", scene.integrator},
          {"step", scene.span.duration / double(scene.span.steps)},
          {"verdict", run.outcome.diverged  ? "diverged"
                      : run.outcome.stopped ? "stopped"
                                            : "complete"},
          {"why", run.outcome.why},
          {"steps", run.outcome.steps},
          {"of_steps", scene.span.steps},
          {"t", run.outcome.t},
          {"seconds", run.seconds},
          {"columns", columns},
          {"rows", rows},
          {"figures", figures}};
}

}  // namespace liecheck::properties
