#include <liecheck/scene/estimate.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <liecheck/scene/conserved.hpp>
#include <liecheck/scene/observers/coordinate_names.hpp>
#include <liecheck/scene/painleve.hpp>
#include <liecheck/scene/stability.hpp>

namespace liecheck::scene {
namespace {
using Vec = VectorX<double>;
std::string decimal(double x, const char* format = "%.12g") {
  char text[40];
  std::snprintf(text, sizeof text, format, x);
  return text;
}

/// The smallest of 2, 4, 5, 8, 10, 20, ... that is at least x. Steps divided by it stay short decimals.
double divisorOf(double x) {
  for (double power = 1; power < 1e15; power *= 10)
    for (const double k : {1.0, 2.0, 4.0, 5.0, 8.0})
      if (k * power >= x && k * power > 1) return k * power;
  return 1e15;
}

template <class Sys>
class Estimator {
 public:
  Estimator(Setup<Sys>& setup, const std::vector<Checkpoint<Sys>>& points, const Outcome& outcome,
            const std::function<bool()>& go_on)
      : setup_(setup),
        points_(points),
        phases_(outcome.phases),
        go_on_(go_on),
        adaptive_(methodInfo(setup.scene.integrator).adaptive),
        shortened_(outcome.phases.count > 0),
        coordinates_(velocityNames(setup.scene.model)) {
    for (const Request& r : setup.scene.effects)
      if (r.parameters.number("friction", 0) > 0) painleve_.emplace(setup.system.model());
  }

  Estimate run() {
    const MethodInfo& method = methodInfo(setup_.scene.integrator);
    promised_ = method.order;
    result_.checkpoints = long(points_.size()) - 1;
    setAccepted();
    // Longer steps lose contacts that the run resolves in phases shorter than its steps. The phases of its twin are
    // shorter instead, by half: whatever part of the error they have, its own and that of the steps between add up.
    // Where phases take most of the run's steps, even shorter ones would cost more than the run.
    const bool phases = phases_.count > 0 && phases_.count <= 8 * points_.back().step;
    auto coarse = points_.back().step >= 9 || adaptive_ ? twin(3, phases ? 0.5 : 3) : std::nullopt;
    const auto coarser = coarse && !phases ? twin(9) : std::nullopt;
    double factor = 1;  // error / difference
    std::optional<Twin> best = coarse;
    bool known = false;
    if (coarse) {
      const double D1 = differ(coarse->states), D2 = coarser ? differ(coarse->states, &coarser->states) : 0;
      if (coarser && D1 > 0 && D2 > 0)
        result_.order = std::log(D2 / D1) / std::log(coarser->ratio / coarse->ratio);
      if (phases)
        factor = 4. / 3;  // of second order, the least of methods with phases
      else if (observed())
        factor = 1 / (std::pow(coarse->ratio, believedOrder()) - 1);
      // Two differences may have the ratio of an order by chance, and few long steps may not differ by the tolerance. E is
      // trusted to a factor of 2 (.5) and of 30 (.03) where phases are not resolved, where shorter steps do not show the
      // order, as both may meet a contact too late, and, for an alarm, between long steps.
      const double E = D1 * factor, order = result_.order.value_or(0);
      known = points_.back().step >= 9 || (observed() && order < 2 * promised_);
      known = known && ((D1 <= 10 && E <= (phases_.unresolved ? 0.03 : 0.5)) ||
                        (E > 30 && observed() && order < 1.5 * promised_ && !phases));
    }
    if (!known) result_.finer = observed() ? "error" : "order";
    if (!known && (!coarse || phases)) result_.finer = coarse ? "phases" : "no longer step";
    // Modes above the stability limit that forces bound, such as friction, can hide from longer steps.
    double finer = 0.5;
    if (known && !phases)
      if (const auto found = unstable(points_.size() / 2))
        known = false, finer = std::max(0.5 / found->divisor, 1. / 64), result_.finer = "stability";
    if (!known && coarse && phases) coarse = twin(3);
    for (double ratio = finer; !known;) {
      auto fine = twin(ratio);
      if (!fine) break;
      const double D = differ(fine->states);
      result_.order.reset();
      if (coarse && D > 0) result_.order = orderOf(differ(coarse->states) / D, coarse->ratio, fine->ratio);
      const double p = std::min(result_.order.value_or(1), promised_);
      factor = p < 0.5 ? 1 : 1 / (1 - std::pow(fine->ratio, p));
      const double trusted = result_.order.value_or(0) > 0.5 * promised_ ? 0.5 : 0.03;
      known = ratio < 0.2 || ((D * factor < trusted || D * factor > 10) && !phases_.unresolved);
      ratio = 0.125, best = std::move(fine);
    }
    if (best)
      judge(best->states, factor);
    else
      result_.alarms.push_back({points_[0].state.t, "the error is unknown",
                                "runs with longer and with shorter steps fail", smallerStep(10), advised_});
    if (phases_.unresolved && result_.alarms.empty() && !(scaled(result_.error) < 0.3))
      result_.alarms.push_back({*phases_.unresolved, "the error is not estimated",
                                "a phase of the forces is shorter than 1/4096 of a step",
                                smallerStep(100, true), advised_});
    checkConserved();
    // An error that no twin has measured, or of a kind of coordinate that the robot lacks, is not a number.
    const auto forget = [&](bool angular, double StateError::*position, double StateError::*velocity) {
      if (!best || !std::ranges::count(coordinates_, angular, &VelocityName::angular))
        result_.error.*position = result_.error.*velocity = std::numeric_limits<double>::quiet_NaN();
    };
    forget(false, &StateError::position, &StateError::linear_velocity);
    forget(true, &StateError::angle, &StateError::angular_velocity);
    return std::move(result_);
  }

 private:
  struct Twin {
    double ratio;  ///< of its steps to those of the run
    std::vector<State<Sys>> states;
  };

  /// True if an effect has a force that begins or ends where the state decides.
  bool jumps() const {
    return std::ranges::any_of(setup_.scene.effects, [](const Request& r) {
      return r.name == "contact" || r.name == "collisions" || r.name == "joint_limits";
    });
  }
  bool rubs() const {
    return !adaptive_ && std::ranges::any_of(setup_.scene.effects, [](const Request& r) {
      return r.name == "joint_friction" || r.parameters.number("friction", 0) > 0 ||
             r.parameters.number("efficiency", 1) < 1;
    });
  }
  /// With a tolerance, an order above the promised one shows that the steps, and not the tolerance, bound the error.
  bool observed() const {
    return result_.order && *result_.order > 0.5 * promised_ &&
           (!adaptive_ || *result_.order < 1.2 * promised_);
  }
  /// The observed order, at most that of the method. Above it, differences are not yet those of short steps. Friction that
  /// changes its sign within a step leaves every method its first order, and steps in short phases have other ratios, and
  /// so have steps by a tolerance where they end at samples and events.
  double believedOrder() const {
    if (rubs()) return std::min(*result_.order, 1.0);
    if (shortened_) return std::min(*result_.order, 2.0);
    if (adaptive_) return std::min(*result_.order, promised_ - 1);
    return *result_.order > 1.2 * promised_ ? promised_ / 2 : std::min(*result_.order, promised_);
  }

  StateError difference(const State<Sys>& a, const State<Sys>& b) const {
    const auto [q_a, v_a] = setup_.system.toModel(a);
    const auto [q_b, v_b] = setup_.system.toModel(b);
    const Vec q = liecheck::difference(setup_.scene.model, Vec(q_a), Vec(q_b)), v = v_b - v_a;
    StateError e;
    for (int k = 0; k < q.size(); ++k) {
      const bool linear = !coordinates_[std::size_t(k)].angular;
      double &x = linear ? e.position : e.angle, &y = linear ? e.linear_velocity : e.angular_velocity;
      x = std::max(x, std::abs(q[k])), y = std::max(y, std::abs(v[k]));
    }
    return e;
  }
  /// The error in units of the accepted one.
  double scaled(const StateError& e) const {
    return std::max(e.position / result_.accepted.position, e.angle / result_.accepted.angle);
  }
  /// The largest difference from the run, or from `others`.
  double differ(const std::vector<State<Sys>>& states, const std::vector<State<Sys>>* others = nullptr) const {
    double largest = 0;
    for (std::size_t k = 0; k < states.size(); ++k)
      largest = std::max(largest, scaled(difference(others ? (*others)[k] : points_[k].state, states[k])));
    return largest;
  }
  /// Without a stated accuracy, an error of 1 % of the extent of the motion is accepted, and at least 1e-6.
  void setAccepted() {
    StateError extent;
    for (const auto& point : points_) {
      const StateError e = difference(points_[0].state, point.state);
      extent.position = std::max(extent.position, e.position), extent.angle = std::max(extent.angle, e.angle);
    }
    const auto accepted = [](double stated, double size) {
      return stated > 0 ? stated : std::max(0.01 * size, 1e-6);
    };
    result_.accepted.position = accepted(setup_.scene.accepted_position, extent.position);
    result_.accepted.angle = accepted(setup_.scene.accepted_angle, extent.angle);
  }

  /// A run with about ratio times as long steps, or none if it diverges or if its phases take ten times as many steps.
  std::optional<Twin> twin(double ratio) { return twin(ratio, ratio); }
  std::optional<Twin> twin(double ratio, double phases) {
    result_.by += (result_.by.empty() ? "steps of " : ", ") + decimal(ratio) + " h" +
                  (phases < ratio ? " with shorter phases" : "");
    const double order = methodInfo(setup_.scene.integrator).estimate_order;
    return twin(ratio, phases, std::max(setup_.scene.options.tolerance * std::pow(ratio, order), 1e-15));
  }
  std::optional<Twin> twin(double ratio, double phases, double tolerance) {
    const MethodOptions options{tolerance, [this] { return !go_on_(); }};
    const auto method = makeMethod<Sys>(setup_.scene.integrator, options);
    const double h = setup_.step(), all = double(points_.back().step);
    Twin twin{ratio, {points_[0].state}};
    State<Sys> now = points_[0].state;
    long made = 0, left = std::lround(10 * (all + double(phases_.tried)) * std::max(1.0, 1 / phases));
    for (std::size_t k = 1; k < points_.size(); ++k) {
      const long length = points_[k].step - points_[k - 1].step;
      const bool divides = ratio < 1 && !adaptive_;  // the steps of the run, each in equal parts
      const long steps = divides ? length : std::max(1L, std::lround(double(length) / ratio));
      Span span{h * double(length), steps, painleve_ ? 1 : 256};
      span.coarse = phases, span.compared = left;
      if (divides) span.divide = int(std::ceil(1 / ratio - 1e-9));
      const Outcome o = simulate(setup_.system, *method, now, span, [&](const auto& state, long n) {
        if (painleve_) lookForParadox(state);
        return n % 256 != 0 || go_on_();
      });
      if (o.stopped && o.steps < steps) throw Interrupted();
      shortened_ = shortened_ || (ratio > 1 && o.phases.count > 0);
      made += o.steps * span.divide, left -= o.phases.tried;
      result_.cost += adaptive_ ? double(length) / ratio / all : double(o.steps * span.divide) / all;
      if (o.diverged) return {};
      now.t = points_[k].state.t;
      disturb(now, k);
      twin.states.push_back(now);
    }
    if (!adaptive_) twin.ratio = all / double(made);
    return twin;
  }
  void lookForParadox(const State<Sys>& state) {
    const auto now = setup_.look(state, Kinematics::Velocities);
    result_.notice = painleve_->notice(now, setup_.effects);
    if (!result_.notice.empty()) painleve_.reset();
  }
  /// Changes v by eps/64, as the rounding errors of a compensated sum do, or by eps, as those of a plain sum. Without
  /// this, twins of a motion that amplifies rounding errors could agree with each other and with no exact motion.
  static void disturb(State<Sys>& state, std::size_t k) {
    const double size = eps<double>() / 64 * state.v.cwiseAbs().maxCoeff();
    for (int i = 0; i < state.v.size(); ++i) {
      const double change = (i + int(k)) % 3 == 0 ? -size : size;
      if (state.compensated)
        accumulate<double>(state.v[i], state.v_low[i], change);
      else
        state.v[i] += 64 * change;
    }
  }
  /// p of (r^p - 1) / (1 - f^p) = quotient, by bisection: the left side increases with p.
  static double orderOf(double quotient, double r, double f) {
    double low = 0.01, high = 20;
    while (high - low > 1e-3) {
      const double p = (low + high) / 2;
      (((std::pow(r, p) - 1) / (1 - std::pow(f, p)) < quotient) ? low : high) = p;
    }
    return low;
  }

  void judge(const std::vector<State<Sys>>& states, double factor) {
    std::optional<std::size_t> first;
    // A twin shows the sum of its own and the run's rounding errors, which do not decrease with the step.
    const double rounding = eps<double>() * std::sqrt(double(points_.back().step));
    for (std::size_t k = 1; k < states.size(); ++k) {
      StateError e = difference(points_[k].state, states[k]), &largest = result_.error;
      for (double StateError::*x : {&StateError::position, &StateError::angle, &StateError::linear_velocity,
                                    &StateError::angular_velocity})
        e.*x = std::max(factor * e.*x, std::min(e.*x, rounding)), largest.*x = std::max(largest.*x, e.*x);
      if (!first && scaled(e) > 1) first = k;
    }
    if (!first) return;
    const double excess = scaled(result_.error);
    const std::string what = "the estimated error is " + decimal(excess, "%.3g") + " times the accepted one";
    if (alarmOfStability(*first, what)) return;
    if (!observed() && alarmOfRounding(*first, what)) return;
    // Far above the step at which a method has its order, and across contacts, fewer digits are won.
    const double p = std::clamp(result_.order.value_or(1), 0.5, jumps() ? 1.0 : std::min(promised_, 2.0));
    const double times = std::pow((jumps() ? 10 : 3) * excess, 1 / p);
    const std::string cause =
        !result_.order ? "order not observed: no other step agrees"
        : *result_.order < 0.7 * promised_
            ? "order " + decimal(*result_.order, "%.2g") + " is observed, and " + setup_.scene.integrator +
                  " has " + decimal(promised_) + ": the motion has jumps, or modes faster than the step"
            : "the steps of " + setup_.scene.integrator + " are too long for this motion";
    const bool stiff = !result_.order || *result_.order < 0.7 * promised_;
    result_.alarms.push_back({points_[*first].state.t, what, cause, smallerStep(times, stiff), advised_});
  }

  /// An alarm if a twin with the same steps, which differs by rounding errors only, has a good part of the error.
  bool alarmOfRounding(std::size_t first, const std::string& what) {
    const auto same = twin(1);
    if (!same || differ(same->states) < 0.2) return false;
    char until[60];
    std::snprintf(until, sizeof until, "end the scene before t = %.4g s", points_[first - 1].state.t);
    result_.alarms.push_back({points_[first].state.t, what, "the motion amplifies rounding errors",
                              std::string(until) + ", or state a larger 'accuracy'"});
    return true;
  }
  /// A checkpoint at which a step is unstable, and the divisor of the step that makes it stable there.
  struct Unstable {
    std::size_t at;
    double divisor;
    Stability stability;
  };
  /// The least stable of 17 checkpoints over the run, of `first` and of the one before it; none if all are stable.
  std::optional<Unstable> unstable(std::size_t first) {
    if (adaptive_ || setup_.system.nv() > largest_analysed) return {};
    const double h = setup_.step();
    std::vector<std::size_t> tried = {first - 1, first};
    for (std::size_t k = 0; k < points_.size(); k += std::max<std::size_t>(1, points_.size() / 16))
      tried.push_back(k);
    std::optional<Unstable> worst;
    double divisor = 1;
    for (const std::size_t k : tried)
      for (double needed = divisor;;) {
        const Stability s = stabilityOf(setup_, points_[k].state, h / needed);
        if (s.stable() || needed > 1e6) break;
        const bool new_worst = needed == divisor;
        divisor = needed = divisorOf(1.5 * needed);
        if (new_worst) worst = {k, divisor, s};
        worst->divisor = divisor;
        if (!go_on_()) throw Interrupted();
      }
    return worst;
  }
  /// An alarm if a step is unstable at a checkpoint near the first bad one, with a step that is stable there.
  bool alarmOfStability(std::size_t first, const std::string& what) {
    const auto found = unstable(first);
    if (!found) return false;
    const State<Sys>& state = points_[found->at].state;
    const std::string effect = stiffestEffect(setup_, state);
    const std::string cause =
        "the step is above the stability limit of " + (effect.empty() ? "the robot" : "'" + effect + "'") +
        ", whose fastest mode has |lambda| = " + decimal(found->stability.stiffest, "%.3g") +
        " 1/s at t = " + decimal(state.t, "%.4g") + " s";
    const double p = jumps() ? 1 : std::min(promised_, 2.0);
    const double times = std::min(std::pow((jumps() ? 10 : 3) * scaled(result_.error), 1 / p), 100.0);
    result_.alarms.push_back({points_[first].state.t, what, cause,
                              smallerStep(std::max(2 * found->divisor, times), true), advised_});
    return true;
  }

  /// The remedy for steps that are `times` as long as they should be: shorter ones, or steps by a tolerance if
  /// they had to be more than 100 times shorter, with an L-stable method if stability may limit them.
  std::string smallerStep(double times, bool stiff = false) {
    const std::string or_else = ", or state a larger 'accuracy'";
    advised_ = 0;
    if (adaptive_) return "take the tolerance " + decimal(enoughTolerance(), "%.0e") + or_else;
    if (phases_.count > 0) times *= setup_.step() / phases_.shortest;
    if (times > 100) {
      const double accepted = std::min(result_.accepted.position, result_.accepted.angle);
      return std::string("take integrator: {name: ") + (stiff ? "radau5" : "dopri5") +
             ", tolerance: " + decimal(std::clamp(1e-4 * accepted, 1e-12, 1e-6), "%.0e") + "}" + or_else;
    }
    advised_ = setup_.step() / divisorOf(times);
    return "take steps of " + decimal(advised_) + " s" + or_else;
  }

  /// The first tolerance, each a tenth of the one before, whose run differs from the next one by less than a third
  /// of the accepted error. While the longest allowed step limits the steps, a tolerance changes nothing.
  double enoughTolerance() {
    double tolerance = setup_.scene.options.tolerance;
    for (auto coarse = twin(1, 1, tolerance); tolerance > 1e-13; tolerance /= 10) {
      const auto fine = twin(1, 1, tolerance / 10);
      if (coarse && fine && differ(coarse->states) > 0.5 && differ(coarse->states, &fine->states) < 1. / 3)
        return tolerance;
      coarse = fine;
    }
    return tolerance;
  }

  void checkConserved() {
    if (const auto left = leftAt(setup_, points_))
      result_.alarms.push_back({left->first, left->second,
                                "the error of " + setup_.scene.integrator + " at this step", smallerStep(10),
                                advised_});
  }

  Setup<Sys>& setup_;
  const std::vector<Checkpoint<Sys>>& points_;
  const PhaseSteps& phases_;
  const std::function<bool()>& go_on_;
  bool adaptive_;
  bool shortened_;  ///< the run or a twin with longer steps has shortened steps in a phase
  std::vector<VelocityName> coordinates_;
  std::optional<PainleveTest> painleve_;  ///< until it has found a paradox; none without friction
  double promised_ = 1, advised_ = 0;
  Estimate result_;
};

}  // namespace

template <class Sys>
Estimate estimateError(Setup<Sys>& setup, const std::vector<Checkpoint<Sys>>& points, const Outcome& outcome,
                       const std::function<bool()>& go_on) {
  return Estimator<Sys>(setup, points, outcome, go_on).run();
}

using GoOn = std::function<bool()>;
template <class Sys>
using Points = std::vector<Checkpoint<Sys>>;
template Estimate estimateError(Setup<LoneBody<double>>&, const Points<LoneBody<double>>&, const Outcome&,
                                const GoOn&);
template Estimate estimateError(Setup<ThrownBody<double>>&, const Points<ThrownBody<double>>&, const Outcome&,
                                const GoOn&);
template Estimate estimateError(Setup<LoneJoint<double>>&, const Points<LoneJoint<double>>&, const Outcome&,
                                const GoOn&);
template Estimate estimateError(Setup<Tree<double>>&, const Points<Tree<double>>&, const Outcome&,
                                const GoOn&);

}  // namespace liecheck::scene
