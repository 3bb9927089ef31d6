#pragma once
// The collision shapes and the ground of a scene file.

#include <liecheck/scene/scene.hpp>
#include <liecheck/scene_file/values.hpp>

namespace liecheck::scene_file_detail {

/// The kinds of shapes, for the list of keys.
const std::vector<scene::PartInfo>& shapeInfos();

/// The shape of a built-in body; none for 'top' and 'body'. `kind` and `p` are those of scene::bodyEntries().
std::vector<scene::Shape> shapeOfBody(const std::string& kind, const scene::Parameters& p,
                                      const std::string& body, int frame);

/// The <collision> elements of a URDF text that loadUrdfText accepts, whose model is given. A cylinder with
/// spheres of its radius about both ends is one capsule. What is not a sphere, cylinder, capsule or box is
/// unusable.
std::vector<scene::Shape> shapesOfUrdf(const std::string& urdf, const Model<double>& model);

/// Adds the key `shapes`. It replaces the other shapes of each body that it names.
void readShapes(const Text& text, const YAML::Node& shapes, scene::Scene& scene);

/// Reads the key `ground`.
void readGround(const Text& text, const YAML::Node& ground, scene::Scene& scene);

}  // namespace liecheck::scene_file_detail
