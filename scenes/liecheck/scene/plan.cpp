#include <algorithm>
#include <chrono>
#include <functional>
#include <liecheck/scene/count_instructions.hpp>
#include <liecheck/scene/run.hpp>
#include <liecheck/scene/setup.hpp>

namespace liecheck::scene {
namespace {

/// The shortest time of one call in seven repetitions [ns], or in fewer if they take more than 10 ms. Disturbances can
/// only add time.
template <class F>
double nanoseconds(F f) {
  using Clock = std::chrono::steady_clock;
  long times = 1;
  double best = std::numeric_limits<double>::infinity(), all = 0;
  for (int repetition = 0; repetition < 7 && (repetition == 0 || all < 0.01);) {
    const auto begin = Clock::now();
    for (long i = 0; i < times; ++i) f();
    const double took = std::chrono::duration<double>(Clock::now() - begin).count();
    all += took;
    if (took < 1e-4 && times < 1'000'000'000)
      times *= 4;
    else
      best = std::min(best, took / double(times)), ++repetition;
  }
  return 1e9 * best;
}

/// An effect without a force, which counts the evaluations.
class Spy final : public Effect<double> {
 public:
  Acts acts() const override { return Acts::OnJoints; }
  void add(const Now<double>&, const Load<double>&) const override { ++count; }
  mutable long count = 0;
};

template <class Sys>
class Planner {
 public:
  Planner(Setup<Sys>& setup, const std::optional<Measuring>& measuring)
      : setup_(setup), system_(setup.system), state_(setup.start), measuring_(measuring) {}

  Plan plan() {
    plan_.kind = kindOf(setup_.scene);
    if (measuring_) plan_.evaluations = evaluations();
    addEvaluation();
    addStep();
    addSamples();
    leaveOut();
    if (measuring_) count();
    return std::move(plan_);
  }

 private:
  static constexpr bool joint = std::is_same_v<Sys, LoneJoint<double>>;
  static constexpr bool lone = !joint && !std::is_same_v<Sys, Tree<double>>;
  using Work = std::function<void()>;
  using Count = std::function<std::optional<long>(const InstructionCounter&)>;

  /// Adds a stage. The work `before` it is neither timed nor counted.
  void add(std::string name, std::string equation, std::string when, std::string why, const Work& work,
           const Work& before = {}) {
    Stage stage{std::move(name), std::move(equation), std::move(when), std::move(why), {}, {}};
    if (measuring_) {
      const auto all = [&] { before(), work(); };
      stage.nanoseconds = before ? std::max(0.0, nanoseconds(all) - nanoseconds(before)) : nanoseconds(work);
    }
    plan_.stages.push_back(std::move(stage));
    counts_.push_back([=](const InstructionCounter& counter) { return counter.count(work, before); });
  }
  void count() {
    if (measuring_->timed) measuring_->timed(plan_);
    // Each stage is counted about once: of a step, what it does beside the evaluations, which it takes several of.
    double all = 0, evaluation = 0;
    for (const Stage& s : plan_.stages) {
      if (s.when == "evaluation") evaluation += *s.nanoseconds;
      all += std::max(0.0, s.nanoseconds.value_or(0) -
                               (s.name.starts_with("step of") ? plan_.evaluations * evaluation : 0));
    }
    constexpr double most_a_nanosecond = 16;
    const InstructionCounter counter(measuring_->every, measuring_->seconds, most_a_nanosecond * all);
    // The cheap ones first, so that an expensive one takes no time from them. A step comes after its evaluations.
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < counts_.size(); ++i)
      if (counts_[i]) order.push_back(i);
    std::ranges::sort(order, {}, [&](std::size_t i) { return *plan_.stages[i].nanoseconds; });
    for (const std::size_t i : order) {
      if (measuring_->counts) measuring_->counts(plan_.stages[i]);
      plan_.stages[i].instructions = counts_[i](counter);
    }
  }
  static std::string reads(Kinematics k) {
    return k == Kinematics::Poses        ? "poses"
           : k == Kinematics::Velocities ? "poses and velocities"
                                         : "accelerations";
  }

  /// The evaluations of the first steps, by a spy among the effects. A thrown body has none: its spy watches a lone body.
  double evaluations() const {
    using Watched = std::conditional_t<lone, LoneBody<double>, Tree<double>>;
    const auto spy = std::make_shared<Spy>();
    Effects<double> effects = setup_.effects;
    effects.push_back(spy);
    Watched system(setup_.scene.model, effects);
    auto state = startOf(setup_.scene, system);
    const auto method = makeMethod<Watched>(setup_.scene.integrator, setup_.scene.options);
    const long most = std::min(setup_.scene.span.steps, 10L);
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(50);
    method->begin(system, state);
    long steps = 0;
    while (steps < most && (steps == 0 || std::chrono::steady_clock::now() < until)) {
      method->step(system, state, setup_.step());
      state.t = double(++steps) * setup_.step();
    }
    return double(spy->count) / double(steps);
  }

  void addEvaluation() {
    const auto& s = state_;
    const auto& effects = system_.effects();
    const Work equations = [&, a = s.v]() mutable { system_.equations(s.q, s.v, a); };
    if constexpr (lone) {
      if (!effects.empty())
        add("pose and twist of the body", "p = c - R p_BoBcm, u = R^T c_dot - omega x p_BoBcm", "evaluation",
            "effects read them", [&] { system_.here(s, system_.needs()); });
    } else if constexpr (!joint) {
      add("poses and twists", "oM_i = oM_p liM_i, v_i = v_p + S qd", "evaluation",
          effects.empty() || system_.needs() == Kinematics::None ? "the equations read them"
                                                                 : "effects and equations share them",
          [&] { system_.move(s.q, s.v); });
    }
    addEffects();
    system_.load(s.t, s.q, s.v);
    if constexpr (lone)
      add("rigid-body equations", "I_C omega_dot = n - omega x I_C omega, c_ddot = g + f/m", "evaluation",
          "a lone free body", equations);
    else if constexpr (joint)
      add("equation of motion", "(D + armature) v_dot = tau + A cos q + B sin q", "evaluation",
          "a robot of one joint", equations);
    else
      add("articulated bodies", "qdd = D^-1 (u - U^T (X a_p + c)), the base accelerates by -g", "evaluation",
          "a robot of " + std::to_string(setup_.scene.model.njoints - 1) + " joints", equations,
          [&] { system_.move(s.q, s.v); });
  }
  void addEffects() {
    const auto& effects = system_.effects();
    tau_ = VectorX<double>::Zero(setup_.scene.model.nv);
    f_.assign(std::size_t(setup_.scene.model.njoints), Force<double>::Zero());
    using Named = std::pair<const PartInfo*, Effects<double>>;
    std::vector<Named> by_name;
    for (std::size_t i = 0; i < setup_.effects.size(); ++i) {
      if (!std::ranges::count(effects, setup_.effects[i])) continue;
      const PartInfo* info = effectEntry<double>(setup_.scene.effects[i].name).info;
      auto group = std::ranges::find(by_name, info, &Named::first);
      if (group == by_name.end()) group = by_name.insert(group, {info, {}});
      group->second.push_back(setup_.effects[i]);
    }
    const auto now = system_.here(state_, system_.needs());
    for (const auto& [info, all] : by_name)
      add(info->name, info->equation, "evaluation",
          all.size() == 1 ? "effect of the scene" : std::to_string(all.size()) + " effects of the scene",
          [this, now, all] {
            for (const auto& effect : all) effect->add(now, {{tau_.data(), std::size_t(tau_.size())}, f_});
          });
  }

  void addStep() {
    const std::string& integrator = setup_.scene.integrator;
    const double h = setup_.step();
    method_ = makeMethod<Sys>(integrator, setup_.scene.options);
    moving_ = state_;
    // The steps from `first` to n; from the start if first is 0.
    const auto steps = [this, h](long first, long n) {
      if (first == 0) *moving_ = state_;
      return simulate(system_, *method_, *moving_, {h * double(n), n, n, first},
                      [](const auto&, long) { return true; });
    };
    const auto run = [&](long n) { return [&, n] { steps(0, n); }; };
    Stage stage{"step of " + integrator,
                method_->what().equation,
                "step",
                setup_.scene.options.compensated.value_or(compensates(method_->what()))
                    ? "all of the above, and compensated sums"
                    : "all of the above, stages and sums",
                {},
                {}};
    if (measuring_) {
      if (const Outcome o = steps(0, 4); o.diverged) throw StepFailed(o.why);
      stage.nanoseconds = std::max(0.0, nanoseconds(run(2)) - nanoseconds(run(1)));
    }
    plan_.stages.push_back(std::move(stage));
    // Not of the first steps, which may be checked (phase_check.hpp), and of two in which no event is located: of the second
    // one, since a call looks at the start before its first.
    counts_.push_back([this, h, steps](const InstructionCounter& counter) -> std::optional<long> {
      long n = 12;
      std::optional<State<Sys>> last;  // before step n, from which the method begins each time
      for (; n < 15; ++n) {
        if (steps(0, n - 1).diverged) return {};
        last = moving_;
        const Outcome o = steps(n - 1, n + 2);
        if (o.diverged) return {};
        if (o.events == 0 && o.phases.count == 0) break;
      }
      double before = 0, after = 0;
      const auto watch = [&](const auto&, long) {
        before = std::exchange(after, counter.soFar());
        return true;
      };
      const auto two = [&] {
        simulate(system_, *method_, *moving_, {h * double(n + 2), n + 2, 1, n}, watch);
      };
      if (!counter.count(two, [&] { moving_ = last, steps(n - 1, n); })) return {};
      return std::lround(after - before);
    });
  }

  void addSamples() {
    if (setup_.every_step) {
      const Kinematics needs = setup_.every_step_needs;
      add((needs == Kinematics::None ? "state" : reads(needs)) + " every step", "", "step",
          "an observer reads every step", [this, needs] { setup_.look(state_, needs); });
    }
    if (setup_.needs != Kinematics::None)
      add(reads(setup_.needs) + " for observers", "", "sample", "observers read them",
          [&] { setup_.look(state_, setup_.needs); });
    for (const Request& r : setup_.scene.observers) {
      if (r.name == attitude_error_info.name) continue;
      // A new observer, since measuring changes what an observer accumulates.
      const ObserverEntry& entry = observerEntry(r.name);
      const std::shared_ptr<Observer> observer = entry.make(r.parameters, setup_.watched);
      const auto now = setup_.look(state_, setup_.needs);
      add(entry.info->name, entry.info->equation, "sample", "observer of the scene",
          [observer, now, row = std::vector<double>(observer->columns().size())]() mutable {
            observer->sample(now, row);
          });
    }
    if (setup_.attitude_error)
      counts_.emplace_back(), plan_.stages.push_back({attitude_error_info.name,
                                                      attitude_error_info.equation,
                                                      "sample",
                                                      "observer of the scene: a second run by gauss12",
                                                      {},
                                                      {}});
  }

  void leaveOut() {
    auto& left_out = plan_.left_out;
    const auto named = [&](const char* name) {
      for (const Request& r : setup_.scene.effects)
        if (r.name == name) return true;
      return false;
    };
    for (const auto* list : {&effectEntries<double>(), &actuationEntries<double>()})
      for (const auto& e : *list)
        if (!named(e.info->name)) left_out.push_back({e.info->name, "not in the scene"});
    for (std::size_t i = 0; i < setup_.effects.size(); ++i)
      if (setup_.effects[i]->acts() == Acts::OnModel) {
        const PartInfo& info = *effectEntry<double>(setup_.scene.effects[i].name).info;
        left_out.push_back({std::string("a stage for ") + info.name, std::string("it costs ") + info.cost});
      } else if (!std::ranges::count(system_.effects(), setup_.effects[i])) {
        left_out.push_back({std::string("a stage for ") + setup_.scene.effects[i].name,
                            "its coefficients are part of the rigid-body equations"});
      }
    if constexpr (std::is_same_v<Sys, ThrownBody<double>>)
      left_out.push_back({"the translation", "the acceleration of the centre of mass is constant"});
    if constexpr (lone)
      left_out.push_back({"articulated bodies", "a lone free body uses the rigid-body equations"});
    if constexpr (joint) left_out.push_back({"articulated bodies", "one joint has one equation"});
    if (lone && system_.effects().empty())
      left_out.push_back({"pose of the body", "no effect reads it in a step"});
    if (setup_.needs != Kinematics::Accelerations)
      left_out.push_back({"acceleration kinematics", "no observer reads accelerations"});
    if (setup_.observers.empty()) left_out.push_back({"kinematics at samples", "the scene has no observers"});
  }

  Setup<Sys>& setup_;
  Sys& system_;
  const State<Sys>& state_;
  const std::optional<Measuring>& measuring_;
  Plan plan_;
  std::vector<Count> counts_;  ///< of the stages
  // What the work of stages uses.
  VectorX<double> tau_;
  std::vector<Force<double>> f_;
  std::unique_ptr<Method<Sys>> method_;
  std::optional<State<Sys>> moving_;
};

}  // namespace

Plan plan(const Scene& scene, const std::optional<Measuring>& measuring) {
  return withSetup(scene, [&](auto& setup) { return Planner(setup, measuring).plan(); });
}

}  // namespace liecheck::scene
