#include <integrators/liecheck_runner.hpp>
#include <liecheck/scene/scene.hpp>

namespace liecheck::properties {

template MakeRunner<scene::ThrownBody<double>> liecheck_runner<scene::ThrownBody<double>>;
template MakeRunner<scene::LoneBody<double>> liecheck_runner<scene::LoneBody<double>>;
template MakeRunner<scene::LoneJoint<double>> liecheck_runner<scene::LoneJoint<double>>;
template MakeRunner<scene::Tree<double>> liecheck_runner<scene::Tree<double>>;

}  // namespace liecheck::properties
