#pragma once
// Checked values of YAML nodes: names, kinds and units, with the line in each message.

#include <yaml-cpp/yaml.h>
#include <liecheck/multibody/model.hpp>
#include <liecheck/multibody/nearest_names.hpp>
#include <liecheck/scene/parameters.hpp>
#include <map>
#include <string>
#include <vector>

namespace liecheck::scene_file_detail {

using multibody_detail::nearestNames;

/// Reads the nodes of one scene file. Its messages begin with FILE:LINE.
class Text {
 public:
  /// Files that the scene names lie in the folder of the scene, or in one of `outside`.
  explicit Text(std::string file, std::string folder = ".", std::vector<std::string> outside = {})
      : file_(std::move(file)), folder_(std::move(folder)), outside_(std::move(outside)) {}
  /// Throws SceneError.
  [[noreturn]] void refuse(int line, const std::string& what) const;
  [[noreturn]] void refuse(const YAML::Node& node, const std::string& what) const {
    refuse(lineOf(node), what);
  }
  static int lineOf(const YAML::Node& node);
  const std::string& file() const { return file_; }
  const std::vector<std::string>& named() const { return named_; }  ///< the results of path()

  /// Refuses a node that is not a map, unknown keys and repeated keys. what names the node in messages.
  void checkKeys(const YAML::Node& node, const std::string& what, const std::vector<std::string>& keys) const;
  /// The index of name in names. Refuses a name that is not there: `unknown`, then the nearest names.
  std::size_t place(const YAML::Node& node, const std::string& name, const std::vector<std::string>& names,
                    const std::string& unknown) const;
  /// The entry of a part whose member `info` has that name, like place().
  template <class Entry>
  const Entry& entry(const YAML::Node& node, const std::string& name, const std::vector<Entry>& entries,
                     const std::string& unknown) const {
    std::vector<std::string> names;
    for (const Entry& e : entries) names.emplace_back(infoOf(e.info).name);
    return entries[place(node, name, names, unknown)];
  }
  std::string word(const YAML::Node& node, const std::string& what) const;
  /// The path of the file that the node names, with links resolved. Refuses one that lies elsewhere. A robot, a file
  /// *.urdf, may also lie in a folder beside that of the scene.
  std::string path(const YAML::Node& node, const std::string& what) const;
  double number(const YAML::Node& node, const std::string& what, const std::string& unit,
                scene::Kind kind = scene::Kind::Number) const;
  std::vector<double> numbers(const YAML::Node& node, const std::string& what, const std::string& unit,
                              int count = -1) const;
  /// Returns f(). Turns its std::invalid_argument and std::domain_error into a SceneError of this line.
  template <class F>
  auto at(int line, F f) const {
    try {
      return f();
    } catch (const std::invalid_argument& e) {
      refuse(line, e.what());
    } catch (const std::domain_error& e) {
      refuse(line, e.what());
    }
  }

  /// The parameters of a part with its defaults. Keys in `others` are accepted but not read. If a model is
  /// given, names of frames and joints must exist in it.
  scene::Parameters parameters(const YAML::Node& node, int line, const std::string& what,
                               const std::vector<scene::Key>& schema, const Model<double>* model,
                               const std::vector<std::string>& others = {}) const;

 private:
  static const scene::PartInfo& infoOf(const scene::PartInfo& info) { return info; }
  static const scene::PartInfo& infoOf(const scene::PartInfo* info) { return *info; }
  scene::Value value(const YAML::Node& node, const std::string& what, const scene::Key& key,
                     const Model<double>* model) const;
  scene::Value table(const YAML::Node& node, const std::string& what, const std::string& unit) const;
  std::string file_, folder_;
  std::vector<std::string> outside_;
  mutable std::vector<std::string> named_;
  mutable std::map<std::string, YAML::Node> fallbacks_;  ///< the defaults of keys that were read
};

}  // namespace liecheck::scene_file_detail
