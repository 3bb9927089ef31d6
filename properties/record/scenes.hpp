#pragma once
// Scenes in a campaign's record: key "scenes", documented in docs/record.md.

#include <record/scene_sweep.hpp>

namespace liecheck::properties {

/// Adds the sweep, the cost of each stage of a plan and the films that the report shows, the last two made here.
void add_scenes(nlohmann::json& record, const SceneSweepResult& result);

}  // namespace liecheck::properties
