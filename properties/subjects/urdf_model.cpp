#include <subjects/urdf_model.hpp>

#include <liecheck/urdf/urdf.hpp>

namespace liecheck::properties {

std::shared_ptr<const UrdfModel> urdf_model(const std::string& text, bool fixed) {
  const Model<double> m = buildModelFromUrdfText(text, fixed ? RootJoint::Fixed : RootJoint::FreeFlyer);
  return std::make_shared<const UrdfModel>(
      UrdfModel{text, fixed, {m.names.begin() + 1, m.names.end()}, m.nq, m.nv});
}

}  // namespace liecheck::properties
