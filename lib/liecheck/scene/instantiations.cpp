// Explicit instantiations for double. Those of the methods of Tree are in instantiations_tree.cpp.

#include <liecheck/scene/effects/registry.hpp>
#include <liecheck/scene/integrators/registry.hpp>

namespace liecheck::scene {
template decltype(makeMethod<LoneBody<double>>) makeMethod<LoneBody<double>>;
template const std::vector<EffectEntry<double>>& effectEntries<double>();
template const std::vector<EffectEntry<double>>& actuationEntries<double>();
}  // namespace liecheck::scene
