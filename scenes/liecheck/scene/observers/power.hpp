#pragma once
// The power of each effect, and the energy ledger of a scene.
//
//   power_e = sum tau_e v + sum_i f_e,i . V_i
//   work_e = integral of power_e from the start, of each effect e that is not conservative
//   ledger = E(t) - E(0) - sum work_e,     E = T + sum of the potentials of the conservative effects
//
// The works are states of a second run: each is the velocity of a joint of unit armature that is not connected to
// anything, on which the power acts as a force. The integrator of the scene integrates them with the motion, with its
// order, and across events. E in the ledger is that of the second run. So a method of order p closes the ledger to
// C h^p, and to rounding when that is small: to a few eps times sqrt(steps) times the largest of |E| and |work_e|. A
// ledger that stays open shows a force that does not derive from its stated potential, a step that is too long, or
// a wrong power.

#include <liecheck/scene/observers/effect_forces.hpp>
#include <liecheck/scene/observers/energy.hpp>

namespace liecheck::scene {

inline const PartInfo power_info{
    "power",
    "power_e = sum tau_e v + sum f_e . V,  ledger = E(t) - E(0) - sum of the integrals of the powers",
    "",
    "a second run, whose states include the works",
    {}};

/// Exerts the power of each effect on a joint of unit armature, whose velocity is then the work.
class WorkMeter final : public Effect<double> {
 public:
  WorkMeter(Effects<double> effects, const Model<double>& model)
      : effects_(std::move(effects)),
        first_(std::size_t(model.nv) - effects_.size()),
        tau_(std::size_t(model.nv)),
        f_(model.inertias.size(), Force<double>::Zero()) {}
  Acts acts() const override { return Acts::OnJoints; }
  Kinematics needs() const override { return Kinematics::Velocities; }
  void prepare(Model<double>& model) const override {
    for (std::size_t k = 0; k < effects_.size(); ++k) model.armature[long(first_ + k)] = 1;
  }
  void add(const Now<double>& now, const Load<double>& load) const override {
    for (std::size_t k = 0; k < effects_.size(); ++k) {
      std::ranges::fill(tau_, 0.0), std::ranges::fill(f_, Force<double>::Zero());
      effects_[k]->add(now, {tau_, f_});
      double& power = load.tau[first_ + k];
      for (std::size_t i = 0; i < first_; ++i) power += tau_[i] * now.v[i];
      for (std::size_t i = 1; i < f_.size(); ++i) power += f_[i].dot(now.V.inWorld(i));
    }
  }

 private:
  Effects<double> effects_;
  std::size_t first_;
  mutable std::vector<double> tau_;
  mutable std::vector<Force<double>> f_;
};

class PowerObserver final : public Observer {
 public:
  PowerObserver(const Parameters&, const Watched& watched) : watched_(watched), forces_(watched) {
    const Scene& scene = *watched.scene;
    if (methodInfo(scene.integrator).lone_body_only)
      throw std::invalid_argument("power needs a method that integrates works with the motion, not '" +
                                  scene.integrator + "': take implicit_midpoint");
    Model<double> model = scene.model;
    Effects<double> open;
    for (std::size_t k = 0; k < forces_.size(); ++k)
      for (const auto& e : *watched.effects)
        if (e.get() == &forces_.effect(k) && !e->conservative()) {
          works_.push_back("work." + forces_.name(k)), open.push_back(e);
          model.addJoint(0, Prismatic<double>(Axis<double>(Vector3<double>(0, 0, 1))),
                         SE3<double>::Identity(), works_.back());
        }
    Effects<double> effects = *watched.effects;
    effects.push_back(std::make_shared<WorkMeter>(std::move(open), model));
    tree_.emplace(model, std::move(effects));
    VectorX<double> q = VectorX<double>::Zero(model.nq), v = VectorX<double>::Zero(model.nv);
    q.head(scene.model.nq) = scene.q, v.head(scene.model.nv) = scene.v;
    state_.emplace(*tree_, q, v);
  }
  Kinematics needs() const override { return Kinematics::Velocities; }
  std::vector<Column> columns() const override {
    std::vector<Column> all;
    for (std::size_t k = 0; k < forces_.size(); ++k) all.push_back({"power." + forces_.name(k), "W"});
    for (const std::string& name : works_) all.push_back({name, "J"});
    all.push_back({"ledger", "J"});
    return all;
  }
  void sample(const Now<double>& now, std::span<double> row) override {
    std::size_t at = 0;
    for (std::size_t k = 0; k < forces_.size(); ++k) {
      forces_.evaluate(k, now);
      row[at++] = forces_.power(now);
    }
    advance(now.t);
    const Now<double> second = tree_->here(*state_, Kinematics::Velocities);
    double ledger = kineticEnergy(*watched_.model, second);
    for (const auto& e : *watched_.effects)
      if (e->conservative()) ledger += e->potential(second);
    if (!first_) first_ = ledger;
    ledger -= *first_;
    for (std::size_t k = 0; k < works_.size(); ++k) {
      row[at] = state_->v[long(std::size_t(watched_.model->nv) + k)];
      ledger -= row[at++];
    }
    row[at] = ledger;
    largest_ = std::max(largest_, std::abs(ledger));
  }
  std::vector<Figure> figures() const override {
    std::vector<Figure> all{{"largest gap of the energy ledger", "J", largest_}};
    for (std::size_t k = 0; k < works_.size(); ++k)
      all.push_back({works_[k], "J", state_->v[long(std::size_t(watched_.model->nv) + k)]});
    return all;
  }

 private:
  using Sys = Tree<double>;
  /// Advances the second run to time t.
  void advance(double t) {
    const Scene& scene = *watched_.scene;
    const double h = scene.span.duration / double(scene.span.steps);
    const long steps = std::lround((t - state_->t) / h);
    if (steps < 1) return;
    if (!method_) method_ = makeMethod<Sys>(scene.integrator, scene.options);
    const Outcome o = simulate(*tree_, *method_, *state_, {h * double(steps), steps, steps},
                               [](const auto&, long) { return true; });
    if (o.diverged) throw StepFailed("the second run of 'power' diverges: " + o.why);
    state_->t = t;
  }

  Watched watched_;
  EffectForces forces_;
  std::vector<std::string> works_;
  std::optional<Sys> tree_;
  std::optional<State<Sys>> state_;
  std::unique_ptr<Method<Sys>> method_;
  std::optional<double> first_;
  double largest_ = 0;
};

}  // namespace liecheck::scene
