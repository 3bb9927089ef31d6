#include "urdf_input.hpp"

#include <liecheck/algorithms/aba.hpp>
#include <liecheck/multibody/configuration.hpp>
#include <liecheck/urdf/urdf.hpp>

namespace liecheck::test {
namespace {

/// Computes forces and accelerations at the neutral configuration. aba may refuse massless links.
void use(const UrdfRobot& robot) {
  const Model<double>& m = robot.model;
  Data<double> d(m, m.has_mimics && m.nv < 100 ? Dense::Mass : Dense::None);
  const VectorX<double> q = neutral(m), v = VectorX<double>::Ones(m.nv);
  rnea(m, d, q, v, v);
  if (m.has_mimics && m.nv >= 100) return;
  try {
    aba(m, d, q, v, v);
  } catch (const SingularInertia&) {
  }
}

bool try_with(const std::string& text, const UrdfOptions& options) {
  try {
    use(loadUrdfText(text, options, "fuzz"));
    return true;
  } catch (const UrdfError& e) {
    const std::string what = e.what();
    if (what.empty() || what.size() > 1000 || what.find('\n') != what.npos)
      throw std::logic_error("not one short line: " + what.substr(0, 200));
    return false;
  }
}

}  // namespace

bool try_urdf(const std::string& text) {
  UrdfOptions plain, all;
  all.root = RootJoint::FreeFlyer, all.mimic = MimicJoints::Tied, all.strict = true;
  const bool loads = try_with(text, plain);
  if (try_with(text, all) && !loads)
    throw std::logic_error("accepted with strict = true, but refused without");
  return loads;
}

}  // namespace liecheck::test
