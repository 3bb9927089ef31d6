#include <record/scenes.hpp>

#include <cmath>
#include <scenes/show.hpp>
#include <support/json_number.hpp>

namespace liecheck::properties {
namespace {

using nlohmann::json;

/// Rounds to 1e-5, because 0.01 mm is less than a pixel.
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

json cost_record(const StageCost& c) {
  return {{"scene", c.scene},
          {"stage", c.stage},
          {"equation", c.equation},
          {"energy", c.energy},
          {"when", c.when},
          {"why", c.why},
          {"nanoseconds", c.nanoseconds ? number(*c.nanoseconds) : json()}};
}

}  // namespace

void add_scenes(json& record, const SceneSweepResult& result) {
  json costs = json::array(), motions = json::array();
  for (const StageCost& c : stage_costs()) costs.push_back(cost_record(c));
  for (const Film& film : films()) motions.push_back(film_record(film));
  json& scenes = record["scenes"] = record_of(result);
  scenes["costs"] = costs;
  scenes["films"] = motions;
}

}  // namespace liecheck::properties
