#include <subjects/urdf_model.hpp>

#include <liecheck/urdf/urdf.hpp>
#include <mutex>

namespace liecheck::properties {

std::shared_ptr<const UrdfModel> urdf_model(const std::string& text, bool fixed) {
  // Every law on trees asks for the same robot, of which one with thousands of joints takes a tenth of a second.
  static std::mutex mutex;
  static std::shared_ptr<const UrdfModel> last;
  const std::lock_guard lock(mutex);
  if (last && last->text == text && last->fixed == fixed) return last;
  const Model<double> m = buildModelFromUrdfText(text, fixed ? RootJoint::Fixed : RootJoint::FreeFlyer);
  return last = std::make_shared<const UrdfModel>(
             UrdfModel{text, fixed, {m.names.begin() + 1, m.names.end()}, m.nq, m.nv});
}

}  // namespace liecheck::properties
