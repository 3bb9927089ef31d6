#include <algorithm>
#include <chrono>
#include <functional>
#include <liecheck/scene/count_instructions.hpp>
#include <liecheck/scene/run.hpp>
#include <liecheck/scene/setup.hpp>

namespace liecheck::scene {
namespace {

/// The shortest time of one call in seven repetitions [ns]. Disturbances can only add time.
template <class F>
double nanoseconds(F f) {
  using Clock = std::chrono::steady_clock;
  long times = 1;
  double best = std::numeric_limits<double>::infinity();
  for (int repetition = 0; repetition < 7;) {
    const auto begin = Clock::now();
    for (long i = 0; i < times; ++i) f();
    const double took = std::chrono::duration<double>(Clock::now() - begin).count();
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
  Planner(Setup<Sys>& setup, bool measured)
      : setup_(setup), system_(setup.system), state_(setup.start), measured_(measured) {}

  Plan plan() {
    plan_.kind = kindOf(setup_.scene);
    if (measured_) plan_.evaluations = evaluations();
    addEvaluation();
    addStep();
    addSamples();
    leaveOut();
    return std::move(plan_);
  }

 private:
  static constexpr bool joint = std::is_same_v<Sys, LoneJoint<double>>;
  static constexpr bool lone = !joint && !std::is_same_v<Sys, Tree<double>>;
  /// The longest time of a call whose instructions are counted [ns].
  static constexpr double countable = 1e5;
  using Work = std::function<void()>;

  /// Adds a stage. The work `before` it is neither timed nor counted.
  void add(std::string name, std::string equation, std::string when, std::string why, const Work& work,
           const Work& before = {}) {
    Stage stage{std::move(name), std::move(equation), std::move(when), std::move(why), {}, {}};
    if (measured_) {
      const auto all = [&] { before(), work(); };
      stage.nanoseconds = before ? std::max(0.0, nanoseconds(all) - nanoseconds(before)) : nanoseconds(work);
      if (*stage.nanoseconds < countable) {
        stage.instructions = countInstructions(before ? Work(all) : work);
        if (const auto less = before ? countInstructions(before) : std::nullopt; less && stage.instructions)
          *stage.instructions -= *less;
      }
    }
    plan_.stages.push_back(std::move(stage));
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
    const long steps = std::min(setup_.scene.span.steps, 10L);
    method->begin(system, state);
    for (long n = 0; n < steps; ++n) {
      method->step(system, state, setup_.step());
      state.t = double(n + 1) * setup_.step();
    }
    return double(spy->count) / double(steps);
  }

  void addEvaluation() {
    const auto& s = state_;
    const auto& effects = system_.effects();
    auto a = s.v;
    const Work equations = [&] { system_.equations(s.q, s.v, a); };
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
    VectorX<double> tau = VectorX<double>::Zero(setup_.scene.model.nv);
    std::vector<Force<double>> f(std::size_t(setup_.scene.model.njoints), Force<double>::Zero());
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
          [&] {
            for (const auto& effect : all) effect->add(now, {{tau.data(), std::size_t(tau.size())}, f});
          });
  }

  void addStep() {
    const std::string& integrator = setup_.scene.integrator;
    const double h = setup_.step();
    const auto method = makeMethod<Sys>(integrator, setup_.scene.options);
    auto moving = state_;
    const auto steps = [&](long n) {
      moving = state_;
      simulate(system_, *method, moving, {h * double(n), n, n}, [](const auto&, long) { return true; });
    };
    const auto run = [&](long n) { return Work([&, n] { steps(n); }); };
    Stage stage{"step of " + integrator,
                method->what().equation,
                "step",
                setup_.scene.options.compensated.value_or(compensates(method->what()))
                    ? "all of the above, and compensated sums"
                    : "all of the above, stages and sums",
                {},
                {}};
    if (measured_) {
      stage.nanoseconds = std::max(0.0, nanoseconds(run(2)) - nanoseconds(run(1)));
      if (*stage.nanoseconds < countable)
        // The fewest of three steps, since one in which an event is located takes more.
        for (long n = 1; n <= 3; ++n)
          if (const auto more = countInstructions(run(n + 1)), less = countInstructions(run(n)); more && less)
            stage.instructions = std::min(stage.instructions.value_or(*more), *more - *less);
    }
    plan_.stages.push_back(std::move(stage));
  }

  void addSamples() {
    if (setup_.every_step) {
      const Kinematics needs = setup_.every_step_needs;
      add((needs == Kinematics::None ? "state" : reads(needs)) + " every step", "", "step",
          "an observer reads every step", [&] { setup_.look(state_, needs); });
    }
    if (setup_.needs != Kinematics::None)
      add(reads(setup_.needs) + " for observers", "", "sample", "observers read them",
          [&] { setup_.look(state_, setup_.needs); });
    for (const Request& r : setup_.scene.observers) {
      if (r.name == attitude_error_info.name) continue;
      // A new observer, since measuring changes what an observer accumulates.
      const ObserverEntry& entry = observerEntry(r.name);
      const auto observer = entry.make(r.parameters, setup_.watched);
      std::vector<double> row(observer->columns().size());
      const auto now = setup_.look(state_, setup_.needs);
      add(entry.info->name, entry.info->equation, "sample", "observer of the scene",
          [&] { observer->sample(now, row); });
    }
    if (setup_.attitude_error)
      plan_.stages.push_back({attitude_error_info.name,
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
  bool measured_;
  Plan plan_;
};

}  // namespace

Plan plan(const Scene& scene, bool measured) {
  return withSetup(scene, [&](auto& setup) { return Planner(setup, measured).plan(); });
}

}  // namespace liecheck::scene
