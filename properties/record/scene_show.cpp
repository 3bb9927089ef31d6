// The JSON of what the page shows of scenes: sweep, costs of stages, films.

#include <app/scene_sweep_command.hpp>

#include <cmath>
#include <nlohmann/json.hpp>
#include <scenes/show.hpp>

namespace liecheck::properties {
namespace {

using nlohmann::json;

/// A hundredth of a millimetre is less than a pixel.
template <class Numbers>
json rounded(const Numbers& numbers) {
  json list = json::array();
  for (double x : numbers) list.push_back(std::round(x * 1e5) / 1e5 + 0.0);
  return list;
}

json film_record(const Film& film) {
  json links = json::array(), frames = json::array();
  for (const Film::Link& link : film.links) {
    json joints = json::array();
    for (const auto& p : link.joints) joints.push_back(rounded(p));
    links.push_back({{"name", link.name},
                     {"centre", rounded(link.centre)},
                     {"half", rounded(link.half)},
                     {"axes", rounded(link.axes)},
                     {"joints", joints}});
  }
  for (const auto& frame : film.frames) {
    json poses = json::array();
    for (const auto& pose : frame) poses.push_back(rounded(pose));
    frames.push_back(poses);
  }
  return {{"name", film.name},
          {"what", film.what},
          {"integrator", film.integrator},
          {"interval", film.interval},
          {"ground", film.ground ? json(*film.ground) : json()},
          {"links", links},
          {"frames", frames}};
}

}  // namespace

void add_scene_sweep(json& record, const SceneSweepResult& result) {
  json scenes = scene_sweep_record(result), costs = json::array(), all = json::array();
  for (const StageCost& c : stage_costs())
    costs.push_back({{"scene", c.scene},
                     {"stage", c.stage},
                     {"equation", c.equation},
                     {"energy", c.energy},
                     {"when", c.when},
                     {"why", c.why},
                     {"nanoseconds", c.nanoseconds ? json(*c.nanoseconds) : json()}});
  for (const Film& film : films()) all.push_back(film_record(film));
  scenes["costs"] = costs;
  scenes["films"] = all;
  record["scenes"] = scenes;
}

}  // namespace liecheck::properties
