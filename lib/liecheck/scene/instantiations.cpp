// double, compiled once; declared extern in the registries.

#include <liecheck/scene/effects/registry.hpp>
#include <liecheck/scene/integrators/registry.hpp>

namespace liecheck::scene {
template std::unique_ptr<Method<LoneBody<double>>> makeMethod<LoneBody<double>>(const std::string&,
                                                                                const MethodOptions&);
template std::unique_ptr<Method<Tree<double>>> makeMethod<Tree<double>>(const std::string&,
                                                                        const MethodOptions&);
template const std::vector<EffectEntry<double>>& effectEntries<double>();
template const std::vector<EffectEntry<double>>& actuationEntries<double>();
}  // namespace liecheck::scene
