#pragma once
// Scenes in a campaign's record: key "scenes", documented in docs/record.md.

#include <record/scene_sweep.hpp>

namespace liecheck::properties {

/// Adds the sweep. Measures and adds the costs of stages, and makes and adds the films that the report shows.
void add_scenes(nlohmann::json& record, const SceneSweepResult& result);

}  // namespace liecheck::properties
