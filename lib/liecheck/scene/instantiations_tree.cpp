#include <liecheck/scene/integrators/registry.hpp>

namespace liecheck::scene {
template std::unique_ptr<Method<Tree<double>>> makeMethod<Tree<double>>(const std::string&,
                                                                        const MethodOptions&);
}  // namespace liecheck::scene
