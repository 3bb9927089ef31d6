#pragma once
// The run of one scene as a record, which `liecheck scene run --json` writes; documented in docs/record.md.

#include <liecheck/scene/run.hpp>
#include <nlohmann/json_fwd.hpp>

namespace liecheck::properties {

nlohmann::json record_of(const scene::Scene& scene, const scene::Run& run);

}  // namespace liecheck::properties
