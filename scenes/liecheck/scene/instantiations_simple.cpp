// Explicit instantiation of all methods for a thrown body and for one joint, in double.

#include <liecheck/scene/integrators/registry.hpp>

namespace liecheck::scene {

template LoneBody<double, false>::LoneBody(const Model<double>&, Effects<double>);
template decltype(makeMethod<ThrownBody<double>>) makeMethod<ThrownBody<double>>;
template decltype(makeMethod<LoneJoint<double>>) makeMethod<LoneJoint<double>>;

}  // namespace liecheck::scene
