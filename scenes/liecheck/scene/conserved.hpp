#pragma once
// What a motion must keep, at the states of a run: energy and momentum, if no effect changes them, and that the energy does
// not grow if the effects only conserve or dissipate it. The band is 1 % of the largest kinetic energy so far, and of the
// largest momentum that this energy allows.

#include <liecheck/scene/observers/energy.hpp>
#include <liecheck/scene/observers/momentum.hpp>
#include <liecheck/scene/setup.hpp>

namespace liecheck::scene {

inline bool momentumLeft(const Model<double>& model, const Now<double>& now, const Force<double>& h,
                         const Force<double>& h0, double kinetic) {
  double mass = 0, inertia = 0;
  Vector3<double> c = Vector3<double>::Zero();
  for (std::size_t i = 1; i < model.inertias.size(); ++i) mass += model.inertias[i].mass();
  for (std::size_t i = 1; i < model.inertias.size(); ++i)
    c += model.inertias[i].mass() / mass * now.X_WJ[i].act(model.inertias[i].lever());
  for (std::size_t i = 1; i < model.inertias.size(); ++i)
    inertia += model.inertias[i].inertia().trace() +
               model.inertias[i].mass() * (now.X_WJ[i].act(model.inertias[i].lever()) - c).squaredNorm();
  return (h.linear() - h0.linear()).norm() > 0.01 * std::sqrt(2 * kinetic * mass) ||
         (h.angular() - h0.angular()).norm() > 0.01 * std::sqrt(2 * kinetic * inertia);
}

/// The time of the first state at which one of them is left, and which; none if all are kept.
template <class Sys>
std::optional<std::pair<double, std::string>> leftAt(Setup<Sys>& setup,
                                                     const std::vector<Checkpoint<Sys>>& points) {
  const Scene& scene = setup.scene;
  bool energy = true, passive = true,
       momentum = std::holds_alternative<FreeFlyer<double>>(scene.model.joints[1]);
  for (std::size_t i = 0; i < setup.effects.size(); ++i) {
    const auto& effect = *setup.effects[i];
    energy = energy && effect.conservative(), passive = passive && effect.passive();
    const bool inner = effect.acts() == Acts::OnJoints || scene.effects[i].name == "armature";
    momentum = momentum && inner;
    if (inner)
      for (const std::string& name : scene.effects[i].parameters.names("joints"))
        momentum = momentum && name != scene.model.names[1];
  }
  if (!passive && !momentum) return {};
  std::optional<double> least;  // energy so far; that of the start if it is conserved
  Force<double> h0 = Force<double>::Zero();
  double kinetic = 0;
  for (const auto& point : points) {
    const auto now = setup.look(point.state, Kinematics::Velocities);
    const double T = kineticEnergy(setup.system.model(), now);
    double E = T;
    for (const auto& e : setup.effects) E += e->potential(now);
    const Force<double> h = centroidalMomentum(setup.system.model(), now);
    if (!least) least = E, h0 = h;
    kinetic = std::max(kinetic, T);
    const char* what = nullptr;
    if (energy && std::abs(E - *least) > 0.01 * kinetic)
      what = "energy changes by more than 1 %, and no effect of the scene changes it";
    else if (passive && E - *least > 0.01 * kinetic)
      what = "energy grows by more than 1 %, and the effects of the scene only dissipate it";
    else if (momentum && momentumLeft(setup.system.model(), now, h, h0, kinetic))
      what = "momentum changes by more than 1 %, and no effect of the scene changes it";
    if (what) return std::pair(point.state.t, std::string(what));
    if (!energy) least = std::min(*least, E);
  }
  return {};
}

}  // namespace liecheck::scene
