#include <algorithm>
#include <chrono>
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

template <class Sys>
class Planner {
 public:
  Planner(Setup<Sys>& setup, bool measured)
      : setup_(setup), system_(setup.system), state_(setup.start), measured_(measured) {}

  Plan plan() {
    plan_.lone_body = std::is_same_v<Sys, LoneBody<double>>;
    addEvaluation();
    addStep();
    addSamples();
    leaveOut();
    return std::move(plan_);
  }

 private:
  template <class Work>
  void add(std::string name, std::string equation, std::string when, std::string why, Work work) {
    plan_.stages.push_back({std::move(name), std::move(equation), std::move(when), std::move(why), {}});
    if (measured_) plan_.stages.back().nanoseconds = nanoseconds(work);
  }
  static std::string reads(Kinematics k) {
    return k == Kinematics::Poses        ? "poses"
           : k == Kinematics::Velocities ? "poses and velocities"
                                         : "accelerations";
  }

  void addEvaluation() {
    const auto& s = state_;
    const auto& effects = system_.effects();
    if (!effects.empty() && system_.needs() != Kinematics::None)
      add(reads(system_.needs()) + " for effects",
          plan_.lone_body ? "X_WB, V_B" : "oM_i = oM_p liM_i, v_i = X^-1 v_p + S qd", "evaluation",
          "effects read them", [&] { system_.here(s.t, s.q, s.v, system_.needs()); });
    VectorX<double> tau = VectorX<double>::Zero(system_.nv());
    std::vector<Force<double>> f(std::size_t(setup_.scene.model.njoints), Force<double>::Zero());
    using Named = std::pair<const PartInfo*, Effects<double>>;
    std::vector<Named> by_name;
    for (std::size_t i = 0, k = 0; i < setup_.effects.size(); ++i) {
      if (setup_.effects[i]->acts() == Acts::OnModel) continue;
      const PartInfo* info = effectEntry<double>(setup_.scene.effects[i].name).info;
      auto group = std::ranges::find(by_name, info, &Named::first);
      if (group == by_name.end()) group = by_name.insert(group, {info, {}});
      group->second.push_back(effects[k++]);
    }
    const auto now = system_.here(s.t, s.q, s.v, system_.needs());
    for (const auto& [info, all] : by_name)
      add(info->name, info->equation, "evaluation",
          all.size() == 1 ? "effect of the scene" : std::to_string(all.size()) + " effects of the scene",
          [&] {
            for (const auto& effect : all) effect->add(now, {{tau.data(), std::size_t(tau.size())}, f});
          });
    auto a = s.v;
    const auto equations = [&] { system_.equations(s.q, s.v, a); };
    if (plan_.lone_body)
      add("rigid-body equations",
          "I_C omega_dot = n - omega x I_C omega, u_C_dot = f/m - omega x u_C + R^T g", "evaluation",
          "a lone free body", equations);
    else
      add("articulated bodies", "qdd = D^-1 (u - U^T (X a_p + c)), the base accelerates by -g", "evaluation",
          "a robot of " + std::to_string(setup_.scene.model.njoints - 1) + " joints", equations);
  }

  void addStep() {
    const std::string& integrator = setup_.scene.integrator;
    const double h = setup_.step();
    const auto method = makeMethod<Sys>(integrator, setup_.scene.options);
    auto q = state_.q;
    auto delta = state_.v, rate = state_.v;
    delta *= h;
    add("integrate", "q exp(delta)", "step", "each stage of " + integrator,
        [&] { system_.integrate(state_.q, delta, q); });
    if (method->what().increments)
      add("J_r^-1", "delta_dot = J_r^-1(delta) v", "step", "each stage of " + integrator,
          [&] { system_.tangentRate(delta, state_.v, rate); });
    auto moving = state_;
    method->begin(system_, moving);
    add("step of " + integrator, method->what().equation, "step", "all of the above, once a step", [&] {
      moving = state_;
      method->step(system_, moving, h);
    });
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
      plan_.stages.push_back({attitude_error_info.name, attitude_error_info.equation, "sample",
                              "observer of the scene: a second run by gauss12", std::nullopt});
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
      }
    if (plan_.lone_body)
      left_out.push_back({"articulated bodies", "a lone free body uses the rigid-body equations"});
    if (system_.needs() == Kinematics::None)
      left_out.push_back({"poses for effects", "no effect reads them"});
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
