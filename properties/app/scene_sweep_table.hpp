#pragma once
// A sweep of scenes as text.

#include <record/scene_sweep.hpp>

namespace liecheck::properties {

void print_scene_sweep(const SceneSweepResult& result);

}  // namespace liecheck::properties
