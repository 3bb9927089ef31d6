#pragma once
// Long runs of the built-in scenes whose motion has a closed form.

#include <horizons/horizons.hpp>

namespace liecheck::properties {

/// If the options have the walk `scene`, the subject liecheck and double: runs gauss12 on each of them, and reports the
/// errors against the closed form as a walk "scene NAME": the attitude's, or the position's if nothing rotates. Returns
/// false if stop_requested.
bool measure_scene_horizons(const HorizonOptions& options, const std::function<void(const Horizon&)>& report);

}  // namespace liecheck::properties
