#include <failures/shapes.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <search/plain.hpp>
#include <span>

namespace liecheck::properties {

namespace {

/// The errors in one band: x = log10 of its middle (theta, or pi - theta), y = log10 of error / limit, at least 0 and at
/// most where all digits are lost: larger errors tell nothing more; raw = log10 of the error, likewise.
struct Point {
  double x, y, raw, low, high;
  bool lost = false;      ///< whether the error leaves at most one and a half digits
  bool zero = false;      ///< whether the worst result differs from the right one by its size, as 0 does
  bool opposite = false;  ///< whether it differs by twice its size, as the opposite result does
  bool still = false;     ///< whether it differs by theta, or pi - theta, as that of theta = 0, or pi, does
  std::uint64_t cases = 0, failed = 0;
  bool many_fail() const { return 4 * failed > cases; }  ///< as a formula does, for many inputs of a band
};

constexpr double jump = 1.5;  ///< a factor of 30 between adjacent bands is no property of a smooth formula
constexpr std::uint64_t least_cases = 3;

bool is_rotation_vector(const FailedBlock& f) {
  return f.block == "rotation vector";
}
/// Whether formulas for the result have series in theta.
bool has_series(const FailedBlock& f) {
  constexpr std::string_view without[] = {"relative_angle", "angle_between", "rotation_between", "slerp"};
  return std::ranges::find(without, operation_of(f)) == std::end(without);
}
/// Whether nothing in the formula of a quaternion is singular near pi.
bool returns_quaternion(const FailedBlock& f) {
  return operation_of(f) == "exp3_quaternion" || operation_of(f) == "euler_to_quaternion";
}
/// Whether the error is an angle, not relative to theta.
bool errs_by_angle(const FailedBlock& f) {
  return f.block == "rotation" || f.block == "direction";
}
/// Whether no input of an angle from 1 to pi - 1 fails.
bool moderate_angles_pass(const FailedBlock& f) {
  return std::ranges::none_of(f.bands, [](const BandOf& b) {
    const Band& band = b.series->bands()[b.band];
    return band.axis == Axis::none && band.region == Region::to_pi && b.row->failed > 0;
  });
}

/// The points of one axis, ascending. The lowest bands, in which theta^2 underflows, say nothing of a formula.
class Shape {
 public:
  Shape(const FailedBlock& f, Axis axis) : f_(f), axis_(axis), root_(std::sqrt(f.worst->series->eps)) {
    std::map<std::size_t, Point> by_band;
    for (const BandOf& b : f.bands) {
      const Band& band = b.series->bands()[b.band];
      const bool underflows = axis == Axis::theta && !band.name.starts_with("theta 1e");
      if (band.axis != axis || underflows || (!b.fails && b.row->failed > 0) || band.low <= 1e-100 ||
          b.row->errors.count() < least_cases)
        continue;
      const double eps = b.series->eps;
      const Budget& budget = b.series->budget(b.output, band.region);
      const double error = budget.rule == Rule::forward ? b.row->max_error : b.row->max_excess;
      const double raw = std::log10(std::clamp(error, 1.0, 1 / eps));
      Point& point = by_band
                         .try_emplace(b.band, Point{std::log10(std::sqrt(band.low * band.high)), 0, 0,
                                                    band.low, band.high})
                         .first->second;
      point.raw = std::max(point.raw, raw);
      point.y = std::max(point.y, raw - std::log10(std::max(budget.limit, 1.0)));
      point.cases += b.row->errors.count(), point.failed += b.row->failed;
      point.lost |= error * eps > 0.03;
      point.zero |= std::fabs(error * eps - 1) < 1e-6, point.opposite |= std::fabs(error * eps - 2) < 1e-6;
      point.still |= error * eps > 0.5 * band.low && error * eps < 2 * band.high;
    }
    for (const auto& [band, p] : by_band) points_.push_back(p);
    std::ranges::sort(points_, {}, &Point::x);
    if (!points_.empty())
      peak_ = static_cast<std::size_t>(std::ranges::max_element(points_, {}, &Point::y) - points_.begin());
  }

  std::string at_small_angles() const;
  std::string near_pi() const;

 private:
  bool falls_above() const;
  const Point& p(std::size_t i) const { return points_[i]; }
  std::size_t size() const { return points_.size(); }
  double y(std::size_t i) const { return i < size() ? p(i).y : 0; }
  double raw(std::size_t i) const { return i < size() ? p(i).raw : 0; }
  /// Whether band i errs far less than the worst.
  bool falls(std::size_t i) const { return y(i) < y(peak_) - jump; }
  bool near_root(double theta) const { return std::fabs(std::log10(theta / root_)) < 1.6; }

  /// The number of bands up to the last one in which all digits are lost.
  std::size_t lost_bands() const {
    const auto last = std::find_if(points_.rbegin(), points_.rend(), [](const Point& q) { return q.lost; });
    return static_cast<std::size_t>(points_.rend() - last);
  }
  /// The slope of y over x where the error is above its limit, from a band on; 0 in fewer than three bands.
  double slope_from(std::size_t first) const {
    double n = 0, x = 0, sum = 0, xx = 0, xy = 0;
    for (const Point& q : std::span(points_).subspan(first))
      if (q.y > 0.5) ++n, x += q.x, sum += q.y, xx += q.x * q.x, xy += q.x * q.y;
    return n < 3 ? 0 : (n * xy - x * sum) / (n * xx - x * x);
  }
  double slope() const { return slope_from(lost_bands()); }  ///< above those that have lost all digits
  /// Whether an angle has lost all digits below the root of eps, in some bands by chance, and errs by 1 / theta^2 above it.
  bool is_acos_of_angle() const {
    std::size_t below = 0, lost = 0;
    while (below < size() && p(below).high < 2 * root_) lost += p(below++).lost;
    return has_angle(f_) && lost > 1 && slope_from(below) < -1.2 && slope_from(below) > -2.8;
  }
  /// Where failures begin or end, between a band that fails and the next one. Near pi its angle is pi - theta.
  std::optional<Crossing> crossing(const Point& failing, const Point& passing) const {
    const bool below = failing.x < passing.x;
    const auto inside = [&](const Point& q, double share) {  // from the lower edge up
      const double at = std::pow(q.low, 1 - share) * std::pow(q.high, share);
      return axis_ == Axis::theta ? at : std::numbers::pi - at;
    };
    for (const double from : {0.1, 0.5, 0.9})
      for (const double to : {0.9, 0.5, 0.1})
        if (auto c = angle_between(*f_.worst->series, static_cast<int>(f_.worst->output),
                                   inside(failing, below ? from : to), inside(passing, below ? to : from))) {
          if (axis_ != Axis::theta) c->angle = std::numbers::pi - c->angle;
          return c;
        }
    return std::nullopt;
  }
  /// The angle of this, else the border of both bands.
  std::string border(const Point& failing, const Point& passing) const {
    const auto c = crossing(failing, passing);
    return c ? short_angle(c->angle) : power_of_ten(failing.x < passing.x ? failing.high : failing.low);
  }
  /// The band from which the errors start at once, and then fall over bands, if there is one: there a closed form begins.
  std::optional<std::size_t> sharp_start() const {
    for (std::size_t i = 1; i + 1 < size(); ++i) {
      const bool first = y(i - 1) > 0 ? !p(i - 1).many_fail() : raw(i) - raw(i - 1) > jump;
      if (!first || !p(i).many_fail()) continue;
      std::size_t last = i;
      while (y(last + 1) > 0) ++last;
      const bool falls_after =
          last > i && y(last) < std::min(y(peak_) - 0.5, jump) && peak_ <= last && peak_ < i + 5;
      if (!falls_after) continue;
      const auto c = crossing(p(i), p(i - 1));
      if (!c || c->passing < 0.3) return i;
    }
    return std::nullopt;
  }
  /// Whether the errors fall by half a power of ten a band at least, from band i to the last one that fails.
  bool fall_from(std::size_t i) const {
    std::size_t last = i;
    while (last + 1 < size() && y(last + 1) > 0) ++last;
    return raw(i) - raw(last) >= 0.5 * static_cast<double>(last - i);
  }
  /// Whether the errors of the three bands up to i grow as theta.
  bool grows_up_to(std::size_t i) const {
    for (std::size_t k = i; k + 3 > i; --k)
      if (k == 0 || y(k) - y(k - 1) < 0.5 || y(k) - y(k - 1) > jump) return false;
    return true;
  }
  /// The band from which errors that grow are far larger at once, and then fall over bands.
  std::optional<std::size_t> step_up() const {
    for (std::size_t i = 1; i + 2 < size(); ++i)
      if (y(i) - y(i - 1) > 1 + jump && grows_up_to(i - 1) && y(i + 1) > 0 && y(i + 2) > 0) return i;
    return std::nullopt;
  }
  /// Whether the error grows as theta up to the root of eps and falls above, as that of 1 - cos does, which is 0 below.
  bool is_of_cosine() const {
    return peak_ >= 4 && near_root(std::pow(10, p(peak_).x)) && y(peak_ + 2) > 0 && y(peak_ + 2) < y(peak_) &&
           raw(peak_) - raw(peak_ + 1) < 2 && std::fabs(y(peak_) - y(peak_ - 1)) < jump &&
           (grows_up_to(peak_ - 1) || grows_up_to(peak_));
  }
  /// Whether the errors are those of 1 - w^2 in place of |v|^2: they grow as theta^2 up to the fourth root of eps, and fall as
  /// 1 / theta^2 above it, by two powers of ten a band, of which random inputs may show one less or one more.
  bool is_of_w_squared() const {
    return (operation_of(f_) == "log3_quaternion" || operation_of(f_) == "axis_angle_from_quaternion") &&
           peak_ >= 2 && peak_ + 2 < size() && std::fabs(p(peak_).x - std::log10(root_) / 2) < 1.1 &&
           y(peak_ - 1) > 0 && y(peak_ + 1) > 0 && raw(peak_) - raw(peak_ - 2) > 1.2 &&
           raw(peak_) - raw(peak_ + 2) > 1.2 &&
           std::max(raw(peak_) - raw(peak_ - 1), raw(peak_) - raw(peak_ + 1)) < 2.7;
  }
  /// Whether the largest errors below the root of eps are those of the root of eps, and fall above it.
  bool keeps_half() const {
    const double half = -std::log10(root_);
    std::size_t below = 0, as_large = 0;
    while (below < size() && p(below).x < std::log10(root_)) as_large += std::fabs(raw(below++) - half) < 0.8;
    return has_angle(f_) && as_large >= 3 && peak_ <= below && raw(peak_) < half + 0.8 && y(below) > 0 &&
           y(below + 2) < y(below);
  }
  /// The number of the lowest bands in which all digits are lost, if the next one is right.
  std::size_t wrong_bands() const {
    std::size_t wrong = 0;
    while (wrong < size() && p(wrong).lost) ++wrong;
    return wrong > 2 && wrong < size() && y(wrong) < 1 ? wrong : 0;
  }
  std::string below_cutoff() const {
    Point next{};
    next.x = 0.3, next.low = 1, next.high = 2;  // moderate angles are no band of this axis
    const std::string at = border(p(peak_), peak_ + 1 < size() ? p(peak_ + 1) : next);
    if (errs_by_angle(f_) && p(peak_).still && p(peak_ - 1).still)
      return fmt::format("a threshold at theta about {}, below which the result is that of theta = 0", at);
    if (!has_series(f_))
      return fmt::format("a threshold at theta about {}, below which another formula is coarser{}", at,
                         operation_of(f_) == "slerp" ? ", such as linear interpolation" : "");
    return fmt::format("a cutoff at theta about {}: the series below it lacks a term, or has a wrong one",
                       at);
  }

  /// Of errors in one band alone: on the side of a cutoff they begin at once, on the other they come from below the limit.
  std::string of_one_band() const {
    const bool last_goes_on = peak_ + 1 == size() && !moderate_angles_pass(f_);  // to these
    if (peak_ == 0 || y(peak_ - 1) > 0 || y(peak_ + 1) > 0 || last_goes_on || !p(peak_).many_fail())
      return "";
    const auto below = crossing(p(peak_), p(peak_ - 1));
    const auto above = peak_ + 1 < size() ? crossing(p(peak_), p(peak_ + 1)) : std::nullopt;
    const bool from = below && below->passing < 0.3, to = above && above->passing < 0.3;
    if (from == to) return "";
    return from ? fmt::format(
                      "a cutoff at theta about {}: above it the closed form cancels, the more the smaller "
                      "theta is",
                      short_angle(below->angle))
                : fmt::format(
                      "a cutoff at theta about {}: the series below it lacks a term, or has a wrong one",
                      short_angle(above->angle));
  }

  const FailedBlock& f_;
  Axis axis_;
  double root_;
  std::vector<Point> points_;
  std::size_t peak_ = 0;
};

std::string Shape::at_small_angles() const {
  if (size() < 5 || y(peak_) < 1) {
    const auto start = size() < 5 || !has_series(f_) ? std::nullopt : sharp_start();
    if (!start) return "";
  }
  const bool to_one = peak_ + 1 == size() && p(peak_).high == 1 && moderate_angles_pass(f_),
             ends_below = peak_ > 0 && falls(peak_ - 1),
             ends_above = to_one || (peak_ + 1 < size() && falls(peak_ + 1));
  const double power = slope();
  // Below the root of eps the cosine is 1, and its acos is 0. The angle between two quaternions errs by chance there.
  if (is_rotation_vector(f_) ? power < -1.5 && power > -2.5 && (!ends_below || near_root(p(peak_).low))
                             : is_acos_of_angle())
    return "acos near 1, which keeps half of the digits: the error grows as 1 / theta^2; atan2 of both parts "
           "does not";
  if (is_rotation_vector(f_) && std::ranges::count_if(points_, &Point::opposite) > 1 &&
      std::ranges::all_of(points_, [](const Point& q) { return q.y == 0 || q.opposite; }))
    return "a sign: the result is the opposite of the right one; the rotation vector of Q with w < 0 is that "
           "of -Q";
  if (is_of_w_squared())
    return "1 - w^2 cancels as theta goes to 0, in sqrt(1 - w^2) for |v|, for example: |v| keeps all digits";
  if (const auto start = has_series(f_) ? sharp_start() : std::nullopt)
    return fmt::format(
        "a cutoff at theta about {}: above it the closed form cancels, the more the smaller theta is",
        border(p(*start), p(*start - 1)));
  if (const auto step = has_series(f_) ? step_up() : std::nullopt)
    return fmt::format(
        "a cutoff at theta about {}: above it the closed form cancels, and the series below it lacks a term",
        power_of_ten(p(*step).low));
  if (has_series(f_) && ends_below && y(peak_ + 1) > 0.5 && p(peak_).many_fail() && fall_from(peak_))
    return fmt::format(
        "a cutoff at theta about {}: above it the closed form cancels, the more the smaller theta is",
        border(p(peak_), p(peak_ - 1)));
  if (has_series(f_) && is_of_cosine() && f_.block == "coupling")
    return "a missing series: theta - sin(theta), or 1 - theta^2 / 2 - cos(theta), cancels as theta goes to "
           "0";
  if (has_series(f_) && is_of_cosine())
    return fmt::format(
        "1 - cos(theta) cancels, and is 0 below theta about {}: 2 sin(theta / 2)^2 keeps all digits",
        short_angle(root_));
  if (errs_by_angle(f_) && p(peak_).still && near_root(p(peak_).high) && y(peak_ + 1) > 0.3 &&
      y(peak_ + 1) < y(peak_))
    return "acos near 1, which keeps half of the digits; atan2 of both parts does not";
  if (peak_ >= 2 && y(peak_ - 1) > 0.3 && y(peak_ - 2) <= y(peak_ - 1) && ends_above && falls(peak_ - 2) &&
      (p(peak_).many_fail() || p(peak_ - 1).many_fail()))
    return below_cutoff();
  if (const std::string alone = has_series(f_) ? of_one_band() : ""; !alone.empty()) return alone;
  std::size_t first = 0;  // angles below the resolution of the arguments are 0
  while (first < size() && y(first) == 0) ++first;
  std::size_t zeros = first;
  while (zeros < size() && p(zeros).zero) ++zeros;
  if (zeros > first + 1 && zeros < size() && y(zeros) < y(zeros - 1) - jump &&
      p(zeros).low < 1.01 * p(zeros - 1).high)  // the next band has cases, too
    return fmt::format(
        "the result is 0 where theta is below about {}: a threshold, or acos of a number that rounds to 1",
        border(p(zeros - 1), p(zeros)));
  if (has_series(f_) && peak_ >= 3 && peak_ + 3 < size() && falls(peak_ - 3) && falls(peak_ + 3) &&
      p(peak_).many_fail() && y(peak_ - 1) > 0 && y(peak_ + 1) > 0)
    return fmt::format("a cutoff at theta about {}, towards which the errors of both formulas grow",
                       power_of_ten(y(peak_ + 1) > y(peak_ - 1) ? p(peak_).high : p(peak_).low));
  if (power > -0.5 || p(0).y < y(peak_) - jump) return "";
  if (operation_of(f_).starts_with("log3_quaternion") || operation_of(f_) == "log3_any_norm") {
    std::uint64_t cases = 0, failed = 0;  // half of the stored quaternions have w < 0
    for (const Point& q : points_) cases += q.y > 0.5 ? q.cases : 0, failed += q.y > 0.5 ? q.failed : 0;
    if (failed * 10 > cases * 2 && failed * 10 < cases * 8)
      return "where w < 0, the angle 2 atan2(|v|, w) is near 2 pi, and 2 pi - angle cancels; -Q is the same "
             "rotation, with w > 0";
  }
  return fmt::format(
      "a missing series: the formula cancels as theta goes to 0, and the error grows as 1 / theta{}",
      std::lround(-power) > 1 ? fmt::format("^{}", std::lround(-power)) : "");
}

/// Whether the errors of the bands above the largest one fall as the square of 1 / (pi - theta), over four bands at least.
bool Shape::falls_above() const {
  std::size_t last = peak_;
  while (last + 1 < size() && y(last + 1) > 0.5) ++last;
  return last >= peak_ + 3 && raw(peak_) - raw(last) > 1.5 * static_cast<double>(last - peak_);
}

std::string Shape::near_pi() const {
  if (size() < 4) return "";
  const double power = slope();
  if (falls_above() && is_rotation_vector(f_))
    return "sin near pi: something is divided by sin(theta), or theta comes from acos: the error grows as 1 "
           "/ (pi - theta)^2";
  if (operation_of(f_) != "angle_between" && peak_ >= 2 && y(peak_) > 1 && p(peak_ - 1).still &&
      y(peak_ - 2) < y(peak_ - 1) && peak_ + 1 < size() && falls(peak_ + 1))
    return fmt::format(
        "a threshold at pi - theta about {}, below which the result is that of theta = pi, or of another "
        "axis{}",
        border(p(peak_), p(peak_ + 1)),
        !has_series(f_) && y(peak_ + 1) > 0 ? "; above it, 1 + cos(theta) or the cross product cancels" : "");
  if (!has_series(f_) && !has_angle(f_)) {
    std::size_t lost = 0;
    while (lost < size() && p(lost).lost) ++lost;
    if (lost > 1 && lost < size() && p(lost).y < 1 && p(lost).low < 1.01 * p(lost - 1).high)
      return fmt::format("a threshold between pi - theta = {} and {}, below which the result is wrong",
                         power_of_ten(p(lost - 1).low), power_of_ten(p(lost - 1).high));
    if (p(0).y > jump && power < -0.5)
      return "1 + cos(theta), or the cross product of the arguments, cancels where they are nearly opposite";
    return "";
  }
  if (const std::size_t wrong = operation_of(f_) == "log3_matrix" ? wrong_bands() : 0)
    return fmt::format(
        "a threshold at pi - theta about {}, below which the axis has wrong signs: the roots of the diagonal "
        "of R have none",
        border(p(wrong - 1), p(wrong)));
  if (keeps_half())
    return fmt::format("{}, which keeps half of the digits near pi; atan2 of both parts does not",
                       operation_of(f_) == "angle_between" ? "acos near -1" : "asin of a number near 1");
  // Nearer to pi than the root of eps, the results of any formula are lost, or on another branch.
  if (const auto start = sharp_start(); start && p(*start).low > root_)
    return fmt::format(
        "a threshold at pi - theta about {}: beyond it something is divided by sin(theta) or "
        "sqrt(1 + trace), which cancel near pi",
        border(p(*start), p(*start - 1)));
  if (is_of_cosine() &&
      (operation_of(f_).starts_with("log3_quaternion") || operation_of(f_) == "relative_angle"))
    return "asin of a number near 1, which keeps half of the digits near pi; atan2 of both parts does not";
  if (is_of_cosine())
    return fmt::format(
        "1 + cos(theta) cancels near pi, and is 0 where pi - theta is below about {}: "
        "(1 + cos(theta)) / sin(theta) is 1 / tan(theta / 2)",
        short_angle(root_));
  if (p(0).y > jump && power < -0.5 && power > -2.5 && returns_quaternion(f_))
    return "a quaternion from a rotation matrix: something is divided by w = sqrt(1 + trace) / 2, which "
           "cancels near pi";
  if (p(0).y > jump && power < -0.5 && power > -2.5)
    return fmt::format(
        "sin near pi: something is divided by sin(theta), or theta comes from acos: the error grows as "
        "1 / (pi - theta){}",
        std::lround(-power) > 1 ? "^2" : "");
  return "";
}

}  // namespace

std::string shape_at_small_angles(const FailedBlock& f) {
  return Shape(f, Axis::theta).at_small_angles();
}
std::string shape_near_pi(const FailedBlock& f) {
  return Shape(f, Axis::pi_minus_theta).near_pi();
}

std::string short_angle(double theta) {
  if (std::fabs(std::log10(theta) - std::round(std::log10(theta))) < 0.02) return power_of_ten(theta);
  std::string text = fmt::format("{:.2g}", theta);
  if (const auto zero = text.find("e-0"); zero != text.npos) text.erase(zero + 2, 1);
  return text;
}
std::string power_of_ten(double theta) {
  return fmt::format("1e{}", static_cast<int>(std::lround(std::log10(theta))));
}

std::string_view operation_of(const FailedBlock& f) {
  return f.worst->series->outputs.at(f.worst->output).operation;
}
bool has_angle(const FailedBlock& f) {
  return is_rotation_vector(f) || operation_of(f) == "relative_angle" || operation_of(f) == "angle_between";
}

}  // namespace liecheck::properties
