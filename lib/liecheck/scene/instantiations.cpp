// Explicit instantiations for double. Those of the methods of Tree are in instantiations_tree.cpp.

#include <liecheck/scene/effects/registry.hpp>
#include <liecheck/scene/integrators/registry.hpp>

namespace liecheck::scene {
template std::unique_ptr<Method<LoneBody<double>>> makeMethod<LoneBody<double>>(const std::string&,
                                                                                const MethodOptions&);
template const std::vector<EffectEntry<double>>& effectEntries<double>();
template const std::vector<EffectEntry<double>>& actuationEntries<double>();
}  // namespace liecheck::scene
