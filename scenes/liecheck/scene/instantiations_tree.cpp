#include <liecheck/scene/integrators/registry.hpp>

namespace liecheck::scene {
template decltype(makeMethod<Tree<double>>) makeMethod<Tree<double>>;
}  // namespace liecheck::scene
