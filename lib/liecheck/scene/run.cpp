#include <liecheck/scene/run.hpp>

#include <chrono>
#include <cmath>
#include <liecheck/scene/observers/registry.hpp>

namespace liecheck::scene {
namespace {

double now_in_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The least of several repetitions [ns]: what disturbs adds.
template <class F>
double nanoseconds(F f) {
  long times = 1;
  double best = std::numeric_limits<double>::infinity();
  for (int repetition = 0; repetition < 7;) {
    const double begin = now_in_seconds();
    for (long i = 0; i < times; ++i) f();
    const double took = now_in_seconds() - begin;
    if (took < 1e-4 && times < 1'000'000'000) {
      times *= 4;
      continue;
    }
    best = std::min(best, took / double(times));
    ++repetition;
  }
  return 1e9 * best;
}

const PartInfo& infoOf(const std::string& name) {
  for (const auto* list : {&effectEntries<double>(), &actuationEntries<double>()})
    for (const auto& e : *list)
      if (name == e.info->name) return *e.info;
  throw std::invalid_argument("no effect is named '" + name + "'");
}

/// The largest divisor of n up to 256: how often a run looks up.
long pulseOf(long n) {
  long best = 1;
  for (long d = 1; d <= std::min(n, 256L); ++d)
    if (n % d == 0) best = d;
  return best;
}

template <class Sys>
class Runner {
 public:
  explicit Runner(const Scene& scene)
      : scene_(scene),
        all_(makeEffects<double>(scene, scene.model)),
        system_(scene.model, all_),
        state_(startOf(scene, system_)),
        method_(makeMethod<Sys>(scene.integrator, {scene.options.tolerance, [this] { return !goesOn(); }})) {
    a_ = state_.v;
    const double interval = scene.span.duration / double(scene.span.steps) * double(scene.span.every);
    watched_ = {&system_.model(), &all_, interval};
    for (const Request& r : scene.observers) {
      if (r.name == attitude_error_info.name) {
        refinement_ = long(r.parameters.number("refinement"));
        twin_.emplace(startOf(scene, system_));
        twin_method_ = makeMethod<Sys>("gauss12");
        continue;
      }
      for (const ObserverEntry& e : observerEntries())
        if (r.name == e.info->name) observers_.push_back(e.make(r.parameters, watched_));
    }
    for (const auto& o : observers_) {
      needs_ = std::max(needs_, o->needs());
      if (o->everyStep()) every_step_needs_ = std::max(every_step_needs_, o->needs()), every_step_ = true;
    }
  }

  Plan plan(bool measured) {
    Plan p;
    p.lone_body = std::is_same_v<Sys, LoneBody<double>>;
    const auto add = [&](std::string name, std::string equation, std::string when, std::string why,
                         auto work) {
      p.stages.push_back(
          {std::move(name), std::move(equation), std::move(when), std::move(why), std::nullopt});
      if (measured) p.stages.back().nanoseconds = nanoseconds(work);
    };
    evaluationStages(p, add);
    stepStages(add);
    sampleStages(add);
    if (twin_)
      p.stages.push_back({attitude_error_info.name, attitude_error_info.equation, "sample",
                          "observer of the scene: a second run by gauss12", std::nullopt});
    leaveOut(p);
    return p;
  }

  std::vector<Column> columns() const {
    std::vector<Column> all{{"t", "s"}};
    for (const auto& o : observers_)
      for (Column& c : o->columns()) all.push_back(std::move(c));
    if (twin_) all.push_back({"attitude_error", "rad"});
    return all;
  }

  Run run(const std::function<bool(double)>& on) {
    Run result;
    result.columns = columns();
    const Span& span = scene_.span;
    Span pulses = span;
    pulses.every = every_step_ ? 1 : pulseOf(span.every);
    const double begin = now_in_seconds(), h = span.duration / double(span.steps);
    on_ = on;
    result.outcome = simulate(system_, *method_, state_, pulses, [&](const State<Sys>& state, long n) {
      if (every_step_) watchStep(state);
      if (n % span.every == 0 || n == span.steps) sample(state, n, result);
      if (!method_->what().adaptive)
        result.largest_turn = std::max(result.largest_turn, std::abs(h) * turning(state));
      share_ = double(n) / double(span.steps);
      return goesOn();
    });
    result.seconds = now_in_seconds() - begin;
    result.counts = method_->counts();
    for (const auto& o : observers_)
      for (Figure& f : o->figures()) {
        if (f.value && !std::isfinite(*f.value)) f.value.reset();  // of what was refused as a row
        result.figures.push_back(std::move(f));
      }
    if (twin_) result.figures.push_back({"largest attitude error", "rad", worst_attitude_});
    return result;
  }

 private:
  static std::string_view reads(Kinematics k) {
    return k == Kinematics::Poses        ? "poses"
           : k == Kinematics::Velocities ? "poses and velocities"
                                         : "accelerations";
  }
  template <class Add>
  void evaluationStages(Plan& p, const Add& add) {
    const auto& s = state_;
    const auto& effects = system_.effects();
    if (!effects.empty() && system_.needs() != Kinematics::None)
      add(std::string(reads(system_.needs())) + " for effects",
          p.lone_body ? "X_WB, V_B" : "oM_i = oM_p liM_i, v_i = X^-1 v_p + S qd", "evaluation",
          "effects read them", [&] { system_.here(s.t, s.q, s.v, system_.needs()); });
    VectorX<double> tau = VectorX<double>::Zero(system_.nv());
    std::vector<Force<double>> f(std::size_t(scene_.model.njoints), Force<double>::Zero());
    for (std::size_t i = 0, k = 0; i < all_.size(); ++i) {
      const PartInfo& info = infoOf(scene_.effects[i].name);
      if (all_[i]->acts() == Acts::OnModel) continue;
      const auto& effect = effects[k++];
      const auto now = system_.here(s.t, s.q, s.v, system_.needs());
      add(info.name, info.equation, "evaluation", "effect of the scene", [&] {
        effect->add(now, {{tau.data(), std::size_t(tau.size())}, f});
      });
    }
    if (p.lone_body)
      add("rigid-body equations",
          "I_C omega_dot = n - omega x I_C omega, u_C_dot = f/m - omega x u_C + R^T g", "evaluation",
          "a lone free body", [&] { system_.equations(s.q, s.v, a_); });
    else
      add("articulated bodies", "qdd = D^-1 (u - U^T (X a_p + c)), the base accelerates by -g", "evaluation",
          "a robot of " + std::to_string(scene_.model.njoints - 1) + " joints",
          [&] { system_.equations(s.q, s.v, a_); });
  }
  template <class Add>
  void stepStages(const Add& add) {
    auto& s = state_;
    auto q = s.q;
    auto delta = s.v, rate = s.v;
    delta *= scene_.span.duration / double(scene_.span.steps);
    add("integrate", "q exp(delta)", "step", "each stage of " + scene_.integrator,
        [&] { system_.integrate(s.q, delta, q); });
    if (method_->what().increments)
      add("J_r^-1", "delta_dot = J_r^-1(delta) v", "step", "each stage of " + scene_.integrator,
          [&] { system_.tangentRate(delta, s.v, rate); });
    auto moving = state_;
    method_->begin(system_, moving);
    const double h = scene_.span.duration / double(scene_.span.steps);
    add("step of " + scene_.integrator, method_->what().equation, "step", "all of the above, once a step",
        [&] {
          moving = s;
          method_->step(system_, moving, h);
        });
    method_ = makeMethod<Sys>(scene_.integrator, scene_.options);
  }
  template <class Add>
  void sampleStages(const Add& add) {
    const auto& s = state_;
    if (every_step_)
      add(std::string(every_step_needs_ == Kinematics::None ? "watching" : reads(every_step_needs_)) +
              " every step",
          "", "step", "an observer looks at each", [&] { look(s, every_step_needs_); });
    if (needs_ != Kinematics::None)
      add(std::string(reads(needs_)) + " for observers", "", "sample", "observers read them",
          [&] { look(s, needs_); });
    for (const Request& r : scene_.observers) {
      if (r.name == attitude_error_info.name) continue;
      // One of its own: what is measured leaves traces in what it sums up.
      const ObserverEntry& entry = entryOf(r);
      const auto observer = entry.make(r.parameters, watched_);
      std::vector<double> row(observer->columns().size());
      const auto now = look(s, needs_);
      add(entry.info->name, entry.info->equation, "sample", "observer of the scene",
          [&] { observer->sample(now, row); });
    }
  }
  static const ObserverEntry& entryOf(const Request& r) {
    for (const ObserverEntry& e : observerEntries())
      if (r.name == e.info->name) return e;
    throw std::invalid_argument("no observer is named '" + r.name + "'");
  }
  void leaveOut(Plan& p) {
    const auto called = [&](const char* name) {
      for (const Request& r : scene_.effects)
        if (r.name == name) return true;
      return false;
    };
    for (const auto* list : {&effectEntries<double>(), &actuationEntries<double>()})
      for (const auto& e : *list)
        if (!called(e.info->name)) p.left_out.push_back({e.info->name, "the scene does not call for it"});
    for (std::size_t i = 0; i < all_.size(); ++i)
      if (all_[i]->acts() == Acts::OnModel)
        p.left_out.push_back({std::string("a pass for ") + scene_.effects[i].name,
                              std::string("it costs ") + infoOf(scene_.effects[i].name).cost});
    if (p.lone_body)
      p.left_out.push_back({"articulated bodies", "a lone free body takes the rigid-body equations"});
    if (system_.needs() == Kinematics::None)
      p.left_out.push_back({"poses for effects", "no effect reads them"});
    if (needs_ != Kinematics::Accelerations)
      p.left_out.push_back({"acceleration kinematics", "no observer reads them"});
    if (observers_.empty()) p.left_out.push_back({"kinematics at samples", "nothing is watched"});
  }

  /// Asks `on`, ten times a second.
  bool goesOn() {
    if (!on_) return true;
    const double now = now_in_seconds();
    if (now - asked_ < 0.1) return true;
    asked_ = now;
    return on_(share_);
  }
  Now<double> look(const State<Sys>& s, Kinematics needs) {
    if (needs != Kinematics::Accelerations) return system_.here(s.t, s.q, s.v, needs);
    system_.acceleration(s.t, s.q, s.v, a_);
    return system_.here(s.t, s.q, s.v, needs, &a_);
  }
  void watchStep(const State<Sys>& state) {
    const auto now = look(state, every_step_needs_);
    for (const auto& o : observers_)
      if (o->everyStep()) o->step(now);
  }
  void sample(const State<Sys>& state, long n, Run& result) {
    const auto now = look(state, needs_);
    row_.resize(result.columns.size());
    row_[0] = state.t;
    std::size_t at = 1;
    for (const auto& o : observers_) {
      const std::size_t count = o->columns().size();
      o->sample(now, std::span(row_).subspan(at, count));
      at += count;
    }
    if (twin_) row_[at] = attitudeError(state, n);
    for (std::size_t i = 0; i < row_.size(); ++i) {
      if (std::isfinite(row_[i])) continue;
      const std::string& name = result.columns[i].name;
      if (n > 0) throw StepFailed(name + " is no longer finite");
      throw std::invalid_argument(scene_.source + ": at the start " + name +
                                  " is no finite number: take smaller velocities, positions or masses");
    }
    result.rows.insert(result.rows.end(), row_.begin(), row_.end());
  }
  double attitudeError(const State<Sys>& state, long n) {
    if (n > twin_steps_) {
      Span rest;
      rest.steps = (n - twin_steps_) * refinement_;
      rest.every = 256;
      rest.duration = scene_.span.duration / double(scene_.span.steps) * double(n - twin_steps_);
      const Outcome o =
          simulate(system_, *twin_method_, *twin_, rest, [this](const auto&, long) { return goesOn(); });
      if (o.stopped) throw Interrupted();
      if (o.diverged) throw StepFailed("the second run of attitude_error diverges: " + o.why);
      twin_steps_ = n;
    }
    double worst = 0;
    for (std::size_t i = 1; i < scene_.model.joints.size(); ++i) {
      const int unit = std::visit([](const auto& j) { return int(j.unit_begin); }, scene_.model.joints[i]);
      if (scene_.model.nqs[i] - unit != 4) continue;
      const int at = scene_.model.idx_qs[i] + unit;
      Vector7<double> q0, q1;
      q0 << 0, 0, 0, twin_->q.template segment<4>(at);
      q1 << 0, 0, 0, state.q.template segment<4>(at);
      worst = std::max(worst, differenceSE3<double>(q0, q1).template tail<3>().norm());
    }
    worst_attitude_ = std::max(worst_attitude_, worst);
    return worst;
  }
  /// The largest angular velocity of a joint whose increments do not commute [rad/s].
  double turning(const State<Sys>& state) const {
    double largest = 0;
    const Model<double>& model = scene_.model;
    for (std::size_t i = 1; i < model.joints.size(); ++i) {
      const auto& joint = model.joints[i];
      const bool plane = std::holds_alternative<Planar<double>>(joint);
      const int first = std::holds_alternative<FreeFlyer<double>>(joint)   ? 3
                        : std::holds_alternative<Spherical<double>>(joint) ? 0
                                                                           : 2;
      if (first == 2 && !plane) continue;
      largest = std::max(largest, state.v.segment(model.idx_vs[i] + first, plane ? 1 : 3).norm());
    }
    return largest;
  }

  const Scene& scene_;
  Effects<double> all_;
  Sys system_;
  State<Sys> state_;
  std::unique_ptr<Method<Sys>> method_, twin_method_;
  std::vector<double> row_;
  std::function<bool(double)> on_;
  double asked_ = -1, share_ = 0;  // when, in seconds; of the run
  typename Sys::Tangent a_;
  Watched watched_{};
  std::vector<std::unique_ptr<Observer>> observers_;
  Kinematics needs_ = Kinematics::None, every_step_needs_ = Kinematics::None;
  bool every_step_ = false;
  std::optional<State<Sys>> twin_;
  long refinement_ = 1, twin_steps_ = 0;
  double worst_attitude_ = 0;
};

template <class F>
auto withRunner(const Scene& scene, F f) {
  if (isLoneBody(scene)) {
    Runner<LoneBody<double>> runner(scene);
    return f(runner);
  }
  Runner<Tree<double>> runner(scene);
  return f(runner);
}

}  // namespace

Plan plan(const Scene& scene, bool measured) {
  return withRunner(scene, [&](auto& runner) { return runner.plan(measured); });
}

std::vector<const PartInfo*> observerInfos() {
  std::vector<const PartInfo*> all;
  for (const ObserverEntry& e : observerEntries()) all.push_back(e.info);
  return all;
}

std::vector<Column> columnsOf(const Scene& scene) {
  return withRunner(scene, [](auto& runner) { return runner.columns(); });
}

Run run(const Scene& scene, const std::function<bool(double)>& on) {
  return withRunner(scene, [&](auto& runner) { return runner.run(on); });
}

}  // namespace liecheck::scene
