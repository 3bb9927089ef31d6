#include <search/condition.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <invariants/property.hpp>
#include <invariants/tree_case.hpp>
#include <invariants/tree_laws.hpp>
#include <search/shrink.hpp>
#include <span>
#include <subjects/number_function.hpp>
#include <support/stop.hpp>
#include <utility>

namespace liecheck::properties {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity(),
                 lowest = std::numeric_limits<double>::lowest(),  // above log2(0)
    smallest = std::numeric_limits<double>::denorm_min();
constexpr std::uint64_t tried_cases = 2000, least = 3;
constexpr std::uint64_t enough_cases = 1000, enough_failures = 20;
constexpr double most_seconds = 3;  // of subjects so slow that what is found may change from run to run

/// How a feature is written. `scale`: its values are log2 of a size over the largest exponent of the scalar.
/// `sign`: only its sign is looked at, since its size follows from an angle.
enum class Written { number, scale, flag, count, sign };
struct Name {
  Feature feature;
  const char* name;
  const char* unit;  ///< of a flag, what holds where it is 0
  Written written;
};
/// The simplest first. Angles are left out: bands tell of them.
constexpr Name names[] = {
    {Feature::w, "w", "", Written::sign},
    {Feature::x_negative, "x < 0", "x >= 0", Written::flag},
    {Feature::y_negative, "y < 0", "y >= 0", Written::flag},
    {Feature::z_negative, "z < 0", "z >= 0", Written::flag},
    {Feature::product, "Q0 . Q1", "", Written::sign},
    {Feature::second_w, "w of the second quaternion", "", Written::sign},
    {Feature::trace, "trace(R)", "", Written::sign},
    {Feature::zeros, "zeros among x, y, z", "", Written::count},
    {Feature::largest, "the largest of |x|, |y|, |z| is number", "", Written::count},
    {Feature::octant, "the octant of x, y, z", "", Written::count},
    {Feature::fraction, "t", "", Written::number},
    {Feature::lock, "the angle from gimbal lock", " rad", Written::number},
    {Feature::order, "the order of Euler angles", "", Written::count},
    {Feature::seen, "the reference frame", "", Written::count},
    {Feature::joints, "joints", "", Written::count},
    {Feature::revolute, "revolute joints", "", Written::count},
    {Feature::continuous, "continuous joints", "", Written::count},
    {Feature::prismatic, "prismatic joints", "", Written::count},
    {Feature::helical, "helical joints", "", Written::count},
    {Feature::spherical, "spherical joints", "", Written::count},
    {Feature::planar, "planar joints", "", Written::count},
    {Feature::translation, "translation joints", "", Written::count},
    {Feature::free_flyer, "free-flyers", "", Written::count},
    {Feature::mimics, "mimic joints", "", Written::count},
    {Feature::armature, "a joint has an armature", "no joint has an armature", Written::flag},
    {Feature::wrench, "a wrench acts", "no wrench acts", Written::flag},
    {Feature::shape, "the shape (0 chain, 1 star, 2 all on the world, 3 other)", "", Written::count},
    {Feature::length, "the longest vector", " m", Written::scale},
    {Feature::first_length, "the length of the first vector", "", Written::scale},
    {Feature::second_length, "the length of the second vector", "", Written::scale},
    {Feature::speed, "the velocity", "", Written::scale},
    {Feature::force, "the force", "", Written::scale},
    {Feature::mass, "the mass", " kg", Written::scale},
    {Feature::apart, "|p1 - p0| / |p0|", "", Written::number},
    {Feature::off_unit, "| |Q|^2 - 1 |", " eps", Written::number},
    {Feature::norm, "|Q|", "", Written::number},
    {Feature::off_orthogonal, "|R^T R - I|", " eps", Written::number},
    {Feature::along, "the cosine between the axis and the vector", "", Written::number},
    {Feature::point, "the inertia is 0", "the inertia is not 0", Written::flag},
    {Feature::moments_apart, "the smallest difference of moments of inertia, over the largest moment", "",
     Written::number},
    {Feature::thin, "the smallest over the largest moment of inertia", "", Written::number},
    {Feature::flat, "(I1 + I2 - I3) / I3 of the moments of inertia", "", Written::number},
    {Feature::mass_ratio, "the ratio of masses", "", Written::number},
    {Feature::position, "the largest number of q", "", Written::number},
    {Feature::joint_speed, "the largest number of v", "", Written::number},
    {Feature::drive, "the largest acceleration or torque", "", Written::number},
};

/// What became of one input, and the features of the call of the output's operation. Without such a call they are NaN.
struct Tried {
  std::vector<double> input;
  Features features;
  bool failed = false;
  double error = 0;  ///< [eps]
  std::size_t band = 0;
};

/// While it exists, calls of this thread go through a hook.
class Hooked {
 public:
  explicit Hooked(CallHook& hook) : before_(std::exchange(call_hook(), &hook)) {}
  Hooked(const Hooked&) = delete;
  Hooked& operator=(const Hooked&) = delete;
  ~Hooked() { call_hook() = before_; }

 private:
  CallHook* before_;
};

/// Measures inputs of a law, and looks at the calls.
class Trial {
 public:
  Trial(const Series& series, std::size_t output)
      : series_(series), output_(output), of_tree_(is_tree_law(series.property) && !series.on_robot) {}

  /// None if nothing was measured of the output.
  std::optional<Tried> operator()(const std::vector<double>& x) {
    std::optional<Features> features;
    Context context;
    if (of_tree_) context = context_of(described(TreeCase<double>(TreeLayout::of_size(x.size()), x, x)));
    CallHook* const before = call_hook();
    CallHook hook = [&](const NumberFunction& f, void* arguments, void* results) {
      if (!features && f.operation == series_.outputs[output_].record) {
        const std::size_t n = count_numbers(f.operation->arguments, f.model);
        const std::vector<double> numbers = f.scalar->with([&]<class S>() {
          return std::vector<double>(static_cast<const S*>(arguments), static_cast<const S*>(arguments) + n);
        });
        features = features_of(f, numbers, context);
      }
      before ? (*before)(f, arguments, results) : f.compute(arguments, results);
    };
    std::vector<Judged> judged;
    {
      const Hooked hooked(hook);
      judged = series_.measure(x);
    }
    const auto of_output = std::ranges::find_if(
        judged, [&](const Judged& j) { return static_cast<std::size_t>(j.residual.output) == output_; });
    if (!features && of_tree_) features = context.features;  // the output is formed from several calls
    if (of_output == judged.end() || !features) return std::nullopt;
    const auto failure = failure_of(judged, static_cast<int>(output_));
    const Residual& r = (failure ? *failure : *of_output).residual;
    return Tried{x, *features, failure.has_value(), r.error, r.band};
  }

 private:
  const Series& series_;
  std::size_t output_;
  bool of_tree_;
};

/// A point between two inputs of the same size: of rotations along an arc, of all else along a line. Empty if a group that
/// has no points between differs.
std::vector<double> point_between(const Series& series, const std::vector<double>& a,
                                  const std::vector<double>& b, double t) {
  std::vector<double> x(a.size());
  std::size_t at = 0;
  for (const Field& f : series.fields) {
    const auto n = static_cast<std::size_t>(f.size);
    const bool quaternion = n == 4 && (f.kind == Kind::quaternion || f.kind == Kind::any_quaternion),
               matrix = n == 9 && f.kind == Kind::rotation_matrix;
    double square = 0;
    for (std::size_t i = at; i < at + n; ++i) x[i] = (1 - t) * a[i] + t * b[i], square += x[i] * x[i];
    if ((quaternion && f.kind == Kind::quaternion) || f.kind == Kind::direction)
      for (std::size_t i = at; i < at + n; ++i) x[i] /= std::sqrt(square);
    if (matrix) {
      using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
      const Eigen::Matrix3d R0 = Eigen::Map<const Rows>(&a[at]), R1 = Eigen::Map<const Rows>(&b[at]);
      Eigen::Map<Rows>{&x[at]} = Eigen::Quaterniond(R0).slerp(t, Eigen::Quaterniond(R1)).toRotationMatrix();
    }
    const bool smooth = quaternion || matrix || f.kind == Kind::vector || f.kind == Kind::rotation_vector ||
                        f.kind == Kind::fraction || f.kind == Kind::angle || f.kind == Kind::positive ||
                        f.kind == Kind::direction;
    if (!smooth)
      for (std::size_t i = at; i < at + n; ++i) {
        if (a[i] != b[i]) return {};
        x[i] = a[i];
      }
    at += n;
  }
  if (at != a.size()) return {};
  for (double& number : x) number = series.format().rounded(number);
  return x;
}

class ConditionSearch {
 public:
  ConditionSearch(const Series& series, std::size_t output,
                  const std::function<bool(std::size_t band)>& fails_in)
      : series_(series), trial_(series, output), fails_in_(fails_in) {}

  std::optional<Condition> run(std::uint64_t seed) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(most_seconds);
    for (std::uint64_t i = 0, failed = 0; i < tried_cases; ++i) {
      if (stop_requested || std::chrono::steady_clock::now() > end) break;
      if (i >= enough_cases && failed >= enough_failures) break;
      auto t = trial_(series_.numbers(series_.id(seed, i)));
      if (!t) continue;
      failed += t->failed;
      all_.push_back(std::move(*t));
    }
    auto found = separating();
    if (found || !fails_in_) return found;
    std::erase_if(all_, [&](const Tried& t) { return !fails_in_(t.band); });
    in_bands_ = true;
    found = separating();
    if (found) found->in_bands = true;
    return found;
  }

 private:
  std::optional<Condition> separating() {
    const auto failed = static_cast<std::uint64_t>(std::ranges::count_if(all_, &Tried::failed));
    if (failed < least || all_.size() - failed < least) return std::nullopt;
    std::optional<Condition> best;
    double least_cost = std::numeric_limits<double>::infinity();
    for (const Name& name : names)
      for (const Condition& c : candidates(name, failed))
        if (const double cost = errors(c) + 0.02 * static_cast<double>(failed) * borders(name, c);
            cost < least_cost)
          best = c, least_cost = cost;
    // It must leave out a twentieth of the inputs, or it tells nothing. It must hold for 95 % of the failing inputs, and of the others at most 2 % may fail. Where it holds, 90 % fail; or half,
    // if it leaves out a fifth of all inputs; or a quarter, if that is three times the share of all: a small error is often
    // within its limit. A border that is no zero or whole number costs as much as 2 % of the failing inputs.
    if (!best || 20 * best->failed < 19 * failed) return std::nullopt;
    const auto share = [](std::uint64_t part, std::uint64_t whole) {
      return static_cast<double>(part) / static_cast<double>(std::max<std::uint64_t>(whole, 1));
    };
    const double inside = share(best->failed, best->cases), all = share(failed, all_.size());
    const bool separates = 50 * best->failed_elsewhere <= best->elsewhere + 50,
               halves = inside >= 0.5 && 5 * best->elsewhere >= all_.size();
    const bool angle_alone = best->feature == Feature::trace;  // a negative trace is an angle above 2 pi / 3
    if (!separates || 20 * best->elsewhere < all_.size() || (inside < 0.9 && angle_alone) ||
        (inside < 0.9 && !halves && (inside < 0.25 || inside < 3 * all)))
      return std::nullopt;
    for (const bool low : {true, false}) refine(*best, low);
    for (const Tried& t : all_)
      if (t.failed) best->errors.emplace_back(t.features[best->feature], t.error * series_.eps);
    std::ranges::sort(best->errors);
    return best;
  }
  static double errors(const Condition& c) {
    return static_cast<double>(c.cases - c.failed + c.failed_elsewhere);
  }
  /// How many borders of a condition are no natural ones: a zero, or those of what has whole numbers.
  static int borders(const Name& name, const Condition& c) {
    if (name.written == Written::flag) return 0;
    const auto chosen = [](double border) {
      return std::isfinite(border) && std::fabs(border) > smallest && border != lowest;
    };
    const int all = chosen(c.low) + chosen(c.high);
    return name.written == Written::count ? std::min(all, 1) : all;
  }
  void count(Condition& c) const {
    c.failed = c.cases = c.failed_elsewhere = c.elsewhere = 0;
    for (const Tried& t : all_)
      c.holds(t.features) ? (++c.cases, c.failed += t.failed)
                          : (++c.elsewhere, c.failed_elsewhere += t.failed);
  }
  /// The ranges of a feature, open on a side or not, that hold all failing cases, or all but a twentieth on a side.
  std::vector<Condition> candidates(const Name& name, std::uint64_t failed) const {
    std::vector<double> of_failed, of_all;
    for (const Tried& t : all_)
      if (const double v = t.features[name.feature]; v == v) {
        of_all.push_back(v);
        if (t.failed) of_failed.push_back(v);
      }
    if (of_failed.size() < least || 20 * of_failed.size() < 19 * failed) return {};
    std::ranges::sort(of_failed), std::ranges::sort(of_all);
    const auto above = [&](double v) {  // the next value that a case has
      const auto at = std::ranges::upper_bound(of_all, v);
      return at == of_all.end() ? infinity : *at;
    };
    std::vector<Condition> all;
    const std::size_t few = of_failed.size() / 20;
    const double low = of_failed.front(), high = above(of_failed.back());
    const std::pair<double, double> ranges[] = {{0.0, smallest},
                                                {-infinity, 0.0},
                                                {0.0, infinity},
                                                {-infinity, of_failed.back() == -infinity ? lowest : high},
                                                {low, infinity},
                                                {low, high},
                                                {-infinity, above(of_failed[of_failed.size() - 1 - few])},
                                                {of_failed[few], infinity}};
    for (const auto& [from, to] : std::span(ranges).first(name.written == Written::sign ? 3 : 8)) {
      Condition c{name.feature, from, to};
      count(c);
      if (c.elsewhere > 0) all.push_back(c);
    }
    return all;
  }
  /// Moves a border of the condition to where inputs between a failing and a passing one change.
  void refine(Condition& c, bool low) {
    const double border = low ? c.low : c.high;
    if (std::fabs(border) <= smallest || border == lowest) return;  // zero
    const Name& name = *std::ranges::find(names, c.feature, &Name::feature);
    if (!std::isfinite(border) || name.written > Written::scale) return;
    const Tried *in = nullptr, *out = nullptr;  // the nearest to the border on both sides
    for (const Tried& t : all_) {
      const double v = t.features[c.feature];
      if (v != v) continue;
      const bool beyond = low ? v < border : v >= border;
      if (t.failed && c.holds(t.features) &&
          (!in || (low ? v < in->features[c.feature] : v > in->features[c.feature])))
        in = &t;
      if (!t.failed && beyond &&
          (!out || (low ? v > out->features[c.feature] : v < out->features[c.feature])))
        out = &t;
    }
    if (!in || !out) return;
    double inside = in->features[c.feature], outside = out->features[c.feature];
    std::vector<double> a = in->input, b = out->input;
    const auto closer = [&](double share) {
      const std::vector<double> x = point_between(series_, a, b, share);
      if (x.empty() || x == a || x == b || !series_.tested_law().valid(x)) return false;
      const auto t = trial_(x);
      if (!t || (in_bands_ && !fails_in_(t->band))) return false;
      const double v = t->features[c.feature];
      if (!(v >= std::min(inside, outside) && v <= std::max(inside, outside))) return false;
      (t->failed ? inside : outside) = v;
      (t->failed ? a : b) = x;
      return true;
    };
    // A vector between two that point elsewhere may be shorter than both, and longer ones are near the ends.
    const double shares[] = {0.5, 0.25, 0.75, 0.1, 0.9};
    for (int k = 0; k < 40 && a.size() == b.size() && !stop_requested; ++k)
      if (std::ranges::none_of(shares, closer)) break;
    Condition moved = c;
    double to = rounded(inside, outside);
    if (name.written == Written::scale) {  // the shortest size, not the shortest logarithm
      const double most = series_.format().max_exponent;
      const double size = std::log2(rounded(std::exp2(inside * most), std::exp2(outside * most))) / most;
      if (std::isfinite(size)) to = size;
    }
    (low ? moved.low : moved.high) = to;
    count(moved);
    if (errors(moved) <= errors(c)) c = moved;
  }
  /// The shortest number between two.
  static double rounded(double a, double b) {
    const double low = std::min(a, b), high = std::max(a, b);
    if (low <= 0 && high >= 0) return 0;
    for (int digits = 1; digits < 17; ++digits) {
      const double x = std::stod(fmt::format("{:.{}g}", (a + b) / 2, digits));
      if (x >= low && x <= high) return x;
    }
    return (a + b) / 2;
  }

  const Series& series_;
  Trial trial_;
  const std::function<bool(std::size_t band)>& fails_in_;
  bool in_bands_ = false;
  std::vector<Tried> all_;
};

}  // namespace

std::optional<Condition> condition_of(const Series& series, std::size_t output, std::uint64_t seed,
                                      const std::function<bool(std::size_t band)>& fails_in) try {
  return ConditionSearch(series, output, fails_in).run(seed);
} catch (const GivenUp&) {  // a signal ended a call
  return std::nullopt;
}

std::string text_of(const Condition& c, const Scalar& scalar) {
  const Name& name = *std::ranges::find(names, c.feature, &Name::feature);
  const auto value = [&](double v) {
    return name.written == Written::scale
               ? fmt::format("{:.2g}{}", std::exp2(v * scalar.max_exponent), name.unit)
           : name.written == Written::count ? fmt::format("{}", std::ceil(v))
                                            : fmt::format("{:.2g}{}", v, name.unit);
  };
  if (name.written == Written::flag) return c.low > 0 ? name.name : name.unit;
  if (c.low == 0 && c.high == smallest) return fmt::format("{} = 0", name.name);
  if (c.high == lowest) return fmt::format("{} is 0", name.name);
  const bool below = c.low == -infinity, above = c.high == infinity;
  if (name.written == Written::count && (!above || below)) {
    const double first = std::ceil(c.low), last = std::ceil(c.high) - 1;
    if (below) return fmt::format("{} <= {}", name.name, last);
    return first == last ? fmt::format("{} = {}", name.name, first)
                         : fmt::format("{} from {} to {}", name.name, first, last);
  }
  if (below) return fmt::format("{} < {}", name.name, value(c.high));
  if (above) return fmt::format("{} >= {}", name.name, value(c.low));
  return fmt::format("{} from {} to {}", name.name, value(c.low), value(c.high));
}

}  // namespace liecheck::properties
