#pragma once
// The lists of methods. A new method needs a file, or a tableau in runge_kutta.hpp, and an entry in both.

#include <liecheck/scene/integrators/collocation.hpp>
#include <liecheck/scene/integrators/commutator_free4.hpp>
#include <liecheck/scene/integrators/dopri5.hpp>
#include <liecheck/scene/integrators/euler.hpp>
#include <liecheck/scene/integrators/quaternion_rk4.hpp>
#include <liecheck/scene/integrators/radau5.hpp>
#include <liecheck/scene/integrators/runge_kutta.hpp>
#include <liecheck/scene/integrators/variational.hpp>
#include <liecheck/scene/lone_joint.hpp>
#include <memory>
#include <vector>

namespace liecheck::scene {

/// All methods, the simplest first.
const std::vector<MethodInfo>& methodInfos();
/// The properties of a method. Throws std::invalid_argument with the nearest names if the name is unknown.
const MethodInfo& methodInfo(const std::string& name);

/// Throws std::invalid_argument for an unknown name, and for 'variational' if Sys is a Tree.
template <System Sys>
std::unique_ptr<Method<Sys>> makeMethod(const std::string& name, const MethodOptions& options = {}) {
  if (name == "euler") return std::make_unique<Euler<Sys>>();
  if (name == "semi_implicit_euler") return std::make_unique<SemiImplicitEuler<Sys>>();
  if (name == "rk2") return std::make_unique<Rk2<Sys>>();
  if (name == "implicit_midpoint") return std::make_unique<ImplicitMidpoint<Sys>>();
  if (name == "quaternion_rk4") return std::make_unique<QuaternionRk4<Sys>>();
  if (name == "rkmk4") return std::make_unique<Rkmk4<Sys>>();
  if (name == "cf4") return std::make_unique<CommutatorFree4<Sys>>();
  if (name == "dopri5") return std::make_unique<Dopri5<Sys>>(options);
  if (name == "radau5") return std::make_unique<Radau5<Sys>>(options);
  if (name == "rkmk6") return std::make_unique<Rkmk6<Sys>>();
  if (name == "gauss6") return std::make_unique<Gauss6<Sys>>();
  if (name == "gauss12") return std::make_unique<Gauss12<Sys>>();
  if constexpr (std::is_same_v<Sys, LoneBody<typename Sys::Scalar>>) {
    if (name == "variational") return std::make_unique<Variational<typename Sys::Scalar>>();
  } else if (name == "variational") {
    throw std::invalid_argument("integrator 'variational' is for one free body only: take implicit_midpoint");
  }
  methodInfo(name);  // throws
  throw std::logic_error("integrator '" + name + "' is listed but not made");
}

// Explicit instantiation for double, in instantiations*.cpp.
extern template LoneBody<double>::LoneBody(const Model<double>&, Effects<double>);
extern template struct CollocationPoints<double>;
extern template decltype(makeMethod<LoneBody<double>>) makeMethod<LoneBody<double>>;
extern template LoneBody<double, false>::LoneBody(const Model<double>&, Effects<double>);
extern template decltype(makeMethod<ThrownBody<double>>) makeMethod<ThrownBody<double>>;
extern template decltype(makeMethod<LoneJoint<double>>) makeMethod<LoneJoint<double>>;
extern template decltype(makeMethod<Tree<double>>) makeMethod<Tree<double>>;

}  // namespace liecheck::scene
