#include <adapters/flat_model.hpp>

#include <adapters/trees.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <support/json.hpp>

namespace liecheck::properties::adapters {
namespace {

template <std::size_t N>
void read(const nlohmann::json& from, double (&to)[N]) {
  for (std::size_t i = 0; i < N; ++i) to[i] = from.at(i);
}

liecheck_joint joint_of(const nlohmann::json& j) {
  liecheck_joint to{};
  to.kind = std::ranges::find(joint_names(), j.at("kind").get<std::string>())->c_str();
  to.parent = j.at("parent");
  read(j.at("Q"), to.Q), read(j.at("p"), to.p);
  if (j.contains("axis")) read(j.at("axis"), to.axis);
  to.pitch = j.value("pitch", 0.0), to.armature = j.value("armature", 0.0);
  to.mimic = j.value("mimic", -1);
  to.multiplier = j.value("multiplier", 1.0), to.offset = j.value("offset", 0.0);
  return to;
}
liecheck_body body_of(const nlohmann::json& b) {
  liecheck_body to{};
  to.joint = b.at("joint"), to.mass = b.at("mass");
  read(b.at("Q"), to.Q), read(b.at("p"), to.p), read(b.at("c"), to.c), read(b.at("I_C"), to.I_C);
  return to;
}

}  // namespace

FlatModel::FlatModel(std::string_view text) {
  const nlohmann::json j = parsed(text);
  read(j.at("gravity"), model_.gravity);
  model_.nq = j.at("nq"), model_.nv = j.at("nv");
  if (j.contains("urdf")) {
    urdf_ = j.at("urdf"), order_ = j.at("order");
    for (const std::string& name : order_) names_.push_back(name.c_str());
    model_.urdf = urdf_.c_str(), model_.fixed = j.at("root") == "fixed";
    model_.order = names_.data(), model_.order_count = names_.size();
    return;
  }
  for (const auto& joint : j.at("joints")) joints_.push_back(joint_of(joint));
  for (const auto& body : j.at("bodies")) bodies_.push_back(body_of(body));
  model_.joints = joints_.data(), model_.joint_count = joints_.size();
  model_.bodies = bodies_.data(), model_.body_count = bodies_.size();
}

}  // namespace liecheck::properties::adapters
