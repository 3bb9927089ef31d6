// The list of methods, and explicit instantiations for double. Those of Tree are in instantiations_tree.cpp.

#include <liecheck/multibody/nearest_names.hpp>
#include <liecheck/scene/effects/registry.hpp>
#include <liecheck/scene/integrators/registry.hpp>

namespace liecheck::scene {

const std::vector<MethodInfo>& methodInfos() {
  using Any = LoneBody<double>;
  static const std::vector<MethodInfo> all = {
      Euler<Any>::info,       SemiImplicitEuler<Any>::info, MidpointTableau::info,
      collocation_info<1>,    Variational<double>::info,    QuaternionRk4<Any>::info,
      ClassicalTableau::info, CommutatorFree4<Any>::info,   Dopri5<Any>::info,
      Radau5<Any>::info,      ButcherTableau::info,         collocation_info<3>,
      collocation_info<6>};
  return all;
}
const MethodInfo& methodInfo(const std::string& name) {
  std::vector<std::string> names;
  for (const MethodInfo& m : methodInfos()) {
    if (m.name == name) return m;
    names.push_back(m.name);
  }
  throw std::invalid_argument("no integrator is named '" + name + "'" +
                              multibody_detail::nearestNames(name, names));
}

template LoneBody<double>::LoneBody(const Model<double>&, Effects<double>);
template struct CollocationPoints<double>;
template decltype(makeMethod<LoneBody<double>>) makeMethod<LoneBody<double>>;
template const std::vector<EffectEntry<double>>& effectEntries<double>();
template const std::vector<EffectEntry<double>>& actuationEntries<double>();

}  // namespace liecheck::scene
