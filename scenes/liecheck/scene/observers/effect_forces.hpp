#pragma once
// The forces and the power of each effect alone. Gravity, which acts on the model, is here a force on each body.

#include <liecheck/scene/observers/observer.hpp>
#include <liecheck/scene/scene.hpp>

namespace liecheck::scene {

class EffectForces {
 public:
  explicit EffectForces(const Watched& watched)
      : model_(*watched.model),
        tau_(std::size_t(model_.nv)),
        f_(model_.inertias.size(), Force<double>::Zero()) {
    std::map<std::string, int> count;
    for (std::size_t i = 0; i < watched.effects->size(); ++i) {
      const Effect<double>& effect = *(*watched.effects)[i];
      Model<double> model = model_;
      model.gravity.setZero();
      effect.prepare(model);
      if (effect.acts() == Acts::OnModel && model.gravity.isZero(0)) continue;  // an inertia
      const std::string& name = watched.scene->effects[i].name;
      const int k = ++count[name];
      all_.push_back({k == 1 ? name : name + "_" + std::to_string(k), &effect, model.gravity});
    }
  }

  /// The effects that exert forces; a second one of the same name is NAME_2.
  std::size_t size() const { return all_.size(); }
  const std::string& name(std::size_t k) const { return all_[k].name; }
  const Effect<double>& effect(std::size_t k) const { return *all_[k].effect; }

  /// Computes tau() and f() of an effect, at a state with velocities.
  void evaluate(std::size_t k, Now<double> now) {
    now.switches = nullptr;
    std::ranges::fill(tau_, 0.0), std::ranges::fill(f_, Force<double>::Zero());
    if (all_[k].effect->follows()) return evaluateLast(k, now);
    all_[k].effect->add(now, {tau_, f_});
    if (all_[k].gravity.isZero(0)) return;
    for (std::size_t i = 1; i < f_.size(); ++i) {
      const Inertia<double>& I = model_.inertias[i];
      const Vector3<double> f = I.mass() * all_[k].gravity, arm = now.X_WJ[i].rotation() * I.lever();
      f_[i] = f_[i] + Force<double>(f, cross<double>(arm, f));
    }
  }
  const std::vector<double>& tau() const { return tau_; }
  const std::vector<Force<double>>& f() const { return f_; }
  /// The power of the forces of evaluate() at the same state [W].
  double power(const Now<double>& now) const {
    double power = 0;
    for (std::size_t k = 0; k < tau_.size(); ++k) power += tau_[k] * now.v[k];
    for (std::size_t i = 1; i < f_.size(); ++i) power += f_[i].dot(now.V.inWorld(i));
    return power;
  }

 private:
  /// As evaluate(), for an effect that follows from the others.
  void evaluateLast(std::size_t k, const Now<double>& now) {
    for (std::size_t i = 0; i < k; ++i) all_[i].effect->add(now, {tau_, f_});
    const auto tau = tau_;
    const auto f = f_;
    all_[k].effect->add(now, {tau_, f_});
    for (std::size_t i = 0; i < tau.size(); ++i) tau_[i] -= tau[i];
    for (std::size_t i = 0; i < f.size(); ++i) f_[i] = f_[i] - f[i];
  }
  struct One {
    std::string name;
    const Effect<double>* effect;
    Vector3<double> gravity;
  };
  const Model<double>& model_;
  std::vector<One> all_;
  std::vector<double> tau_;
  std::vector<Force<double>> f_;
};

}  // namespace liecheck::scene
