#include <chrono>
#include <cmath>
#include <iomanip>
#include <liecheck/scene/run.hpp>
#include <liecheck/scene/setup.hpp>
#include <sstream>

namespace liecheck::scene {
namespace {

double nowInSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The largest divisor of n up to 256. The run checks after that many steps whether to go on.
long largestDivisor(long n) {
  long best = 1;
  for (long d = 1; d <= std::min(n, 256L); ++d)
    if (n % d == 0) best = d;
  return best;
}

/// The largest angular velocity of a joint whose increments do not commute [rad/s].
template <class Tangent>
double largestAngularVelocity(const Model<double>& model, const Tangent& v) {
  double largest = 0;
  for (std::size_t i = 1; i < model.joints.size(); ++i) {
    const int at = model.idx_vs[i];
    if (std::holds_alternative<FreeFlyer<double>>(model.joints[i]))
      largest = std::max(largest, v.template segment<3>(at + 3).norm());
    else if (std::holds_alternative<Spherical<double>>(model.joints[i]))
      largest = std::max(largest, v.template segment<3>(at).norm());
    else if (std::holds_alternative<Planar<double>>(model.joints[i]))
      largest = std::max(largest, std::abs(v[at + 2]));
  }
  return largest;
}

template <class Sys>
class Runner {
 public:
  Runner(Setup<Sys>& setup, const std::function<bool(double)>& on, const Saving& saving)
      : setup_(setup), on_(on), saving_(saving) {
    result_.columns = setup.columns();
    if (saving.save) {
      saved_.digest = digestOf(setup.scene);
      constexpr double own = 12;  // of a state, beside its coordinates and their rounding errors
      const double numbers = 2 * double(setup.start.q.size() + setup.start.v.size()) + own;
      if (const std::string why = tooManySamples(setup.scene.span, numbers); !why.empty())
        throw std::invalid_argument(setup.scene.source + ": the checkpoint would hold " + why);
    }
    if ((saving.save || saving.from) && setup.every_step)
      throw std::invalid_argument(
          setup.scene.source +
          ": a run with an observer that reads every step cannot be saved or resumed: "
          "leave out quaternion_norm and flips");
  }

  Run run(bool estimated) {
    const Span& span = setup_.scene.span;
    Span watched = span;
    watched.every = setup_.every_step ? 1 : largestDivisor(span.every);
    const auto method = makeMethod<Sys>(setup_.scene.integrator,
                                        {setup_.scene.options.tolerance, [this] { return !goesOn(); }});
    State<Sys> now = setup_.start;
    const double begin = nowInSeconds(), h = setup_.step();
    std::vector<Checkpoint<Sys>> checkpoints;
    if (saving_.from) resume(*method, now, watched, checkpoints);
    const long sections = std::clamp(span.steps / 9, 1L, 64L);
    result_.outcome = simulate(setup_.system, *method, now, watched, [&](const State<Sys>& state, long n) {
      if ((estimated || saving_.save) &&
          (n == span.steps ||
           double(n) * double(sections) >= double(checkpoints.size()) * double(span.steps))) {
        checkpoints.push_back({n, state});
        if (saving_.save) saved_.sections.emplace_back(n, state);
      }
      if (setup_.every_step) watchStep(state);
      if (n % span.every == 0 || n == span.steps) {
        sample(state, n);
        if (saving_.save) saved_.samples.emplace_back(n, state);
      }
      if (!method->what().adaptive)
        result_.largest_turn = std::max(
            result_.largest_turn,
            std::abs(h) * largestAngularVelocity(setup_.scene.model, setup_.system.toModel(state).second));
      share_ = double(n) / double(span.steps);
      if (saving_.save) keep(*method, state, n);
      return goesOn();
    });
    if (kept_) saving_.save(saved_);
    result_.seconds = nowInSeconds() - begin;
    std::tie(result_.q, result_.v) = setup_.system.toModel(now);
    result_.counts = method->counts() + before_;
    for (const auto& o : setup_.observers)
      for (Figure& f : o->figures()) {
        if (f.value && !std::isfinite(*f.value)) f.value.reset();  // a refused row entered it
        result_.figures.push_back(std::move(f));
      }
    if (setup_.attitude_error)
      result_.figures.push_back({"largest attitude error", "rad", setup_.attitude_error->largest()});
    if (estimated && !result_.outcome.diverged && !result_.outcome.stopped) try {
        const double estimated_from = nowInSeconds();
        result_.estimate = estimateError(setup_, checkpoints, result_.outcome, [this] { return goesOn(); });
        result_.estimate->seconds = nowInSeconds() - estimated_from;
      } catch (const Interrupted&) {
        result_.outcome.stopped = true;
      }
    return std::move(result_);
  }

 private:
  /// Sets all to what it was at the last state of the saved run. Observers read its samples again.
  void resume(Method<Sys>& method, State<Sys>& now, Span& span, std::vector<Checkpoint<Sys>>& sections) {
    saved_ = *saving_.from;
    for (auto* states : {&saved_.samples, &saved_.sections})
      std::erase_if(*states, [&](const SavedState& s) { return s.step > saved_.last.step; });
    for (const SavedState& s : saved_.samples) s.restore(now), sample(now, s.step);
    for (const SavedState& s : saved_.sections) s.restore(now), sections.push_back({s.step, now});
    saved_.last.restore(now);
    method.begin(setup_.system, now);
    const char* size = "is not a whole checkpoint: what its method remembers has another size";
    if (const auto least = method.memory(); least && saved_.memory.size() < least->size())
      throw std::invalid_argument(size);
    try {
      method.recall(saved_.memory);
    } catch (const std::out_of_range&) {
      throw std::invalid_argument(size);
    }
    setup_.system.switches().recall(saved_.history);
    span.first = saved_.last.step, result_.largest_turn = saved_.largest_turn, before_ = saved_.counts;
  }
  /// Keeps the state as the last one to resume from, if that gives the same bits, and saves it about once in
  /// saving_.seconds.
  void keep(Method<Sys>& method, const State<Sys>& state, long n) {
    auto memory = method.memory();
    if (!memory || !setup_.system.switches().settled() || atEvent(state)) return;
    saved_.last = {n, state}, saved_.memory = std::move(*memory),
    saved_.history = setup_.system.switches().history();
    saved_.counts = method.counts() + before_, saved_.largest_turn = result_.largest_turn;
    kept_ = true;
    if (const double now = nowInSeconds(); now - saved_at_ > saving_.seconds)
      saving_.save(saved_), saved_at_ = now;
  }
  /// True if a switching function is 0, so that the state alone does not tell its branch.
  bool atEvent(const State<Sys>& state) {
    Switches<double>& switches = setup_.system.switches();
    const Switches<double> held = switches;
    switches.learn();
    setup_.system.load(state.t, state.q, state.v);
    return std::exchange(switches, held).ambiguous();
  }
  /// Asks `on`, at most ten times a second, whether to go on.
  bool goesOn() {
    if (!on_) return true;
    const double now = nowInSeconds();
    if (now - asked_ < 0.1) return true;
    asked_ = now;
    return on_(share_);
  }
  /// Observers see the forces just before the end of a step, also if others begin there: twice the 8 eps |t| within which
  /// an event counts as that end (event_steps.hpp).
  void holdBefore(const State<Sys>& state) {
    if (state.t > 0) setup_.system.pieces().hold(state.t - 16 * eps<double>() * state.t);
  }
  void watchStep(const State<Sys>& state) {
    holdBefore(state);
    const auto now = setup_.look(state, setup_.every_step_needs);
    for (const auto& o : setup_.observers)
      if (o->everyStep()) o->step(now);
    setup_.system.pieces().release();
  }
  void sample(const State<Sys>& state, long n) {
    holdBefore(state);
    const auto now = setup_.look(state, setup_.needs);
    row_.resize(result_.columns.size());
    row_[0] = state.t;
    std::size_t at = 1;
    for (const auto& o : setup_.observers) {
      const std::size_t count = o->columns().size();
      o->sample(now, std::span(row_).subspan(at, count));
      at += count;
    }
    setup_.system.pieces().release();
    if (setup_.attitude_error)
      row_[at] = setup_.attitude_error->sample(setup_.system, state, n, [this] { return goesOn(); });
    for (std::size_t i = 0; i < row_.size(); ++i) {
      if (std::isfinite(row_[i])) continue;
      const std::string& name = result_.columns[i].name;
      if (n > 0) throw StepFailed(name + " is no longer finite");
      throw std::invalid_argument(setup_.scene.source + ": at the start " + name +
                                  " is not a finite number: take smaller velocities, positions or masses");
    }
    result_.rows.insert(result_.rows.end(), row_.begin(), row_.end());
  }

  Setup<Sys>& setup_;
  const std::function<bool(double)>& on_;
  const Saving& saving_;
  SavedRun saved_;
  MethodCounts before_;  ///< of the saved run
  double saved_at_ = nowInSeconds();
  bool kept_ = false;
  Run result_;
  std::vector<double> row_;
  double asked_ = -1, share_ = 0;  // time of the last call of on_ [s]; completed share of the run
};

}  // namespace

std::string tooManySamples(const Span& span, double numbers) {
  const double samples = double(span.steps) / double(span.every) + 2;
  if (samples * numbers <= max_sample_numbers) return "";
  std::ostringstream text;
  text << std::setprecision(4) << samples << " samples of " << numbers
       << " numbers, of which memory has room for " << std::floor(max_sample_numbers / numbers)
       << ": take an output.every of " << span.duration / (max_sample_numbers / numbers - 2) << " s or more";
  return text.str();
}

std::vector<Column> columnsOf(const Scene& scene) {
  return withSetup(scene, [](auto& setup) { return setup.columns(); });
}

Run run(const Scene& scene, const std::function<bool(double)>& on, bool estimated, const Saving& saving) {
  return withSetup(scene, [&](auto& setup) { return Runner(setup, on, saving).run(estimated); });
}

}  // namespace liecheck::scene
