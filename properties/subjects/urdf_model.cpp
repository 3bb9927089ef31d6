#include <subjects/urdf_model.hpp>

#include <mutex>
#include <subjects/urdf_options.hpp>

namespace liecheck::properties {

std::shared_ptr<const UrdfModel> urdf_model(const std::string& text, bool fixed, bool coupled) {
  // Every law on trees asks for the same robot, of which one with thousands of joints takes a tenth of a second.
  static std::mutex mutex;
  static std::shared_ptr<const UrdfModel> last;
  const std::lock_guard lock(mutex);
  if (last && last->text == text && last->fixed == fixed && last->coupled == coupled) return last;
  const Model<double> m = loadUrdfText(text, urdf_options(fixed, coupled)).model;
  return last = std::make_shared<const UrdfModel>(
             UrdfModel{text, fixed, coupled, {m.names.begin() + 1, m.names.end()}, m.nq, m.nv});
}

}  // namespace liecheck::properties
