#include <search/plain.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <invariants/property.hpp>
#include <numbers>
#include <support/line_fit.hpp>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

using Plain = std::vector<double>;  // numbers of a group or of an input
constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Round angles in a band [rad]: in its middle, and then near its edges, since a border may be between them.
std::vector<double> angles_in(const Band& b) {
  if (b.axis == Axis::none && b.region == Region::to_pi) return {1.5};
  if (b.axis == Axis::none) return {b.low < 4 ? 4.0 : b.low < 10 ? 6.0 : 200.0};
  std::vector<double> all;
  for (const double share : {3.0, 1.5, 7.0})
    if (share * b.low < b.high || all.empty())
      all.push_back(b.axis == Axis::pi_minus_theta ? std::numbers::pi - share * b.low
                    : b.low > 0                    ? share * b.low
                                                   : b.high / 2);
  return b.high > 0 && b.low > 0 ? all : std::vector<double>{all.front()};
}

/// The simple axes.
const Eigen::Vector3d axes[] = {{1, 0, 0}, {0, 0, 1}, {2. / 3, -1. / 3, 2. / 3}};

bool turns(Kind kind) {
  return kind == Kind::rotation_vector || kind == Kind::quaternion || kind == Kind::any_quaternion ||
         kind == Kind::rotation_matrix;
}

/// The vectors of an input, in their order.
struct Vectors {
  Plain first, second, others;
};
const Vectors vectors[] = {{{1, 2, 3}, {2, -1, 0.5}, {0.5, 3, -1}},
                           {{1, 0, 0}, {0, 0, 0}, {0, 0, 0}},
                           {{1, 2, 3}, {1 + 1e-7, 2, 3}, {1, 0, 0}},
                           {{1000, 2000, 3000}, {2000, -1000, 500}, {500, 3000, -1000}},
                           {{0, 0, 0}, {1, 2, 3}, {1, 0, 0}},
                           // no floats
                           {{0.1, 0.2, 0.3}, {0.4, -0.7, 0.6}, {-0.3, 0.8, 0.9}},
                           {{123.4, -234.5, 345.6}, {345.6, 123.4, -234.5}, {234.5, 345.6, 123.4}}};

/// One choice for each group: `turned` is the group with the angle, all others keep still, or all have it.
Plain input_of(const std::vector<Field>& fields, std::size_t turned, double angle, std::size_t axis,
               double sign, const Vectors& of) {
  Plain all;
  std::size_t vectors_before = 0, directions = 0;
  for (std::size_t k = 0; k < fields.size(); ++k) {
    const Field& f = fields[k];
    const auto size = static_cast<std::size_t>(f.size);
    const bool turn_it = turned == fields.size() || k == turned;
    const Eigen::AngleAxisd turn(turn_it ? angle : 0, axes[axis]);
    const Eigen::Quaterniond Q(turn);
    const double s = turn_it ? sign : 1;
    Plain group(size, 0);
    if (f.kind == Kind::rotation_vector && size == 3)
      group = {turn.angle() * axes[axis][0], turn.angle() * axes[axis][1], turn.angle() * axes[axis][2]};
    else if ((f.kind == Kind::quaternion || f.kind == Kind::any_quaternion) && size == 4)
      group = {s * Q.x(), s * Q.y(), s * Q.z(), s * Q.w()};
    else if ((f.kind == Kind::rotation_matrix || f.kind == Kind::near_rotation) && size == 9)
      Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(group.data()) = turn.toRotationMatrix();
    else if (f.kind == Kind::vector && (size == 3 || size == 2))
      group = vectors_before == 0   ? of.first
              : vectors_before == 1 ? of.second
                                    : of.others,
      ++vectors_before, group.resize(size);
    else if (f.kind == Kind::direction && size > 1)  // the second of two is turned
      group[0] = directions++ == 0 && size == 3 ? 1 : std::cos(angle),
      group[axis == 1 ? size - 1 : 1] = group[0] == 1 ? 0 : std::sin(angle);
    else if (f.kind == Kind::fraction)
      group.assign(size, 0.25);
    else if (f.kind == Kind::angle)
      group.assign(size, std::min(angle, 3.0));
    else if (f.kind == Kind::positive)
      group.assign(size, 1);
    else if (f.kind == Kind::covariance)
      for (std::size_t i = 0; i < 6; ++i) group[7 * i] = 1;
    else if (f.kind == Kind::inertia && size == 9)
      group = {0.5, 0, 0, 0, 0.75, 0, 0, 0, 1};
    else if (f.kind != Kind::choice)
      return {};
    all.insert(all.end(), group.begin(), group.end());
  }
  return all;
}

/// The input rounded to the scalar; empty if the law does not take it.
Plain taken(const Series& series, Plain x) {
  for (double& number : x) number = series.format().rounded(number);
  const Property& law = series.tested_law();
  return x.empty() || !law.takes(x.size()) || !law.valid(x) ? Plain() : x;
}

}  // namespace

std::optional<Shrunk> plain_failure(const Series& series, const CaseId& worst, int output,
                                    const std::vector<BandOfFailure>& bands, bool with_error) {
  const auto first = failure_of(series.measure_twice(series.numbers(worst)), output);
  if (!first || is_misuse(first->residual.outcome) || first->residual.outcome == Outcome::crashed)
    return std::nullopt;
  const Outcome outcome = with_error ? Outcome::measured : first->residual.outcome;
  const auto as_bad = [&](const Judged& j) {
    if (j.residual.outcome != outcome) return false;
    const auto band = std::ranges::find(bands, j.residual.band, &BandOfFailure::band);
    return band != bands.end() && (j.residual.outcome != Outcome::measured ||
                                   10 * score_of(series, j) >= std::min(band->score, 1 / series.eps));
  };
  const std::size_t fields = series.fields.size();
  const auto with_angle = [&](double angle) -> std::optional<Shrunk> {
    for (const Vectors& of : vectors)
      for (const double sign : {1.0, -1.0})
        for (std::size_t turned = fields + 1; turned-- > 0;)
          for (std::size_t axis = 0; axis < 3; ++axis) {
            if (turned < fields && !turns(series.fields[turned].kind)) continue;
            if (stop_requested) return std::nullopt;
            const Plain x = taken(series, input_of(series.fields, turned, angle, axis, sign, of));
            if (x.empty()) continue;
            const auto j = failure_of(series.measure(x), output);
            if (j && as_bad(*j)) return case_with(series, worst, x, *j);
          }
    return std::nullopt;
  };
  for (const bool ordinary : {true, false})
    for (std::size_t k = 0; k < 3; ++k)
      for (const BandOfFailure& band : bands) {
        const std::vector<double> angles = angles_in(series.bands()[band.band]);
        if (band.ordinary != ordinary || k >= angles.size()) continue;
        if (auto found = with_angle(angles[k])) return found;
      }
  return std::nullopt;
}

namespace {

/// The inputs with an angle in one group, or in all, about one axis, and with one sign.
struct Choice {
  std::size_t turned, axis;
  double sign;
};
std::vector<Choice> choices_of(const Series& series) {
  const auto of_kind = [&](auto is) { return std::ranges::count_if(series.fields, is, &Field::kind); };
  const bool any_sign =
      of_kind([](Kind k) { return k == Kind::quaternion || k == Kind::any_quaternion; }) > 0;
  const bool one_turns = of_kind(turns) == 1;  // which is all of them
  std::vector<Choice> all;
  for (const double sign : any_sign ? std::vector{1.0, -1.0} : std::vector{1.0})
    for (std::size_t turned = series.fields.size() + 1; turned-- > 0;)
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (turned == series.fields.size() || (!one_turns && turns(series.fields[turned].kind)))
          all.push_back({turned, axis, sign});
  return all;
}

/// Whether a result is judged at this angle, and not at that of another argument.
bool is_at(const Series& series, const Judged& j, double angle) {
  const Band& b = series.bands()[j.residual.band];
  const double at = b.axis == Axis::pi_minus_theta ? std::numbers::pi - angle : angle;
  return b.axis == Axis::none || (at > 0.99 * b.low && at < 1.01 * b.high);
}

/// Error over limit of a plain input, if `only_there` at this angle alone; infinite for an outcome without an error, none if the law does not take it.
std::optional<double> error_over_limit(const Series& series, int output, const Choice& of, double angle,
                                       bool only_there = false) {
  const Plain x = taken(series, input_of(series.fields, of.turned, angle, of.axis, of.sign, vectors[0]));
  if (stop_requested || x.empty()) return std::nullopt;
  double most = 0;
  for (const Judged& j : series.measure(x)) {
    if (j.residual.output != output || (only_there && !is_at(series, j, angle))) continue;
    const double own = score_of(series, j) / (j.budget ? j.budget->limit : 1);
    most = std::max(most, !j.failed                                 ? std::min(own, 1.0)
                          : j.residual.outcome != Outcome::measured ? unbounded
                                                                    : std::max(own, 1 + 1e-9));
  }
  return most;
}

}  // namespace

std::optional<Crossing> angle_between(const Series& series, int output, double failing, double passing) try {
  for (const Choice& choice : choices_of(series)) {
    const auto score = [&](double angle) { return error_over_limit(series, output, choice, angle); };
    const double worse = score(failing).value_or(0), better = score(passing).value_or(unbounded);
    if (worse <= 1 || (better > 1 && better > worse / 30)) continue;
    const auto crossing = [&](double level) {
      double in = failing, out = passing, beside = better;
      for (int k = 0; k < 12; ++k) {  // two decades to a factor of 1.001
        const double angle = std::sqrt(in * out);
        const auto s = score(angle);
        if (!s) break;
        if (*s <= level) beside = *s;
        (*s > level ? in : out) = angle;
      }
      return Crossing{std::sqrt(in * out), beside};
    };
    // Where errors change at once, they cross the middle of both there; they may come within the limit far beyond.
    const double most = std::min(worse, 1 / series.eps), least = std::max(1.0, better);
    return Crossing{crossing(std::sqrt(most * least)).angle, crossing(least).passing};
  }
  return std::nullopt;
} catch (const GivenUp&) {  // a signal ended a call
  return std::nullopt;
}

std::optional<double> last_zero(const Series& series, int output, double low, double high) try {
  double last = 0;
  for (const Choice& choice : choices_of(series)) {
    const auto is_zero = [&](double angle) {  // then the error is as large as the right result
      const Plain x =
          taken(series, input_of(series.fields, choice.turned, angle, choice.axis, choice.sign, vectors[0]));
      if (stop_requested || x.empty()) return false;
      return std::ranges::any_of(series.measure(x), [&](const Judged& j) {
        return j.residual.output == output && is_at(series, j, angle) &&
               std::fabs(score_of(series, j) * series.eps - 1) < 1e-6;
      });
    };
    if (!is_zero(low) || is_zero(high)) continue;
    double from = low, to = high;
    for (int k = 0; k < 14; ++k) {
      const double middle = std::sqrt(from * to);
      (is_zero(middle) ? from : to) = middle;
    }
    last = std::max(last, from);
  }
  return last > 0 ? std::optional(last) : std::nullopt;
} catch (const GivenUp&) {  // a signal ended a call
  return std::nullopt;
}

namespace {

/// A formula whose error changes as the square of the angle changes it by 2.2 from one of these angles to the next.
constexpr double next_angle = 1.4678;

/// The largest error over limit of plain inputs at theta, or pi - theta. Errors within a sixth of the limit are rounding.
class LargestErrors {
 public:
  LargestErrors(const Series& series, int output, bool from_pi)
      : series_(series), output_(output), from_pi_(from_pi), choices_(choices_of(series)) {}
  static constexpr double least_factor = 6;
  double operator()(double at) const {
    double most = 1 / least_factor;
    for (const Choice& choice : choices_) {
      const auto error =
          error_over_limit(series_, output_, choice, from_pi_ ? std::numbers::pi - at : at, true);
      most = std::max(most, std::min(error.value_or(0), 1 / series_.eps));
    }
    return most;
  }

 private:
  const Series& series_;
  int output_;
  bool from_pi_;
  std::vector<Choice> choices_;
};

}  // namespace

double slope_of_errors(const Series& series, int output, double low, double high, bool from_pi) try {
  const LargestErrors largest(series, output, from_pi);
  LineFit fit;
  for (double at = low; at <= high && !stop_requested; at *= next_angle) {
    const double error = largest(at);
    if (error < 3 || error * series.eps > 1e-4) continue;
    fit.add(std::log(at), std::log(error));
  }
  return fit.count() < 6 ? 0 : fit.slope();
} catch (const GivenUp&) {  // a signal ended a call
  return 0;
}

std::optional<ErrorStep> step_of_errors(const Series& series, int output, double low, double high,
                                        bool from_pi) try {
  const LargestErrors largest(series, output, from_pi);
  std::optional<ErrorStep> steepest;
  double factor = LargestErrors::least_factor, below = largest(low);
  for (double at = low; at * next_angle <= high && !stop_requested; at *= next_angle) {
    const double above = largest(at * next_angle), ratio = std::max(above / below, below / above);
    if (ratio > factor && std::max(above, below) > 1) factor = ratio, steepest = ErrorStep{at, below, above};
    below = above;
  }
  if (!steepest) return std::nullopt;
  double from = steepest->angle, to = from * next_angle;
  const double middle = std::sqrt(steepest->below * steepest->above);
  for (int k = 0; k < 7; ++k) {  // to a factor of 1.003
    const double at = std::sqrt(from * to), error = largest(at);
    const bool is_below = (error > middle) == (steepest->below > middle);
    (is_below ? from : to) = at;
    (is_below ? steepest->below : steepest->above) = error;
  }
  steepest->angle = std::sqrt(from * to);
  return steepest;
} catch (const GivenUp&) {  // a signal ended a call
  return std::nullopt;
}

}  // namespace liecheck::properties
